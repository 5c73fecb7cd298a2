// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/front_sampler.h>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace front_sampler_test {
namespace {

using namespace vcg::ccdm;

std::vector<Point> Front(const Model &model, int count)
{
    Random random(1);
    std::vector<Point> points;
    for (const SurfacePoint &p : FrontSampler(model.surface, model.features, model.density, true)
                                     .Run(SampleCurves(model.surface, model.features, model.density), count, random))
        points.push_back(model.surface.At(p));
    return points;
}

double NearestPair(const std::vector<Point> &points)
{
    double least = 1e300;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            least = std::min(least, Norm(points[i] - points[j]));
    return least;
}

TEST(PointBuckets, FindsWhatBruteForceFinds)
{
    Random random(4);
    PointBuckets buckets(0.01, 500);
    std::vector<Point> points;
    for (int i = 0; i < 500; ++i) {
        points.push_back(Point(random.Unit(), random.Unit(), random.Unit()));
        buckets.Add(points.back(), 0.05);
    }
    for (int q = 0; q < 50; ++q) {
        const Point p(random.Unit(), random.Unit(), random.Unit());
        std::vector<int> seen(points.size(), 0);
        buckets.Near(p, 0.2, 0.05, [&](int i, double d) {
            EXPECT_DOUBLE_EQ(d, SquaredNorm(points[i] - p));
            seen[i] = 1;
            return true;
        });
        for (std::size_t i = 0; i < points.size(); ++i)
            EXPECT_EQ(seen[i] != 0, SquaredNorm(points[i] - p) < 0.04);
    }
}

TEST(FrontSampler, GivesExactlyTheNumberWellApart)
{
    for (const int n : {1, 2, 17, 300, 3000}) {
        const Model model = meshes::MakeModel(shapes::Bumpy(4), n, 180);
        const std::vector<Point> points = Front(model, n);
        ASSERT_EQ(static_cast<int>(points.size()), n);
        if (n >= 17) {
            EXPECT_GT(NearestPair(points), 0.5 * model.density.spacing[0]);
        }
    }
}

TEST(FrontSampler, ReachesEveryComponent)
{
    const Model model = meshes::MakeModel(shapes::TwoComponents(), 800, 40);
    const std::vector<Point> points = Front(model, 800);
    const double gap = model.surface.position.back()[0];
    int left = 0;
    for (const Point &p : points)
        left += p[0] < gap / 2;
    EXPECT_GT(left, 100);
    EXPECT_LT(left, 700);
}

TEST(FrontSampler, FollowsAGradedDensity)
{
    const shapes::Shape s = shapes::FlatGrid(40);
    Model model = meshes::MakeModel(s, 2000, 180);
    std::vector<double> phi;
    for (const auto &p : s.points)
        phi.push_back(std::exp(3 * p[0]));
    model.density = MakeDensityField(model.surface, phi, false, 1, 8000);
    const std::vector<Point> points = Front(model, 7500);
    // A fifth of the square from 0.1, and from 0.7: e^1.8 times as many.
    int low = 0, high = 0;
    for (const Point &p : points) {
        low += p[0] > 0.1 && p[0] < 0.3;
        high += p[0] > 0.7 && p[0] < 0.9;
    }
    // Fronts that meet leave gaps of up to 1.4 spacings, which the optimiser closes later.
    EXPECT_NEAR(static_cast<double>(high) / low, std::exp(1.8), 0.35 * std::exp(1.8));
}

TEST(FrontSampler, TheSameSeedGivesTheSamePoints)
{
    const Model model = meshes::MakeModel(shapes::KleinBottle(40, 20), 500, 180);
    const auto run = [&] {
        Random random(9);
        return FrontSampler(model.surface, model.features, model.density, false).Run({}, 500, random);
    };
    const auto a = run(), b = run();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_EQ(Norm(model.surface.At(a[i]) - model.surface.At(b[i])), 0);
}

} // namespace
} // namespace front_sampler_test
