// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/input_repair.h>

#include "support/meshes.h"

namespace input_repair_test {
namespace {

using namespace vcg::ccdm;

// Every face with vertices of its own.
shapes::Shape Soup(const shapes::Shape &s)
{
    shapes::Shape soup;
    for (const shapes::F &f : s.faces) {
        const int n = static_cast<int>(soup.points.size());
        for (const int v : f)
            soup.points.push_back(s.points[v]);
        soup.faces.push_back({n, n + 1, n + 2});
    }
    return soup;
}

struct Outcome {
    std::string refusal;
    InputDefects defects;
    TopologyCounts topology;
};

Outcome Taken(const MeshTables &input, RepairKind kind = RepairKind::Harmless)
{
    Workers workers(1);
    SoundInput sound(input, kind, workers);
    return {sound.Prepared().refusal, sound.Prepared().defects, sound.Prepared().topology};
}

Outcome Taken(const shapes::Shape &s, RepairKind kind = RepairKind::Harmless)
{
    return Taken(meshes::Tables(s), kind);
}

const shapes::Shape Fin = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
const shapes::Shape BowTie = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 4, 3}}};

TEST(InputRepair, SewsSoupsOfEveryKind)
{
    for (const shapes::Shape &s :
         {shapes::Sphere(2), shapes::CadPart(), shapes::KleinBottle(12, 8), shapes::Plate(10)}) {
        const Outcome sound = Taken(s), sewn = Taken(Soup(s));
        EXPECT_EQ(sewn.refusal, "");
        EXPECT_TRUE(sewn.topology.SameTypeAs(sound.topology));
        EXPECT_EQ(sewn.topology.vertices, sound.topology.vertices);
        EXPECT_EQ(sewn.defects.mergedVertices, static_cast<int>(3 * s.faces.size()) - sound.topology.vertices);
        EXPECT_EQ(sewn.defects.unreferencedVertices, 0);
    }
}

TEST(InputRepair, LeavesWhatTouchesWithoutGoingOn)
{
    // Three sheets that meet at the positions of one edge: which two belong together cannot be known.
    const Outcome sheets = Taken(Soup(Fin));
    EXPECT_EQ(sheets.refusal, "");
    EXPECT_EQ(sheets.topology.components, 3);
    EXPECT_EQ(sheets.defects.mergedVertices, 0);
    // Two sheets at one point, two closed boxes with a side in common.
    EXPECT_EQ(Taken(Soup(BowTie)).topology.components, 2);
    const Outcome boxes = Taken(shapes::Together(shapes::Box(1, 1, 1), shapes::Box(1, 1, 1), 1));
    EXPECT_EQ(boxes.topology.components, 2);
    EXPECT_EQ(boxes.defects.mergedVertices, 0);
}

TEST(InputRepair, LeavesPartsOfALargerMesh)
{
    MeshTables part = meshes::Tables(Soup(shapes::Sphere(1)));
    part.locked.assign(part.face.size(), 0);
    EXPECT_EQ(Taken(part).topology.components, static_cast<int>(part.face.size()));
}

TEST(InputRepair, DropsFacesThatRepeatOthers)
{
    shapes::Shape s = shapes::Sphere(2);
    s.faces.push_back(s.faces[7]);
    s.faces.push_back({s.faces[9][1], s.faces[9][0], s.faces[9][2]});
    const Outcome taken = Taken(s);
    EXPECT_EQ(taken.refusal, "");
    EXPECT_EQ(taken.defects.duplicateFaces, 2);
    EXPECT_EQ(taken.defects.repeatedIndexFaces, 0);
    EXPECT_TRUE(taken.topology.SameTypeAs(Taken(shapes::Sphere(2)).topology));
    const Outcome pillow = Taken(shapes::Shape{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}});
    EXPECT_EQ(pillow.defects.duplicateFaces, 1);
    EXPECT_NE(pillow.refusal.find("vertices 0-1-2"), std::string::npos) << pillow.refusal;
}

