// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/refinement.h>

#include <algorithm>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/verification.h>

#include "support/meshes.h"

namespace refinement_test {
namespace {

using namespace vcg::ccdm;

TEST(Refinement, QuartersEveryTriangleOnTheSurface)
{
    for (const shapes::Shape &s :
         {shapes::Bumpy(2), shapes::KleinBottle(16, 8), shapes::Plate(12), shapes::CadPart()}) {
        const Model model = meshes::MakeModel(s, 30000, 40);
        Remesh r = meshes::AsRemesh(model);
        const TopologyCounts before = VerifyTriangulation(r.mesh).counts;
        Refinement(model, r).Run();
        const Verification v = VerifyTriangulation(r.mesh);
        EXPECT_EQ(v.fault, "");
        EXPECT_TRUE(v.counts.SameTypeAs(before));
        EXPECT_EQ(v.counts.faces, 4 * before.faces);
        EXPECT_EQ(v.counts.vertices, before.vertices + before.edges);
        for (int k = 0; k < r.VertexCount(); ++k)
            EXPECT_LT(model.surface.NearestOn(r.place[k].face, r.position[k]).squaredDistance, 1e-20);
    }
}

TEST(Refinement, HalvesFeatureEdges)
{
    const Model model = meshes::MakeModel(shapes::Box(1, 2, 3), 800, 40);
    Remesh r = meshes::AsRemesh(model);
    Refinement(model, r).Run();
    int constrained = 0;
    for (int t = 0; t < r.mesh.TriangleCount(); ++t)
        for (int e = 0; e < 3; ++e)
            constrained += r.mesh.Constrained(MakeSide(t, e));
    EXPECT_EQ(constrained, 2 * 24) << "two sides of the twelve edges' halves";
}

TEST(Refinement, PutsNoVerticesBetweenFeaturesThatAreCloseTogether)
{
    for (const shapes::Shape &s : {shapes::Box(4, 4, 0.3), shapes::Plate(12)}) {
        const Model model = meshes::MakeModel(s, 200, 40);
        Remesh r = meshes::AsRemesh(model);
        const TopologyCounts before = VerifyTriangulation(r.mesh).counts;
        Refinement refinement(model, r);
        const int foretold = refinement.CountAfter();
        EXPECT_LT(foretold, before.vertices + before.edges);
        refinement.Run();
        const Verification v = VerifyTriangulation(r.mesh);
        EXPECT_EQ(v.fault, "");
        EXPECT_TRUE(v.counts.SameTypeAs(before));
        EXPECT_EQ(v.counts.vertices, foretold);
    }
}

TEST(Refinement, PutsVerticesBetweenFeaturesOnTheirOwnSide)
{
    // All eight vertices are corners, each known by one of the faces around it.
    const Model model = meshes::MakeModel(shapes::Box(8, 8, 1), 20000, 40);
    Remesh r = meshes::AsRemesh(model);
    std::vector<Point> middle;
    for (int t = 0; t < r.mesh.TriangleCount(); ++t)
        for (int e = 0; e < 3; ++e) {
            const Side s = MakeSide(t, e);
            if (!r.mesh.Constrained(s))
                middle.push_back((r.position[r.mesh.Tail(s)] + r.position[r.mesh.Head(s)]) / 2);
        }
    ASSERT_EQ(middle.size(), 2U * 6);
    Refinement(model, r).Run();
    for (const Point &p : middle) {
        int there = 0;
        for (int v = 0; v < r.VertexCount(); ++v)
            there += SquaredNorm(r.position[v] - p) < 1e-20 && r.place[v].kind == VertexKind::Free &&
                     model.surface.NearestOn(r.place[v].face, p).squaredDistance < 1e-20;
        EXPECT_EQ(there, 1) << p[0] << ", " << p[1] << ", " << p[2];
    }
}

TEST(Refinement, HalvesNoCreaseThatIsShorterThanTheSpacing)
{
    // The spacing is above the height of the box: its upright edges stay whole.
    const shapes::Shape box = shapes::Box(8, 8, 1);
    const Model model = meshes::MakeModel(box, 40, 40);
    ASSERT_GT(model.density.spacing[0], 1.5);
    Remesh r = meshes::AsRemesh(model);
    Refinement(model, r).Run();
    int upright = 0;
    for (int t = 0; t < r.mesh.TriangleCount(); ++t)
        for (int e = 0; e < 3; ++e) {
            const Side s = MakeSide(t, e);
            const Point d = r.position[r.mesh.Head(s)] - r.position[r.mesh.Tail(s)];
            upright += r.mesh.Constrained(s) && std::abs(d[2]) > 0.999;
        }
    EXPECT_EQ(upright, 2 * 4) << "two sides of the four edges";
}

TEST(Refinement, LeavesNoMoreThanItMay)
{
    const Model model = meshes::MakeModel(shapes::Bumpy(3), 642, 180);
    Remesh r = meshes::AsRemesh(model);
    Refinement(model, r).Run(meshes::Alone(), 2500);
    EXPECT_EQ(r.VertexCount(), 2500) << "not the 2562 that quartering makes";
    EXPECT_EQ(VerifyTriangulation(r.mesh).fault, "");
}

TEST(Refinement, SplitsTheLongestEdgesWhereverTheyAre)
{
    // Twenty runs of triangles are looked through apart.
    const Model model = meshes::MakeModel(shapes::Sphere(6), 40962, 180);
    Workers two(2);
    std::vector<Point> position[2];
    for (int k = 0; k < 2; ++k) {
        Remesh r = meshes::AsRemesh(model);
        Relocator(model, r).Sweep(Perturbation{0.3, 1});
        std::vector<double> squared;
        r.mesh.VisitEdges(
            [&](Side s) { squared.push_back(SquaredNorm(r.position[r.mesh.Head(s)] - r.position[r.mesh.Tail(s)])); });
        std::nth_element(squared.begin(), squared.begin() + 9, squared.end(), std::greater<>());
        const double tenth = squared[9];
        Refinement(model, r).SplitLongest(10, k == 0 ? meshes::Alone() : two);
        ASSERT_EQ(r.VertexCount(), 40962 + 10);
        int left = 0;
        r.mesh.VisitEdges([&](Side s) {
            left += r.mesh.Tail(s) < 40962 && r.mesh.Head(s) < 40962 &&
                    SquaredNorm(r.position[r.mesh.Head(s)] - r.position[r.mesh.Tail(s)]) >= tenth;
        });
        EXPECT_EQ(left, 0);
        position[k] = r.position;
    }
    EXPECT_EQ(position[0], position[1]);
}

TEST(Refinement, SplitsAndSorts)
{
    const Model model = meshes::MakeModel(shapes::Bumpy(3), 642, 180);
    Remesh r = meshes::AsRemesh(model);
    Refinement refinement(model, r);
    refinement.SplitLongest(3, meshes::Alone());
    EXPECT_EQ(r.VertexCount(), 645);
    refinement.Sort(meshes::Alone());
    EXPECT_EQ(VerifyTriangulation(r.mesh).fault, "");
    EXPECT_EQ(VerifyTriangulation(r.mesh).counts.euler, 2);
}

} // namespace
} // namespace refinement_test
