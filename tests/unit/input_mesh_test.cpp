// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/input_mesh.h>

#include <limits>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace input_mesh_test {
namespace {

using namespace vcg::ccdm;

InputMesh Prepared(const shapes::Shape &s)
{
    return InputMesh(meshes::Tables(s));
}

TEST(InputMesh, AcceptsEverySoundSurface)
{
    for (const shapes::Shape &s : {shapes::Tetrahedron(), shapes::CadPart(), shapes::KleinBottle(12, 8),
                                   shapes::MoebiusStrip(9, 2), shapes::Plate(20), shapes::TwoComponents()}) {
        const InputMesh m = Prepared(s);
        EXPECT_EQ(m.refusal, "");
        EXPECT_EQ(m.mesh.face.size(), s.faces.size());
        EXPECT_EQ(m.topology.faces, static_cast<int>(s.faces.size()));
    }
}

TEST(InputMesh, RefusesWithCounts)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    EXPECT_NE(Prepared({}).refusal, "");
    EXPECT_NE(Prepared({{{0, 0, 0}, {1, 0, 0}}, {}}).refusal, "");
    shapes::Shape bad = shapes::Sphere(1);
    bad.points[3][1] = nan;
    bad.points[7][2] = inf;
    EXPECT_EQ(Prepared(bad).defects.nonFiniteVertices, 2);
    EXPECT_NE(Prepared(bad).refusal, "");
    const shapes::Shape fin = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                               {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
    EXPECT_EQ(Prepared(fin).defects.nonManifoldEdges, 1);
    EXPECT_NE(Prepared(fin).refusal.find("1 edge"), std::string::npos);
    const shapes::Shape bowTie = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 4, 3}}};
    EXPECT_EQ(Prepared(bowTie).defects.nonManifoldVertices, 1);
    EXPECT_NE(Prepared(bowTie).refusal, "");
    const shapes::Shape twice = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
    EXPECT_EQ(Prepared(twice).defects.duplicateFaces, 1);
    EXPECT_NE(Prepared(twice).refusal, "");
    EXPECT_NE(Prepared({{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}}}).refusal, "");
    EXPECT_NE(Prepared({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}).refusal, "");
    MeshTables field = meshes::Tables(shapes::Sphere(1));
    field.field.assign(field.position.size(), 1.0);
    field.field[4] = -1;
    EXPECT_EQ(InputMesh(field).defects.badDensityVertices, 1);
    EXPECT_NE(InputMesh(field).refusal, "");
}

TEST(InputMesh, DropsWhatIsHarmless)
{
    shapes::Shape s = shapes::Sphere(1);
    s.Add(std::numeric_limits<double>::quiet_NaN(), 9, 9); // unreferenced: its position does not matter
    s.faces.push_back({3, 3, 5});
    const InputMesh m = Prepared(s);
    EXPECT_EQ(m.refusal, "");
    EXPECT_EQ(m.defects.unreferencedVertices, 1);
    EXPECT_EQ(m.defects.repeatedIndexFaces, 1);
    EXPECT_EQ(m.mesh.position.size(), s.points.size() - 1);
}

TEST(InputMesh, OrientsCoherently)
{
    shapes::Shape s = shapes::Sphere(2);
    for (std::size_t t = 0; t < s.faces.size(); t += 3)
        std::swap(s.faces[t][1], s.faces[t][2]);
    const InputMesh m = Prepared(s);
    Triangulation t;
    t.Build(static_cast<int>(m.mesh.position.size()), m.mesh.face);
    for (int k = 0; k < t.TriangleCount(); ++k)
        for (int e = 0; e < 3; ++e)
            EXPECT_TRUE(t.Coherent(MakeSide(k, e)));
}

TEST(InputMesh, DoesNotDependOnTheNumbering)
{
    const shapes::Shape s = shapes::Bumpy(2);
    shapes::Shape shuffled;
    const int n = static_cast<int>(s.points.size());
    const auto id = [&](int v) { return (v * 5 + 3) % n; };
    ASSERT_NE(n % 5, 0);
    shuffled.points.resize(n);
    for (int v = 0; v < n; ++v)
        shuffled.points[id(v)] = s.points[v];
    for (auto f = s.faces.rbegin(); f != s.faces.rend(); ++f)
        shuffled.faces.push_back({id((*f)[1]), id((*f)[2]), id((*f)[0])});
    const InputMesh a = Prepared(s), b = Prepared(shuffled);
    EXPECT_EQ(a.mesh.position, b.mesh.position);
    EXPECT_EQ(a.mesh.face, b.mesh.face);
}

TEST(InputMesh, RestoresCoordinates)
{
    shapes::Shape s = shapes::Sphere(2);
    for (auto &p : s.points)
        p = {1e7 + 1e-3 * p[0], 1e7 + 1e-3 * p[1], -1e7 + 1e-3 * p[2]};
    const InputMesh m = Prepared(s);
    EXPECT_EQ(m.refusal, "");
    for (std::size_t v = 0; v < m.original.size(); ++v)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(m.Restore(m.mesh.position[v])[k], s.points[m.original[v]][k]);
}

} // namespace
} // namespace input_mesh_test