TEST(InputRepair, RefusesWithTheFirstPlaces)
{
    const Outcome fin = Taken(Fin);
    EXPECT_NE(fin.refusal.find("1 edge has more than two faces: vertices 0-1"), std::string::npos) << fin.refusal;
    EXPECT_EQ(fin.defects.refusedEdges, (std::vector<std::array<int, 2>>{{0, 1}}));
    EXPECT_NE(Taken(BowTie).refusal.find(": vertex 0"), std::string::npos);
    EXPECT_EQ(Taken(BowTie).defects.refusedVertices, std::vector<int>{0});
    shapes::Shape bad = shapes::Sphere(2);
    for (int v = 20; v < 40; v += 2)
        bad.points[v][1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(Taken(bad).refusal.find(": vertices 20, 22, 24, 26, 28 and 5 more"), std::string::npos);
    EXPECT_EQ(Taken(bad).defects.refusedVertices.size(), 10U);
    // A part of a mesh is spoken of in the numbers of the whole.
    MeshTables named = meshes::Tables(BowTie);
    named.vertexName = {107, 101, 102, 103, 104};
    EXPECT_NE(Taken(named).refusal.find(": vertex 107"), std::string::npos);
}

TEST(InputRepair, CutsApartOnRequest)
{
    const Outcome fin = Taken(Fin, RepairKind::Split);
    EXPECT_EQ(fin.refusal, "");
    EXPECT_EQ(fin.topology.components, 3);
    EXPECT_EQ(fin.defects.nonManifoldEdges, 1);
    EXPECT_EQ(fin.defects.nonManifoldVertices, 2);
    EXPECT_EQ(fin.defects.copiedVertices, 4);
    const Outcome tie = Taken(BowTie, RepairKind::Split);
    EXPECT_EQ(tie.refusal, "");
    EXPECT_EQ(tie.topology.components, 2);
    EXPECT_EQ(tie.defects.nonManifoldEdges, 0);
    EXPECT_EQ(tie.defects.copiedVertices, 1);
    // What is sound is not touched.
    EXPECT_EQ(Taken(shapes::CadPart(), RepairKind::Split).defects.copiedVertices, 0);
}

TEST(InputRepair, CopiesKnowTheirOriginals)
{
    MeshTables input = meshes::Tables(BowTie);
    input.field = {5, 1, 2, 3, 4};
    Workers workers(1);
    SoundInput sound(input, RepairKind::Split, workers);
    ASSERT_EQ(sound.Tables().position.size(), 6U);
    EXPECT_EQ(sound.CallersVertex(5), 0);
    EXPECT_EQ(sound.CallersVertex(3), 3);
    EXPECT_EQ(sound.Tables().field[5], 5);
    EXPECT_EQ(sound.Tables().position[5], input.position[0]);
}

TEST(InputRepair, CutsWhateverGoesOnAround)
{
    // Three faces meet at an edge, two of which go on to one another on both sides.
    shapes::Shape s = Fin;
    for (const shapes::F &f : {shapes::F{0, 2, 4}, shapes::F{1, 2, 4}})
        s.faces.push_back(f);
    EXPECT_NE(Taken(s).refusal, "");
    const Outcome cut = Taken(s, RepairKind::Split);
    EXPECT_EQ(cut.refusal, "");
    EXPECT_EQ(cut.topology.components, 2);
}

TEST(InputRepair, ContractsEdgesWithoutLength)
{
    // A vertex that stands twice: two faces more, without area.
    shapes::Shape s = shapes::Sphere(2);
    const int v = 40, copy = static_cast<int>(s.points.size());
    s.points.push_back(s.points[v]);
    std::vector<int> around;
    for (const shapes::F &f : s.faces)
        if (std::find(f.begin(), f.end(), v) != f.end())
            around.push_back(static_cast<int>(&f - s.faces.data()));
    shapes::F &one = s.faces[around[0]];
    const auto at = std::find(one.begin(), one.end(), v) - one.begin();
    const int p = one[(at + 1) % 3], q = one[(at + 2) % 3];
    *std::find(one.begin(), one.end(), v) = copy;
    s.faces.push_back({copy, p, v});
    s.faces.push_back({v, q, copy});
    const Outcome taken = Taken(s);
    EXPECT_EQ(taken.refusal, "");
    EXPECT_EQ(taken.defects.mergedVertices, 1);
    EXPECT_EQ(taken.defects.zeroAreaFaces, 2);
    EXPECT_EQ(taken.topology.vertices, copy);
    // Where that would change the type of the surface nothing is done: a ring of which one side is a point.
    shapes::Shape ring = shapes::RoundTorus(12, 8);
    for (int k = 0; k < 8; ++k)
        ring.points[k] = ring.points[0];
    EXPECT_EQ(Taken(ring).defects.mergedVertices, 0);
    EXPECT_EQ(Taken(ring).topology.euler, 0);
}

TEST(InputRepair, LeavesASheetThatIsFoldedOntoItself)
{
    shapes::Shape s = shapes::FlatGrid(6);
    for (shapes::P &p : s.points)
        p[0] = std::min(p[0], 1 - p[0]);
    const Outcome taken = Taken(s);
    EXPECT_EQ(taken.defects.mergedVertices, 0);
    EXPECT_EQ(taken.topology.boundaryLoops, 1);
}

TEST(InputRepair, TurnsTheFewerFaces)
{
    shapes::Shape s = shapes::Sphere(2);
    for (const int t : {0, 5, 17})
        std::swap(s.faces[t][1], s.faces[t][2]);
    EXPECT_EQ(Taken(s).defects.turnedFaces, 3);
    for (auto &f : s.faces)
        std::swap(f[1], f[2]);
    EXPECT_EQ(Taken(s).defects.turnedFaces, 3);
    EXPECT_EQ(Taken(shapes::Sphere(2)).defects.turnedFaces, 0);
}

} // namespace
} // namespace input_repair_test
