// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/initial_mesh.h>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/verification.h>

#include "support/meshes.h"

namespace initial_mesh_test {
namespace {

using namespace vcg::ccdm;

struct Built {
    Model model;
    Remesh remesh;
};

Built Build(const shapes::Shape &s, int n, double angle, unsigned seed = 1)
{
    Built b;
    b.model = meshes::MakeModel(s, n, angle);
    Random random(seed);
    SampleSet samples;
    samples.onCurves = SampleCurves(b.model.surface, b.model.features, b.model.density);
    const int onFeatures = static_cast<int>(samples.onCurves.size() + b.model.features.corner.size());
    samples.onFaces = SampleFaces(b.model.surface, b.model.density, std::max(0, n - onFeatures), random);
    EXPECT_TRUE(InitialMeshBuilder(b.model, samples).Build(b.remesh, [](double) { return true; }));
    return b;
}

TEST(InitialMesh, HasTheWantedCountAndTheInputsTopology)
{
    const struct {
        const char *name;
        shapes::Shape shape;
        double angle;
    } cases[] = {{"bumpy", shapes::Bumpy(4), 180},           {"cad", shapes::CadPart(), 40},
                 {"twisted", shapes::TwistedBar(60, 3), 60}, {"klein", shapes::KleinBottle(50, 30), 180},
                 {"plate", shapes::Plate(30), 60},           {"moebius", shapes::MoebiusStrip(60, 6), 180},
                 {"genus", shapes::HighGenus(2), 180},       {"noisy", shapes::Bust(4, 0.02), 180}};
    for (const auto &c : cases)
        for (const int n : {400, 3000}) {
            SCOPED_TRACE(std::string(c.name) + " " + std::to_string(n));
            const Built b = Build(c.shape, n, c.angle);
            const Verification before = VerifyTriangulation(b.model.surface.mesh),
                               after = VerifyTriangulation(b.remesh.mesh);
            EXPECT_EQ(after.fault, "");
            EXPECT_TRUE(after.counts.SameTypeAs(before.counts));
            EXPECT_EQ(b.remesh.VertexCount(), n);
            for (int v = 0; v < n; ++v)
                EXPECT_LT(b.model.surface.NearestOn(b.remesh.place[v].face, b.remesh.position[v]).squaredDistance,
                          1e-18);
        }
}

TEST(InitialMesh, IsTheSameForAnyNumberOfThreadsWhereThereAreRegions)
{
    const int n = 20000;
    const Model model = meshes::MakeModel(shapes::Together(shapes::Bumpy(6), shapes::Bumpy(6), 0.7), n, 60);
    ASSERT_GT(Regions::Count(static_cast<int>(model.surface.position.size())), 2);
    Random random(1);
    SampleSet samples;
    samples.onFaces = SampleFaces(model.surface, model.density, n, random);
    Remesh first;
    for (const int threads : {1, 2, 4}) {
        Workers workers(threads);
        Remesh r;
        ASSERT_TRUE(InitialMeshBuilder(model, samples).Build(r, workers, [](double) { return true; }));
        const Verification after(r.mesh, workers);
        EXPECT_EQ(after.fault, "");
        EXPECT_EQ(after.counts.euler, 4);
        EXPECT_EQ(r.VertexCount(), n);
        if (threads == 1)
            first = r;
        EXPECT_EQ(r.position, first.position) << threads;
        EXPECT_TRUE(meshes::SameTriangles(r, first)) << threads;
    }
}

TEST(InitialMesh, FeaturesStayChainsOfMarkedEdges)
{
    const Built b = Build(shapes::CadPart(), 2000, 40);
    double marked = 0, wanted = 0;
    for (int t = 0; t < b.remesh.mesh.TriangleCount(); ++t)
        for (int e = 0; e < 3; ++e) {
            const Side s = MakeSide(t, e);
            if (!b.remesh.mesh.Constrained(s) || b.remesh.mesh.Mate(s) < s)
                continue;
            marked += Norm(b.remesh.position[b.remesh.mesh.Tail(s)] - b.remesh.position[b.remesh.mesh.Head(s)]);
            EXPECT_NE(b.remesh.place[b.remesh.mesh.Tail(s)].kind, VertexKind::Free);
            EXPECT_NE(b.remesh.place[b.remesh.mesh.Head(s)].kind, VertexKind::Free);
        }
    for (const FeatureCurve &c : b.model.features.curve)
        wanted += c.Length();
    EXPECT_NEAR(marked / wanted, 1, 0.01);
}

TEST(InitialMesh, TopologyForcesMoreThanFourOnATorus)
{
    const Built b = Build(shapes::RoundTorus(24, 16), 4, 180);
    EXPECT_GE(b.remesh.VertexCount(), 7);
    EXPECT_EQ(VerifyTriangulation(b.remesh.mesh).fault, "");
}

TEST(InitialMesh, ManySamplesInOneFace)
{
    const Built b = Build(shapes::Box(1, 1, 1), 5000, 40);
    EXPECT_EQ(b.remesh.VertexCount(), 5000);
    EXPECT_EQ(VerifyTriangulation(b.remesh.mesh).counts.euler, 2);
}

TEST(InitialMesh, StopsWhenAsked)
{
    const Model model = meshes::MakeModel(shapes::Bumpy(3), 300, 180);
    Random random(1);
    SampleSet samples;
    samples.onFaces = SampleFaces(model.surface, model.density, 300, random);
    Remesh r;
    EXPECT_FALSE(InitialMeshBuilder(model, samples).Build(r, [](double) { return false; }));
    int calls = 0;
    EXPECT_FALSE(InitialMeshBuilder(model, samples).Build(r, [&](double) { return ++calls < 3; }));
    EXPECT_EQ(calls, 3);
}

} // namespace
} // namespace initial_mesh_test
