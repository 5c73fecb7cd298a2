// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/mesh_quality.h>

#include <new>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/geometry.h>

#include "support/meshes.h"

namespace mesh_quality_test {
namespace {

using meshes::MeshD;
using meshes::MeshF;
using vcg::tri::MeshQualityReport;

template <class MeshType>
MeshQualityReport Measured(const shapes::Shape &s)
{
    MeshType m;
    meshes::Fill(m, s);
    return vcg::tri::MeshQuality<MeshType>::Measure(m);
}

TEST(MeshQuality, EquilateralTriangleIsPerfect)
{
    const auto q = Measured<MeshD>({{{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(3.0) / 2, 0}}, {{0, 1, 2}}});
    EXPECT_NEAR(q.angleMinAvg, 60, 1e-9);
    EXPECT_NEAR(q.angleMax, 60, 1e-9);
    EXPECT_NEAR(q.qFb99Avg, 1, 1e-12);
    EXPECT_NEAR(q.area, std::sqrt(3.0) / 4, 1e-12);
    EXPECT_EQ(q.boundaryLoops, 1);
    EXPECT_EQ(q.euler, 1);
}

TEST(MeshQuality, RightTriangleHasKnownAspectRatio)
{
    // Sides 3, 4, 5: 2 sqrt(3) * 6 / (6 * 5).
    const auto q = Measured<MeshD>({{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}});
    EXPECT_NEAR(q.qFb99Min, 2 * std::sqrt(3.0) / 5, 1e-12);
    EXPECT_NEAR(q.angleMin, std::atan2(3, 4) * 180 / M_PI, 1e-9);
    EXPECT_EQ(q.pctLt30, 0);
}

TEST(MeshQuality, NeedleCountsAsSmallAngle)
{
    const auto q = Measured<MeshD>({{{0, 0, 0}, {1, 0, 0}, {1, 0.1, 0}}, {{0, 1, 2}}});
    EXPECT_NEAR(q.pctLt30, 100.0 / 3, 1e-9);
}

struct TypeCase {
    const char *name;
    shapes::Shape shape;
    int euler, components, loops;
    bool orientable;
    double genus;
};

TEST(MeshQuality, TopologyOfKnownSurfaces)
{
    const TypeCase cases[] = {
        {"tetrahedron", shapes::Tetrahedron(), 2, 1, 0, true, 0},
        {"sphere", shapes::Sphere(2), 2, 1, 0, true, 0},
        {"torus", shapes::RoundTorus(12, 8), 0, 1, 0, true, 1},
        {"cad", shapes::CadPart(), -2, 1, 0, true, 2},
        {"genus 9", shapes::HighGenus(1), -16, 1, 0, true, 9},
        {"plate", shapes::Plate(40), -2, 1, 4, true, 0},
        {"klein", shapes::KleinBottle(12, 8), 0, 1, 0, false, 2},
        {"moebius", shapes::MoebiusStrip(12, 3), 0, 1, 1, false, 1},
        {"two", shapes::TwoComponents(), 2, 2, 0, true, 1},
    };
    for (const TypeCase &c : cases) {
        SCOPED_TRACE(c.name);
        for (const auto &q : {Measured<MeshD>(c.shape), Measured<MeshF>(c.shape)}) {
            EXPECT_EQ(q.euler, c.euler);
            EXPECT_EQ(q.components, c.components);
            EXPECT_EQ(q.boundaryLoops, c.loops);
            EXPECT_EQ(q.orientable, c.orientable);
            ASSERT_TRUE(q.genus.has_value());
            EXPECT_EQ(*q.genus, c.genus);
            EXPECT_TRUE(q.manifold);
        }
    }
}

TEST(MeshQuality, FindsWhatIsNotManifold)
{
    const shapes::Shape fin = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                               {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
    EXPECT_EQ(Measured<MeshD>(fin).nonManifoldEdges, 1);
    EXPECT_FALSE(Measured<MeshD>(fin).manifold);
    const shapes::Shape bowTie = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 4, 3}}};
    EXPECT_EQ(Measured<MeshD>(bowTie).nonManifoldVertices, 1);
    EXPECT_EQ(Measured<MeshD>(bowTie).boundaryLoops, 2);
    EXPECT_FALSE(Measured<MeshD>(bowTie).genus.has_value());
    const shapes::Shape twice = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
    EXPECT_FALSE(Measured<MeshD>(twice).manifold);
}

TEST(MeshQuality, CountsFoldsAndUnreferencedVertices)
{
    const shapes::Shape fold = {{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 1, 0.05}, {9, 9, 9}}, {{0, 1, 2}, {1, 0, 3}}};
    const auto q = Measured<MeshD>(fold);
    EXPECT_EQ(q.foldedEdges, 1);
    EXPECT_EQ(q.unreferenced, 1);
    EXPECT_EQ(Measured<MeshD>(shapes::FlatGrid(4)).foldedEdges, 0);
}

