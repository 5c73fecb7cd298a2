// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/delaunay.h>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/verification.h>

#include "support/meshes.h"

namespace delaunay_test {
namespace {

using namespace vcg::ccdm;

Remesh Shaken(const shapes::Shape &s, double angle, double size)
{
    shapes::Shape shaken = s;
    shapes::AddNoise(shaken, size);
    return meshes::AsRemesh(meshes::MakeModel(shaken, 1000, angle));
}

// Edges whose opposite angles sum to more than pi, by the definition.
int CountNotDelaunay(const Remesh &r, bool onlyFlippable)
{
    int count = 0;
    for (int t = 0; t < r.mesh.TriangleCount(); ++t)
        for (int e = 0; e < 3; ++e) {
            const Side s = MakeSide(t, e);
            if (r.mesh.Mate(s) < s || r.mesh.Constrained(s))
                continue;
            const auto angle = [&](Side x) {
                const Point &a = r.position[r.mesh.Opposite(x)];
                const Point u = r.position[r.mesh.Tail(x)] - a, w = r.position[r.mesh.Head(x)] - a;
                return std::atan2(Norm(Cross(u, w)), Dot(u, w));
            };
            if (angle(s) + angle(r.mesh.Mate(s)) > Pi + 1e-6)
                count += !onlyFlippable || MayFlip(r, s, Hinge(r, s));
        }
    return count;
}

TEST(DelaunayFlipper, MakesAPlaneTriangulationDelaunay)
{
    shapes::Shape s = shapes::FlatGrid(20);
    for (std::size_t v = 0; v < s.points.size(); ++v)
        for (int k = 0; k < 2; ++k)
            if (s.points[v][k] > 0.01 && s.points[v][k] < 0.99)
                s.points[v][k] += 0.018 * shapes::Noise(2 * v + k);
    Remesh r = meshes::AsRemesh(meshes::MakeModel(s, 1000, 180));
    EXPECT_GT(CountNotDelaunay(r, false), 20);
    EXPECT_GT(DelaunayFlipper(meshes::Alone()).Run(r), 20);
    EXPECT_EQ(CountNotDelaunay(r, false), 0);
    EXPECT_EQ(VerifyTriangulation(r.mesh).fault, "");
    EXPECT_EQ(DelaunayFlipper(meshes::Alone()).Run(r), 0);
}

TEST(DelaunayFlipper, LeavesOnlyWhatMayNotFlip)
{
    for (const shapes::Shape &s : {shapes::Bumpy(4), shapes::KleinBottle(50, 30), shapes::CadPart()}) {
        Remesh r = Shaken(s, 180, 0.01);
        const TopologyCounts before = VerifyTriangulation(r.mesh).counts;
        EXPECT_GT(DelaunayFlipper(meshes::Alone()).Run(r), 0);
        EXPECT_EQ(CountNotDelaunay(r, true), 0);
        EXPECT_EQ(VerifyTriangulation(r.mesh).fault, "");
        EXPECT_TRUE(VerifyTriangulation(r.mesh).counts.SameTypeAs(before));
    }
}

TEST(DelaunayFlipper, NeverFlipsAFeature)
{
    const Model model = meshes::MakeModel(shapes::CadPart(), 1000, 40);
    Remesh r = meshes::AsRemesh(model);
    DelaunayFlipper(meshes::Alone()).Run(r);
    for (const FeatureCurve &c : model.features.curve)
        for (int k = 0; k < c.Segments(); ++k) {
            const Side s = r.mesh.FindEdge(c.vertex[k], c.vertex[k + 1]);
            ASSERT_NE(s, NoSide);
            EXPECT_TRUE(r.mesh.Constrained(s));
        }
}

TEST(Hinge, ExcessGrowsWithTheOppositeAngles)
{
    // Apexes closer and closer to the edge pq.
    double last = 0;
    for (const double height : {0.49, 0.4, 0.2, 0.1}) {
        const shapes::Shape s = {{{0, 0, 0}, {1, 0, 0}, {0.5, height, 0}, {0.5, -height, 0}}, {{0, 1, 2}, {1, 0, 3}}};
        const Remesh r = meshes::AsRemesh(meshes::MakeModel(s, 10, 180));
        const double excess = Hinge(r, r.mesh.FindEdge(0, 1)).Excess();
        EXPECT_GT(excess, last);
        last = excess;
    }
    const shapes::Shape square = {{{0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0}, {0.5, -0.5, 0}}, {{0, 1, 2}, {1, 0, 3}}};
    const Remesh r = meshes::AsRemesh(meshes::MakeModel(square, 10, 180));
    EXPECT_EQ(Hinge(r, r.mesh.FindEdge(0, 1)).Excess(), 0) << "angles that sum to pi are Delaunay";
}

TEST(Hinge, RefusesFolds)
{
    // The other diagonal of a quadrilateral that is not convex runs outside.
    const shapes::Shape s = {{{0, 0, 0}, {1, 0, 0}, {1.6, 0.2, 0}, {1.6, -0.2, 0}}, {{0, 1, 2}, {1, 0, 3}}};
    const Remesh r = meshes::AsRemesh(meshes::MakeModel(s, 10, 180));
    EXPECT_FALSE(Hinge(r, r.mesh.FindEdge(0, 1)).KeepsShape());
}

} // namespace
} // namespace delaunay_test
