// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/triangulation.h>

#include <set>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/verification.h>

#include "support/meshes.h"

namespace triangulation_test {
namespace {

using namespace vcg::ccdm;

Triangulation Build(const shapes::Shape &s)
{
    Triangulation m;
    m.Build(static_cast<int>(s.points.size()), meshes::Tables(s).face);
    return m;
}

TEST(Triangulation, VerifiesKnownSurfaces)
{
    const struct {
        shapes::Shape shape;
        int euler, loops;
        bool orientable;
    } cases[] = {{shapes::Sphere(2), 2, 0, true},           {shapes::RoundTorus(9, 7), 0, 0, true},
                 {shapes::KleinBottle(11, 7), 0, 0, false}, {shapes::MoebiusStrip(9, 2), 0, 1, false},
                 {shapes::Plate(40), -2, 4, true},          {shapes::TwoComponents(), 2, 0, true}};
    for (const auto &c : cases) {
        const Verification v = VerifyTriangulation(Build(c.shape));
        EXPECT_EQ(v.fault, "");
        EXPECT_EQ(v.counts.euler, c.euler);
        EXPECT_EQ(v.counts.boundaryLoops, c.loops);
        EXPECT_EQ(v.counts.orientable, c.orientable);
        EXPECT_EQ(v.counts.vertices, static_cast<int>(c.shape.points.size()));
    }
}

TEST(Triangulation, StarsWalkInOrderOnAnySurface)
{
    for (const shapes::Shape &s : {shapes::KleinBottle(11, 7), shapes::Plate(40), shapes::MoebiusStrip(9, 2)}) {
        const Triangulation m = Build(s);
        Star star;
        for (int v = 0; v < m.VertexCount(); ++v) {
            m.GatherStar(v, star);
            ASSERT_EQ(star.outer.size(), star.corner.size() + (star.closed ? 0 : 1));
            EXPECT_EQ(star.closed, !m.OnBoundary(v));
            EXPECT_EQ(m.Valence(v), static_cast<int>(star.outer.size()));
            for (int k = 0; k < star.Triangles(); ++k) {
                const Triangle &T = m.triangle[SideTriangle(star.corner[k])];
                EXPECT_EQ((std::set<int>{T.v[0], T.v[1], T.v[2]}),
                          (std::set<int>{v, star.outer[k], star.OuterAfter(k)}));
                EXPECT_EQ(T.v[SideEdge(star.corner[k])], v);
            }
        }
    }
}

TEST(Triangulation, FlipIsItsOwnReverse)
{
    for (const shapes::Shape &s : {shapes::Sphere(2), shapes::KleinBottle(11, 9)}) {
        Triangulation m = Build(s);
        int flipped = 0;
        for (int t = 0; t < m.TriangleCount(); t += 5) {
            const Side side = MakeSide(t, t % 3);
            const int a = m.Opposite(side), b = m.Opposite(m.Mate(side)), p = m.Tail(side), q = m.Head(side);
            if (m.FindEdge(a, b) != NoSide)
                continue;
            const Side turned = m.Flip(side);
            EXPECT_EQ((std::set<int>{m.Tail(turned), m.Head(turned)}), (std::set<int>{a, b}));
            EXPECT_EQ(m.FindEdge(p, q), NoSide);
            EXPECT_EQ(VerifyTriangulation(m).fault, "");
            m.Flip(turned);
            EXPECT_NE(m.FindEdge(p, q), NoSide);
            ++flipped;
        }
        EXPECT_GT(flipped, 20);
        EXPECT_EQ(VerifyTriangulation(m).fault, "");
    }
}

TEST(Triangulation, SplitsKeepTypeAndFeatures)
{
    Triangulation m = Build(shapes::MoebiusStrip(9, 2));
    for (int t = 0; t < m.TriangleCount(); ++t)
        for (int e = 0; e < 3; ++e)
            if (m.Mate(MakeSide(t, e)) == NoSide)
                m.SetConstrained(MakeSide(t, e), true);
    const TopologyCounts before = VerifyTriangulation(m).counts;
    const auto features = [&] {
        int n = 0;
        for (int t = 0; t < m.TriangleCount(); ++t)
            for (int e = 0; e < 3; ++e)
                n += m.Constrained(MakeSide(t, e));
        return n;
    };
    const int marked = features();
    int next = m.VertexCount(), boundarySplits = 0;
    for (int t = 0; t < 12; ++t) {
        boundarySplits += m.Mate(MakeSide(t, t % 3)) == NoSide;
        m.SplitEdge(MakeSide(t, t % 3), next++);
        ASSERT_EQ(VerifyTriangulation(m).fault, "") << t;
        m.SplitTriangle(t, next++);
        ASSERT_EQ(VerifyTriangulation(m).fault, "") << t;
    }
    EXPECT_TRUE(VerifyTriangulation(m).counts.SameTypeAs(before));
    EXPECT_EQ(features(), marked + boundarySplits);
    EXPECT_GT(boundarySplits, 0);
}

TEST(Triangulation, CollapsesDownToTheSmallestSurfaces)
{
    // The least vertices of a sphere, a torus, a Klein bottle and a Moebius strip are 4, 7, 8 and 5; legal
    // collapses alone need not reach them, but must come close and never go below.
    const struct {
        shapes::Shape shape;
        int least, most;
    } cases[] = {{shapes::Sphere(1), 4, 4},
                 {shapes::RoundTorus(8, 6), 7, 10},
                 {shapes::KleinBottle(8, 6), 8, 12},
                 {shapes::MoebiusStrip(9, 3), 5, 9}};
    for (const auto &c : cases) {
        Triangulation m = Build(c.shape);
        const TopologyCounts before = VerifyTriangulation(m).counts;
        std::vector<int> stamp(m.VertexCount(), 0);
        Star scratch;
        int tick = 0, alive = m.VertexCount();
        for (bool again = true; again;) {
            again = false;
            for (int v = 0; v < m.VertexCount(); ++v) {
                Side side = NoSide;
                int target = -1;
                if (m.incident[v] >= 0)
                    m.VisitSpokes(v, [&](int w, Side s) {
                        if (side == NoSide && m.MayCollapse(v, w, s, stamp, ++tick)) {
                            side = s;
                            target = w;
                        }
                        return true;
                    });
                if (side == NoSide)
                    continue;
                m.Collapse(v, target, side, scratch);
                ASSERT_EQ(VerifyTriangulation(m).fault, "");
                --alive;
                again = true;
            }
        }
        EXPECT_GE(alive, c.least);
        EXPECT_LE(alive, c.most);
        EXPECT_TRUE(VerifyTriangulation(m).counts.SameTypeAs(before));
    }
}

TEST(Triangulation, CompactRenumbers)
{
    Triangulation m = Build(shapes::Sphere(1));
    std::vector<int> order;
    for (int v = m.VertexCount() - 1; v >= 0; --v)
        order.push_back(v);
    m.Compact(order);
    const Verification v = VerifyTriangulation(m);
    EXPECT_EQ(v.fault, "");
    EXPECT_EQ(v.counts.euler, 2);
}

TEST(Verification, FindsPlantedFaults)
{
    const auto faultAfter = [](const std::function<void(Triangulation &)> &plant) {
        Triangulation m = Build(shapes::Sphere(1));
        plant(m);
        return VerifyTriangulation(m).fault;
    };
    EXPECT_EQ(faultAfter([](Triangulation &) {}), "");
    EXPECT_NE(faultAfter([](Triangulation &m) { m.triangle[3].n[1] = m.triangle[5].n[0]; }), "");
    EXPECT_NE(faultAfter([](Triangulation &m) { m.triangle[3].n[1] = NoSide; }), "");
    EXPECT_NE(faultAfter([](Triangulation &m) { m.triangle[3].v[1] = m.triangle[3].v[0]; }), "");
    EXPECT_NE(faultAfter([](Triangulation &m) { std::swap(m.triangle[3].v[1], m.triangle[3].v[0]); }), "");
    EXPECT_NE(faultAfter([](Triangulation &m) { m.triangle[3].v[2] = 10000; }), "");
    EXPECT_NE(faultAfter([](Triangulation &m) { m.triangle[3].dead = 1; }), "");
    EXPECT_NE(faultAfter([](Triangulation &m) { m.incident[4] = -1; }), "");
    EXPECT_NE(faultAfter([](Triangulation &m) { m.triangle[3].SetConstrained(0, true); }), "");
    // A flip in a tetrahedron repeats the opposite edge; all stars stay fans.
    for (int side = 0; side < 12; ++side) {
        Triangulation m;
        m.Build(4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
        m.Flip(MakeSide(side / 3, side % 3));
        EXPECT_EQ(VerifyTriangulation(m).fault, "an edge is repeated");
    }
    // Two vertices made one: more than one fan.
    EXPECT_NE(faultAfter([](Triangulation &m) {
                  for (Triangle &T : m.triangle)
                      for (int &v : T.v)
                          v = v == 40 ? 0 : v;
                  m.incident[40] = -1;
              }),
              "");
}

} // namespace
} // namespace triangulation_test
