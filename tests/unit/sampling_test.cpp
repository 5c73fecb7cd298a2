// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/sampling.h>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace sampling_test {
namespace {

using namespace vcg::ccdm;

TEST(SampleCurves, SpacesEvenlyByTheLocalSpacing)
{
    const Model model = meshes::MakeModel(shapes::FlatGrid(10), 1000, 180);
    const std::vector<CurveSample> samples = SampleCurves(model.surface, model.features, model.density);
    // Four sides of length 1, each with round(1 / h) segments.
    const int segments = static_cast<int>(std::lround(1 / model.density.spacing[0]));
    ASSERT_EQ(samples.size(), 4U * (segments - 1));
    for (std::size_t i = 1; i < samples.size(); ++i)
        if (samples[i].curve == samples[i - 1].curve) {
            EXPECT_NEAR(samples[i].s - samples[i - 1].s, 1.0 / segments, 1e-9);
        }
}

TEST(SampleCurves, FollowsAGradedDensity)
{
    Model model = meshes::MakeModel(shapes::FlatGrid(40), 2000, 180);
    std::vector<double> phi;
    for (const Point &p : model.surface.position)
        phi.push_back(p[0] < 0.5 ? 1.0 : 16.0);
    model.density = MakeDensityField(model.surface, phi, false, 0.2, 2000);
    int coarse = 0, fine = 0;
    for (const CurveSample &s : SampleCurves(model.surface, model.features, model.density)) {
        const FeatureCurve &c = model.features.curve[s.curve];
        const int k = c.SegmentAt(s.s);
        const Point &a = model.surface.position[c.vertex[k]], &b = model.surface.position[c.vertex[k + 1]];
        const Point p = a + (b - a) * c.Fraction(k, s.s);
        if (p[1] == 0 && p[0] < 0.45)
            ++coarse;
        if (p[1] == 0 && p[0] > 0.55)
            ++fine;
    }
    // A sixteenth of the density is a quarter of the samples on a line.
    EXPECT_NEAR(static_cast<double>(fine) / coarse, 4, 0.8);
}

TEST(SampleCurves, KeepsTheLeastThatHoldsTheTopology)
{
    // Far too few vertices: closed curves keep three, curves between corners need none.
    const Model model = meshes::MakeModel(shapes::CadPart(), 4, 40);
    std::vector<int> count(model.features.curve.size(), 0);
    for (const CurveSample &s : SampleCurves(model.surface, model.features, model.density))
        ++count[s.curve];
    for (std::size_t i = 0; i < count.size(); ++i)
        if (model.features.curve[i].closed) {
            EXPECT_GE(count[i], 3);
        }
}

TEST(SampleCurvesWithin, KeepsTheBudgetWhereTheCurvesCan)
{
    const Model model = meshes::MakeModel(shapes::FlatGrid(10), 100, 180);
    const auto within = [&](int most) {
        return static_cast<int>(SampleCurvesWithin(model.surface, model.features, model.density, most).size());
    };
    const int all = static_cast<int>(SampleCurves(model.surface, model.features, model.density).size());
    ASSERT_GT(all, 12);
    EXPECT_EQ(within(all), all);
    EXPECT_EQ(within(all + 5), all);
    EXPECT_LE(within(12), 12);
    EXPECT_GT(within(12), 0);
    // Sides between corners need no vertices of their own.
    EXPECT_EQ(within(0), 0);
    EXPECT_EQ(within(-4), 0);
    // Closed curves need three each, whatever is asked.
    const Model part = meshes::MakeModel(shapes::CadPart(), 500, 40);
    const std::vector<CurveSample> least = SampleCurvesWithin(part.surface, part.features, part.density, 0);
    const std::size_t fewest = SampleCurves(part.surface, part.features, part.density, 1e9).size();
    EXPECT_GT(fewest, 0U);
    EXPECT_GE(least.size(), fewest);
    EXPECT_LE(least.size(), fewest + fewest / 5);
}

TEST(SampleFaces, DrawsInProportionToDensityTimesArea)
{
    Model model = meshes::MakeModel(shapes::FlatGrid(20), 1000, 180);
    std::vector<double> phi;
    for (const Point &p : model.surface.position)
        phi.push_back(1 + 4 * p[0]);
    model.density = MakeDensityField(model.surface, phi, false, 0.2, 1000);
    Random random(5);
    const int n = 40000, bins = 5;
    std::vector<int> hist(bins, 0);
    for (const SurfacePoint &s : SampleFaces(model.surface, model.density, n, random)) {
        EXPECT_NEAR(s.weight[0] + s.weight[1] + s.weight[2], 1, 1e-12);
        ++hist[std::min(bins - 1, static_cast<int>(model.surface.At(s)[0] * bins))];
    }
    for (int b = 0; b < bins; ++b) {
        const double x = (b + 0.5) / bins;
        EXPECT_NEAR(hist[b] / static_cast<double>(n), (1 + 4 * x) / 3 / bins, 0.006);
    }
}

TEST(SampleFaces, NeverPicksAFaceWithoutArea)
{
    // The third face has its corners on one line.
    const shapes::Shape s = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0.5, 0, 0}},
                             {{0, 4, 2}, {4, 1, 2}, {0, 1, 4}, {1, 0, 3}}};
    const MeshTables t = meshes::Tables(s);
    ReferenceSurface surface(t.position, t.face);
    const DensityField d = MakeDensityField(surface, std::vector<double>(t.position.size(), 1.0), true, 0.2, 10);
    Random random(1);
    for (const SurfacePoint &p : SampleFaces(surface, d, 500, random))
        EXPECT_GT(Norm(surface.AreaVector(p.face)), 0);
}

} // namespace
} // namespace sampling_test
