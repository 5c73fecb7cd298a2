// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/feature_graph.h>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace feature_graph_test {
namespace {

using namespace vcg::ccdm;

FeatureGraph Graph(const shapes::Shape &s, double angle, double spacing, const SideMarks &marked = {})
{
    const MeshTables t = meshes::Tables(s);
    ReferenceSurface surface(t.position, t.face);
    MarkFeatures(surface, angle, marked);
    const std::vector<double> h(t.position.size(), spacing);
    return FeatureTracer(surface, h, marked, CornerRules{50}).Trace();
}

double TotalLength(const FeatureGraph &g)
{
    double sum = 0;
    for (const FeatureCurve &c : g.curve)
        sum += c.Length();
    return sum;
}

TEST(FeatureGraph, BoxHasTwelveCurvesAndEightCorners)
{
    const FeatureGraph g = Graph(shapes::Box(1, 2, 3), 40, 0.1);
    EXPECT_EQ(g.curve.size(), 12U);
    EXPECT_EQ(g.corner.size(), 8U);
    EXPECT_NEAR(TotalLength(g), 4 * (1 + 2 + 3), 1e-12);
}

TEST(FeatureGraph, CadPartHasClosedRimsAndAnOuterFrame)
{
    // Four rims of holes, and the block's twelve edges (of a 4 x 2 x 1.2 block).
    const FeatureGraph g = Graph(shapes::CadPart(), 40, 0.05);
    int closed = 0;
    for (const FeatureCurve &c : g.curve)
        closed += c.closed;
    EXPECT_EQ(closed, 4);
    EXPECT_EQ(g.curve.size(), 16U);
    EXPECT_EQ(g.corner.size(), 8U);
}

TEST(FeatureGraph, TwistedBarHasFourClosedCurves)
{
    const FeatureGraph g = Graph(shapes::TwistedBar(80, 3), 60, 0.05);
    ASSERT_EQ(g.curve.size(), 4U);
    for (const FeatureCurve &c : g.curve)
        EXPECT_TRUE(c.closed);
    EXPECT_TRUE(g.corner.empty());
}

TEST(FeatureGraph, BoundariesAreFeaturesAtAnyAngle)
{
    const FeatureGraph g = Graph(shapes::FlatGrid(8), 180, 0.1);
    EXPECT_EQ(g.curve.size(), 4U);
    EXPECT_EQ(g.corner.size(), 4U);
    EXPECT_NEAR(TotalLength(g), 4, 1e-12);
    EXPECT_TRUE(Graph(shapes::Box(1, 1, 1), 180, 0.1).curve.empty());
}

TEST(FeatureGraph, OneSidedSurfaceHasNoFalseCrease)
{
    EXPECT_TRUE(Graph(shapes::KleinBottle(60, 40), 60, 0.1).curve.empty());
    const FeatureGraph g = Graph(shapes::MoebiusStrip(60, 4), 60, 0.1);
    ASSERT_EQ(g.curve.size(), 1U);
    EXPECT_TRUE(g.curve[0].closed);
}

TEST(FeatureGraph, CurvesAreChainsOfEdgesWithArcLength)
{
    const shapes::Shape s = shapes::CadPart();
    for (const FeatureCurve &c : Graph(s, 40, 0.05).curve) {
        ASSERT_EQ(c.vertex.size(), c.side.size() + 1);
        ASSERT_EQ(c.arc.size(), c.vertex.size());
        for (int k = 0; k < c.Segments(); ++k) {
            const shapes::P &p = s.points[c.vertex[k]], &q = s.points[c.vertex[k + 1]];
            EXPECT_NEAR(c.arc[k + 1] - c.arc[k], std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]), 1e-12);
            EXPECT_EQ(c.SegmentAt(0.5 * (c.arc[k] + c.arc[k + 1]), 0), k);
            EXPECT_NEAR(c.Fraction(k, 0.25 * c.arc[k] + 0.75 * c.arc[k + 1]), 0.75, 1e-9);
        }
    }
}

// Marks the edges along a row of grid points as a caller would.
SideMarks MarkRow(const shapes::Shape &s, double y, double x0, double x1)
{
    SideMarks marks(s.faces.size(), 0);
    const auto on = [&](int v) {
        const shapes::P &p = s.points[v];
        return std::abs(p[1] - y) < 1e-9 && p[0] > x0 - 1e-9 && p[0] < x1 + 1e-9;
    };
    for (std::size_t t = 0; t < s.faces.size(); ++t)
        for (int e = 0; e < 3; ++e)
            if (on(s.faces[t][(e + 1) % 3]) && on(s.faces[t][(e + 2) % 3]))
                marks[t] = static_cast<std::uint8_t>(marks[t] | (1U << e));
    return marks;
}

TEST(FeatureGraph, MarkedEdgesAreFeaturesAndNeverPruned)
{
    const shapes::Shape s = shapes::FlatGrid(10);
    const FeatureGraph g = Graph(s, 180, 1.0, MarkRow(s, 0.5, 0.3, 0.6));
    EXPECT_EQ(g.pruned, 0);
    EXPECT_EQ(g.prunedEdges, 0);
    EXPECT_NEAR(TotalLength(g), 4.3, 1e-9);
    EXPECT_EQ(g.corner.size(), 6U);
}

TEST(FeatureGraph, ShortLooseCreasesArePruned)
{
    // A ridge of length 0.4 in the middle of a sheet.
    const auto at = [](double x, double y) {
        return shapes::P{x, y, x > 0.29 && x < 0.71 ? 0.2 * std::max(0.0, 0.1 - std::abs(y - 0.5)) * 10 : 0};
    };
    const shapes::Shape s = shapes::Grid(
        10, 10, [](int, int) { return true; }, at);
    const FeatureGraph kept = Graph(s, 70, 0.1), gone = Graph(s, 70, 1.0);
    EXPECT_GT(TotalLength(kept), 4 + 0.35);
    EXPECT_NEAR(TotalLength(gone), 4, 0.05);
    EXPECT_GT(gone.pruned, 0);
    EXPECT_GE(gone.prunedEdges, 4) << "a ridge of four edges at least";
}

TEST(FeatureGraph, CreaseRunsAroundAFaceWithoutArea)
{
    // The fold of two squares with a degenerate triangle inserted at the crease.
    const shapes::Shape s = {{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}},
                             {{0, 1, 4}, {0, 4, 3}, {0, 2, 1}, {5, 2, 0}, {5, 6, 2}, {6, 1, 2}}};
    const MeshTables t = meshes::Tables(s);
    ReferenceSurface surface(t.position, t.face);
    MarkFeatures(surface, 40, {});
    EXPECT_FALSE(surface.mesh.Constrained(surface.mesh.FindEdge(0, 1)));
    EXPECT_TRUE(surface.mesh.Constrained(surface.mesh.FindEdge(0, 2)));
    EXPECT_TRUE(surface.mesh.Constrained(surface.mesh.FindEdge(2, 1)));
}

} // namespace
} // namespace feature_graph_test
