// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/mesh_quality.h>

#include "support/meshes.h"

namespace self_intersections_test {
namespace {

using meshes::MeshD;
using vcg::tri::SelfIntersections;
using vcg::tri::TriangleContact;
using vcg::tri::TriangleSoup;
using Vector = vcg::Point3<double>;

SelfIntersections Found(const shapes::Shape &s)
{
    MeshD m;
    meshes::Fill(m, s);
    return SelfIntersections(TriangleSoup::From(m));
}

TEST(ExactPredicates, TellWhatRoundingHides)
{
    // A point off the line through (0.5, 0.5) and (12, 12) by the last bits (Kettner et al. 2008).
    const Vector q(12, 12, 0), r(24, 24, 0);
    const double ulp = std::ldexp(1.0, -53);
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j) {
            const Vector p(0.5 + i * ulp, 0.5 + j * ulp, 0);
            EXPECT_EQ(vcg::tri::exact::Orientation(p, q, r, 0, 1), (i < j) - (i > j)) << i << ' ' << j;
        }
    // The same out of a plane.
    const Vector a(12, 12, 1), b(24, 24, -3);
    for (int i = 0; i < 8; ++i) {
        const Vector p(0.5 + i * ulp, 0.5, 0);
        EXPECT_EQ(vcg::tri::exact::Orientation(p, a, b, Vector(7, 7, 7)) != 0, i != 0);
        EXPECT_EQ(vcg::tri::exact::Orientation(p, a, b, Vector(7, 7, 7)),
                  -vcg::tri::exact::Orientation(a, p, b, Vector(7, 7, 7)));
    }
}

TEST(TriangleContact, OfTwoTriangles)
{
    const TriangleContact::Corners t = {Vector(0, 0, 0), Vector(4, 0, 0), Vector(0, 4, 0)};
    const auto meets = [&](const Vector &a, const Vector &b, const Vector &c) {
        const TriangleContact::Corners other = {a, b, c};
        EXPECT_EQ(TriangleContact::Meet(t, other), TriangleContact::Meet(other, t));
        return TriangleContact::Meet(t, other);
    };
    EXPECT_TRUE(meets({1, 1, -1}, {1, 1, 1}, {5, 5, 1}));
    EXPECT_FALSE(meets({3, 3, -1}, {3, 3, 1}, {5, 5, 1}));
    EXPECT_FALSE(meets({1, 1, 1}, {2, 1, 1}, {1, 2, 2}));
    // It touches, from above, a side and a corner.
    EXPECT_TRUE(meets({1, 1, 0}, {1, 1, 1}, {2, 2, 1}));
    EXPECT_TRUE(meets({2, 0, 0}, {2, -1, 1}, {2, -1, -1}));
    EXPECT_TRUE(meets({0, 0, -1}, {0, 0, 1}, {-1, -1, 0}));
    // In its plane: inside, across, at a corner, aside.
    EXPECT_TRUE(meets({0.5, 0.5, 0}, {1, 0.5, 0}, {0.5, 1, 0}));
    EXPECT_TRUE(meets({-1, 1, 0}, {5, 1, 0}, {5, 2, 0}));
    EXPECT_TRUE(meets({4, 0, 0}, {5, 0, 0}, {5, 1, 0}));
    EXPECT_FALSE(meets({3, 3, 0}, {4, 3, 0}, {3, 4, 0}));
}

TEST(SelfIntersections, NoneOnSoundSurfaces)
{
    for (const shapes::Shape &s : {shapes::Sphere(3), shapes::CadPart(), shapes::Box(1, 2, 3), shapes::FlatGrid(8)}) {
        const SelfIntersections found = Found(s);
        EXPECT_EQ(found.pairs, 0);
        EXPECT_TRUE(found.face.empty());
    }
}

TEST(SelfIntersections, OfFacesThatShareNothingAVertexAnEdge)
{
    // The second face stands on the first, or crosses it beyond the vertex or the edge that they share.
    const std::vector<shapes::P> corners = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const auto with = [&](std::initializer_list<shapes::P> more, const shapes::F &face) {
        shapes::Shape s = {corners, {{0, 1, 2}, face}};
        s.points.insert(s.points.end(), more);
        const auto pairs = Found(s).pairs;
        std::swap(s.faces[0], s.faces[1]);
        EXPECT_EQ(Found(s).pairs, pairs);
        return pairs;
    };
    EXPECT_EQ(with({{1, 1, -1}, {1, 1, 1}, {5, 5, 1}}, {3, 4, 5}), 1);
    EXPECT_EQ(with({{1, 1, -1}, {1, 1, 1}}, {0, 3, 4}), 1);
    EXPECT_EQ(with({{-1, -1, -1}, {-1, -1, 1}}, {0, 3, 4}), 0);
    EXPECT_EQ(with({{1, 1, 0}}, {0, 1, 3}), 1);
    EXPECT_EQ(with({{1, -1, 0}}, {0, 1, 3}), 0);
    EXPECT_EQ(with({{1, 1, 1}}, {0, 1, 3}), 0);
    EXPECT_EQ(with({}, {1, 0, 2}), 1);
    // One without area is left out.
    EXPECT_EQ(with({{2, 2, 0}}, {1, 3, 2}), 0);
}

TEST(SelfIntersections, AreTheSameOnOneThreadAndOnTwo)
{
    MeshD m;
    meshes::Fill(m, shapes::Together(shapes::Sphere(3), shapes::Bumpy(3), 0.3));
    const TriangleSoup soup = TriangleSoup::From(m);
    const SelfIntersections one(soup, false), two(soup, true);
    EXPECT_GT(one.pairs, 100);
    EXPECT_EQ(two.pairs, one.pairs);
    EXPECT_EQ(two.face, one.face);
    EXPECT_TRUE(std::is_sorted(two.face.begin(), two.face.end()));
}

TEST(SelfIntersections, OldAndNewOnes)
{
    using Quality = vcg::tri::MeshQuality<MeshD>;
    MeshD apart, crossing, finer;
    meshes::Fill(apart, shapes::Together(shapes::Sphere(2), shapes::Sphere(2), 3));
    meshes::Fill(crossing, shapes::Together(shapes::Sphere(2), shapes::Sphere(2), 1));
    meshes::Fill(finer, shapes::Together(shapes::Sphere(3), shapes::Sphere(3), 1));
    EXPECT_EQ(Quality::CountSelfIntersections(apart, apart).after, 0);
    const auto kept = Quality::CountSelfIntersections(crossing, finer);
    EXPECT_GT(kept.before, 20);
    EXPECT_GT(kept.after, kept.before);
    EXPECT_EQ(kept.newFaces, 0);
    const auto added = Quality::CountSelfIntersections(apart, crossing);
    EXPECT_EQ(added.before, 0);
    EXPECT_GT(added.newFaces, 20);
}

} // namespace
} // namespace self_intersections_test
