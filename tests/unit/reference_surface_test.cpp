// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/reference_surface.h>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace reference_surface_test {
namespace {

using namespace vcg::ccdm;

ReferenceSurface Surface(const shapes::Shape &s)
{
    const MeshTables t = meshes::Tables(s);
    return ReferenceSurface(t.position, t.face);
}

double BruteForceDistance(const ReferenceSurface &s, const Point &p)
{
    double best = 1e300;
    for (int t = 0; t < s.FaceCount(); ++t)
        best = std::min(best, s.NearestOn(t, p).squaredDistance);
    return std::sqrt(best);
}

TEST(NearestOnTriangle, AgreesWithADenseSearch)
{
    Random random(7);
    const auto point = [&] { return Point(random.Unit(), random.Unit(), random.Unit()) * 2.0 - Point(1, 1, 1); };
    for (int i = 0; i < 300; ++i) {
        const Point a = point(), e1 = point(), e2 = point(), p = point() * 2.0;
        const Foot f = NearestOnTriangle(a, e1, e2, p);
        double best = 1e300;
        const int n = 60;
        for (int u = 0; u <= n; ++u)
            for (int w = 0; u + w <= n; ++w)
                best = std::min(best, Norm(p - (a + e1 * (double(u) / n) + e2 * (double(w) / n))));
        EXPECT_LE(std::sqrt(f.squaredDistance), best + 1e-12);
        EXPECT_GE(std::sqrt(f.squaredDistance), best - 0.08);
        for (const double w : f.weight) {
            EXPECT_GE(w, -1e-12);
            EXPECT_LE(w, 1 + 1e-12);
        }
        EXPECT_NEAR(Norm(p - f.point), std::sqrt(f.squaredDistance), 1e-12);
    }
}

TEST(NearestOnTriangle, SurvivesTrianglesWithoutArea)
{
    const Foot f = NearestOnTriangle(Point(0, 0, 0), Point(1, 0, 0), Point(2, 0, 0), Point(1.5, 1, 0));
    EXPECT_TRUE(std::isfinite(f.squaredDistance));
    const Foot g = NearestOnTriangle(Point(1, 1, 1), Point(0, 0, 0), Point(0, 0, 0), Point(0, 0, 0));
    EXPECT_NEAR(g.squaredDistance, 3, 1e-12);
}

TEST(Project, FindsTheNearestPointOfASmoothSurface)
{
    const ReferenceSurface s = Surface(shapes::Bumpy(4));
    Random random(3);
    for (int i = 0; i < 500; ++i) {
        const int face = static_cast<int>(random.Unit() * s.FaceCount());
        const Point x = s.At({face, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
        const Point step(random.Unit() - 0.5, random.Unit() - 0.5, random.Unit() - 0.5);
        const Point n = Normalized(s.AreaVector(face));
        const Point target = x + (step - n * Dot(step, n)) * 0.2;
        const auto exact = s.Project(face, x, target, 0);
        EXPECT_NEAR(std::sqrt(exact.second.squaredDistance), BruteForceDistance(s, target), 1e-9);
        // The early stop stays within its tenth of the step.
        const auto quick = s.Project(face, x, target);
        EXPECT_LE(std::sqrt(quick.second.squaredDistance),
                  std::max(0.1 * Norm(target - x), BruteForceDistance(s, target)) + 1e-12);
    }
}

TEST(Project, DoesNotJumpToAnotherSheet)
{
    // Two sheets 0.01 apart, joined at one far edge only; targets nearer to the other sheet.
    shapes::Shape s = shapes::Extrude(shapes::FlatGrid(10), 0.01);
    const ReferenceSurface surface = Surface(s);
    for (int t = 0; t < surface.FaceCount(); ++t) {
        const Point x = surface.At({t, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
        if (x[2] != 0 || x[0] < 0.3 || x[0] > 0.7 || x[1] < 0.3 || x[1] > 0.7)
            continue;
        const auto r = surface.Project(t, x, x + Point(0.02, 0, 0.009));
        EXPECT_EQ(r.second.point[2], 0) << "jumped";
    }
}

TEST(Project, DoesNotCrossFeatures)
{
    ReferenceSurface s = Surface(shapes::FlatGrid(10));
    Triangulation &m = s.mesh;
    for (int t = 0; t < m.TriangleCount(); ++t)
        for (int e = 0; e < 3; ++e) {
            const Side side = MakeSide(t, e);
            if (std::abs(s.position[m.Tail(side)][0] - 0.5) < 1e-9 &&
                std::abs(s.position[m.Head(side)][0] - 0.5) < 1e-9)
                m.SetConstrained(side, true);
        }
    int tried = 0;
    for (int t = 0; t < s.FaceCount(); ++t) {
        const Point x = s.At({t, {1.0 / 3, 1.0 / 3, 1.0 / 3}});
        if (x[0] < 0.35 || x[0] > 0.5)
            continue;
        EXPECT_LE(s.Project(t, x, x + Point(0.3, 0.01, 0)).second.point[0], 0.5 + 1e-12);
        ++tried;
    }
    EXPECT_GT(tried, 10);
}

TEST(ReferenceSurface, InterpolatesLinearly)
{
    const ReferenceSurface s = Surface(shapes::Sphere(2));
    std::vector<double> field;
    for (const Point &p : s.position)
        field.push_back(2 * p[0] - p[1] + 3);
    const SurfacePoint p = {17, {0.2, 0.5, 0.3}};
    const Point x = s.At(p);
    EXPECT_NEAR(s.Interpolate(p, field), 2 * x[0] - x[1] + 3, 1e-12);
}

TEST(ReferenceSurface, JoinsFacesOfOneSheetOnly)
{
    // Two sides of a thin plate: close in space, far apart around the rim; and its creases keep faces apart.
    ReferenceSurface smooth = meshes::MakeModel(shapes::Extrude(shapes::FlatGrid(10), 0.02), 200, 180).surface;
    const auto faceAt = [&](const Point &p) {
        int best = 0;
        for (int t = 0; t < smooth.FaceCount(); ++t)
            if (smooth.NearestOn(t, p).squaredDistance < smooth.NearestOn(best, p).squaredDistance)
                best = t;
        return best;
    };
    const int top = faceAt(Point(0.52, 0.53, 0.02)), bottom = faceAt(Point(0.52, 0.53, 0)),
              beside = faceAt(Point(0.72, 0.53, 0.02));
    ASSERT_NE(top, bottom);
    EXPECT_FALSE(smooth.Joined(top, bottom, Point(0.52, 0.53, 0.01), 0.2, 4096));
    EXPECT_TRUE(smooth.Joined(top, bottom, Point(0.52, 0.53, 0.01), 1, 4096));
    EXPECT_FALSE(smooth.Joined(top, bottom, Point(0.52, 0.53, 0.01), 1, 20)) << "only so many faces are looked at";
    EXPECT_TRUE(smooth.Joined(top, beside, Point(0.6, 0.53, 0.02), 0.2, 4096));
    const ReferenceSurface creased = meshes::MakeModel(shapes::Extrude(shapes::FlatGrid(10), 0.02), 200, 40).surface;
    EXPECT_FALSE(creased.Joined(top, bottom, Point(0.52, 0.53, 0.01), 1, 4096));
}

} // namespace
} // namespace reference_surface_test