TEST(MeshQuality, ValenceOfTheInterior)
{
    EXPECT_EQ(Measured<MeshD>(shapes::FlatGrid(6)).pctValence6, 100);
    EXPECT_EQ(Measured<MeshD>(shapes::Icosahedron()).pctValence6, 0);
}

TEST(MeshQuality, DistanceOfParallelSheets)
{
    MeshD a, b;
    meshes::Fill(a, shapes::FlatGrid(4));
    shapes::Shape lifted = shapes::FlatGrid(7);
    for (auto &p : lifted.points)
        p[2] = 0.25;
    meshes::Fill(b, lifted);
    const auto d = vcg::tri::MeshQuality<MeshD>::Distance(a, b, 5000);
    EXPECT_NEAR(d.hausdorff, 0.25 / std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(d.rms, 0.25 / std::sqrt(2.0), 1e-9);
    EXPECT_EQ(vcg::tri::MeshQuality<MeshD>::Distance(a, a, 5000).hausdorff, 0);
}

vcg::tri::TriangleSoup Soup(const shapes::Shape &s)
{
    vcg::tri::TriangleSoup r;
    for (const shapes::P &p : s.points)
        r.point.push_back({p[0], p[1], p[2]});
    for (const shapes::F &f : s.faces)
        r.face.push_back({f[0], f[1], f[2]});
    return r;
}

TEST(TriangleTree, FindsTheNearestTriangle)
{
    // The last has triangles that are next to needles.
    shapes::Shape squeezed = shapes::Bumpy(3);
    for (auto &p : squeezed.points)
        p[2] *= 1e-7;
    for (const shapes::Shape &shape : {shapes::Bumpy(3), shapes::HighGenus(1), squeezed}) {
        const vcg::tri::TriangleSoup soup = Soup(shape);
        const vcg::tri::TriangleTree tree(soup);
        vcg::ccdm::Random random(3);
        int hint = -1;
        for (int i = 0; i < 500; ++i) {
            const double x = 3 * random.Unit() - 1.5, y = 3 * random.Unit() - 1.5, z = 3 * random.Unit() - 1.5;
            double nearest = 1e300;
            for (const auto &f : soup.face) {
                const auto &a = soup.point[f[0]], &b = soup.point[f[1]], &c = soup.point[f[2]];
                const vcg::ccdm::Point origin(a[0], a[1], a[2]);
                nearest = std::min(nearest, vcg::ccdm::NearestOnTriangle(
                                                origin, vcg::ccdm::Point(b[0], b[1], b[2]) - origin,
                                                vcg::ccdm::Point(c[0], c[1], c[2]) - origin, vcg::ccdm::Point(x, y, z))
                                                .squaredDistance);
            }
            const double found = tree.SquaredDistance({x, y, z}, hint);
            ASSERT_NEAR(found, nearest, 1e-9 * nearest);
            ASSERT_EQ(tree.SquaredDistanceFrom(hint, {x, y, z}), found);
        }
    }
}

TEST(DeviationMeter, FindsAPitInAPlateau)
{
    // Everywhere nearly as far as at the furthest place, in each of 128 faces.
    for (const double gap : {0.02, 0.05, 0.1}) {
        const vcg::tri::TriangleSoup plate = Soup(shapes::FlatGrid(8));
        vcg::tri::TriangleSoup pitted = Soup(shapes::FlatGrid(300));
        constexpr double x0 = 0.46, y0 = 0.54;
        for (auto &p : pitted.point)
            p[2] = gap * (1 + 0.3 * std::max(0.0, 1 - std::hypot(p[0] - x0, p[1] - y0) / 0.012));
        const vcg::tri::TriangleTree tree(pitted);
        double furthest = 0;
        int hint = -1;
        for (int i = -100; i <= 100; ++i)
            for (int j = -100; j <= 100; ++j)
                furthest = std::max(furthest, tree.SquaredDistance({x0 + 2e-4 * i, y0 + 2e-4 * j, 0}, hint));
        furthest = std::sqrt(furthest);
        ASSERT_GT(furthest, 1.002 * gap);
        EXPECT_GE(vcg::tri::DeviationMeter(plate, tree).Measure(3000).max, 0.999 * furthest) << gap;
    }
}

TEST(MeshQuality, DistanceIsTheLargerDirection)
{
    // A sheet against its left half: the far edge is 0.5 away one way only.
    MeshD whole, half;
    meshes::Fill(whole, shapes::FlatGrid(8));
    meshes::Fill(half, shapes::Cut(shapes::FlatGrid(8), [](const shapes::P &c) { return c[0] < 0.5; }));
    const auto d = vcg::tri::MeshQuality<MeshD>::Distance(whole, half, 20000);
    EXPECT_NEAR(d.hausdorffForward, 0.5 / std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(d.hausdorffBackward, 0, 1e-12);
    // Mean square of a distance that grows from 0 to 0.5 over half of the area.
    EXPECT_NEAR(d.rms, std::sqrt(0.25 / 3 / 2) / std::sqrt(2.0), 2e-3);
}

TEST(MeshQuality, ComparisonIsThatOfItsPartsOnOneThreadAndOnTwo)
{
    MeshD a, b;
    meshes::Fill(a, shapes::KleinBottle(40, 20)); // it crosses itself
    meshes::Fill(b, shapes::KleinBottle(30, 14));
    using Quality = vcg::tri::MeshQuality<MeshD>;
    for (const bool parallel : {false, true}) {
        const vcg::tri::MeshComparison c = Quality::Compare(a, b, false, parallel);
        EXPECT_EQ(c.before.angleMinAvg, Quality::Measure(a).angleMinAvg);
        EXPECT_EQ(c.after.angleMinAvg, Quality::Measure(b).angleMinAvg);
        EXPECT_GT(c.distance.rms, 0);
        EXPECT_EQ(c.distance.hausdorff, Quality::Distance(a, b).hausdorff);
        EXPECT_EQ(c.distance.rms, Quality::Distance(a, b).rms);
        EXPECT_GT(c.selfIntersections.before, 0);
        EXPECT_EQ(c.selfIntersections.before, Quality::CountSelfIntersections(a, b).before);
        EXPECT_EQ(c.selfIntersections.after, Quality::CountSelfIntersections(a, b).after);
        EXPECT_EQ(c.selfIntersections.newFaces, Quality::CountSelfIntersections(a, b).newFaces);
    }
}

TEST(TwoAtATime, PassesOnWhatEitherThrowsOnceBothHaveEnded)
{
    for (const bool parallel : {false, true}) {
        bool ended = false;
        EXPECT_THROW(vcg::tri::TwoAtATime(
                         parallel, [&] { ended = true; }, [] { throw std::bad_alloc(); }),
                     std::bad_alloc);
        EXPECT_TRUE(ended);
        EXPECT_THROW(vcg::tri::TwoAtATime(
                         parallel, [] { throw std::bad_alloc(); }, [] {}),
                     std::bad_alloc);
    }
}

TEST(MeshQuality, DistanceFarFromTheOriginAndAtAnySize)
{
    // Moved by what rounds nothing, and scaled by a power of two: the same bits come out. Boxes of single precision
    // around the points as they are would overlap all over far away, and would be empty at the smallest size.
    const auto rounded = [](shapes::Shape s, double scale, double offset) {
        for (auto &p : s.points)
            for (double &x : p)
                x = (std::round(x * 0x1p20) * 0x1p-20 + offset) * scale;
        return s;
    };
    const auto distance = [&](double scale, double offset) {
        MeshD a, b;
        meshes::Fill(a, rounded(shapes::Sphere(4), scale, offset));
        meshes::Fill(b, rounded(shapes::Bumpy(3), scale, offset));
        return vcg::tri::MeshQuality<MeshD>::Distance(a, b, 5000);
    };
    const auto wanted = distance(1, 0);
    EXPECT_GT(wanted.rms, 0);
    for (const auto &[scale, offset] :
         {std::pair(1.0, 0x1p24), std::pair(0x1p-90, 0.0), std::pair(0x1p-400, 0.0), std::pair(0x1p300, 0x1p10)}) {
        const auto got = distance(scale, offset);
        EXPECT_EQ(got.hausdorffForward, wanted.hausdorffForward) << scale << ' ' << offset;
        EXPECT_EQ(got.hausdorffBackward, wanted.hausdorffBackward) << scale << ' ' << offset;
        EXPECT_EQ(got.rms, wanted.rms) << scale << ' ' << offset;
    }
}

TEST(MeshQuality, DistanceBetweenMeshTypes)
{
    MeshD d;
    MeshF f;
    meshes::Fill(d, shapes::Sphere(4));
    meshes::Fill(f, shapes::Sphere(2));
    const auto r = vcg::tri::MeshQuality<MeshD>::Distance(d, f, 20000);
    // Sagitta over the middle of the coarse sphere's triangles: edge^2 / 6 with edges of about 0.31, over a
    // diagonal of about 3.4.
    EXPECT_NEAR(r.hausdorff, 0.0047, 0.0007);
    EXPECT_LT(r.rms, r.hausdorff);
}

} // namespace
} // namespace mesh_quality_test
