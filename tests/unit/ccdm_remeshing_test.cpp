// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm_remeshing.h>

#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/mesh_quality.h>

#include "support/meshes.h"

namespace ccdm_remeshing_test {
namespace {

using meshes::MeshD;
using meshes::MeshF;
using meshes::Quick;
using vcg::ccdm::Params;
using vcg::ccdm::Report;
using vcg::ccdm::Status;

template <class MeshType>
Report Remesh(MeshType &m, const Params &p, vcg::CallBackPos *cb = nullptr)
{
    return vcg::tri::CCDMRemeshing<MeshType>::Do(m, p, cb);
}

template <class MeshType>
void ExpectSoundResult()
{
    MeshType m;
    meshes::Fill(m, shapes::Bumpy(3));
    const Report r = Remesh(m, Quick(500));
    ASSERT_EQ(r.status, Status::Done) << r.message;
    EXPECT_EQ(m.VN(), 500);
    const auto q = vcg::tri::MeshQuality<MeshType>::Measure(m);
    EXPECT_EQ(q.euler, 2);
    EXPECT_TRUE(q.manifold);
    EXPECT_EQ(q.faces, r.resultTopology.faces);
    EXPECT_TRUE(r.topologyPreserved);
    EXPECT_GT(q.angleMinAvg, 50);
    EXPECT_EQ(r.energy.size(), 6U);
}

TEST(CCDMRemeshing, WorksOnDoublePrecision)
{
    ExpectSoundResult<MeshD>();
}
TEST(CCDMRemeshing, WorksOnSinglePrecisionWithOptionalComponents)
{
    ExpectSoundResult<MeshF>();
}

TEST(CCDMRemeshing, EnergyNeverRisesBetweenPins)
{
    MeshD m;
    meshes::Fill(m, shapes::Bumpy(3));
    Params p = Quick(400);
    p.globalIterations = 30;
    p.optimizer = vcg::ccdm::OptimizerKind::Annealing;
    const Report r = Remesh(m, p);
    ASSERT_EQ(r.energy.size(), 31U);
    // Only better states are kept.
    for (int k = 1; k <= 30; ++k)
        EXPECT_LE(r.energy[k], r.energy[k - 1]);
    EXPECT_LT(r.energy[30], r.energy[0]);
    EXPECT_LE(r.accepted, 30);
}

// A small box beside a large smooth surface: creases few enough for a coarse level.
TEST(CCDMRemeshing, KeepsAFewCreasesThroughTheCoarseLevel)
{
    const shapes::Shape s = shapes::Together(shapes::Bumpy(4), shapes::Box(0.3, 0.25, 0.2), 3);
    std::vector<std::array<double, 3>> first;
    for (const int threads : {1, 2}) {
        MeshD m;
        meshes::Fill(m, s);
        Params p = Quick(5000);
        p.globalIterations = 10;
        p.threads = threads;
        const Report r = Remesh(m, p);
        ASSERT_EQ(r.status, Status::Done) << r.message;
        EXPECT_EQ(m.VN(), 5000);
        EXPECT_TRUE(r.topologyPreserved);
        EXPECT_EQ(r.featureCorners, 8);
        EXPECT_EQ(r.featureCurves, 12);
        EXPECT_GT(vcg::tri::MeshQuality<MeshD>::Measure(m).pctValence6, 94) << "as only a coarse level leaves";
        std::vector<std::array<double, 3>> points;
        for (const auto &v : m.vert)
            points.push_back({v.cP()[0], v.cP()[1], v.cP()[2]});
        for (std::size_t k = s.points.size() - 8; k < s.points.size(); ++k)
            EXPECT_EQ(std::count(points.begin(), points.end(), s.points[k]), 1) << "corner " << k;
        if (threads == 1)
            first = points;
        else
            EXPECT_EQ(points, first);
    }
}

// Eighty corners of the boundary are too many for half the resolution.
TEST(CCDMRemeshing, KeepsAFixedBoundaryAtManyVertices)
{
    const shapes::Shape s = shapes::FlatGrid(20);
    for (const int n : {4500, 20000}) {
        MeshD m;
        meshes::Fill(m, s);
        Params p = Quick(n);
        p.boundary = vcg::ccdm::BoundaryKind::Fixed;
        const Report r = Remesh(m, p);
        ASSERT_EQ(r.status, Status::Done) << r.message;
        EXPECT_EQ(m.VN(), n);
        EXPECT_EQ(r.featureCorners, 80);
        EXPECT_TRUE(r.topologyPreserved);
    }
}

TEST(CCDMRemeshing, SkipsDeletedElements)
{
    MeshD m;
    shapes::Shape s = shapes::Sphere(3);
    meshes::Fill(m, shapes::Together(s, s, 5));
    for (std::size_t f = s.faces.size(); f < m.face.size(); ++f)
        vcg::tri::Allocator<MeshD>::DeleteFace(m, m.face[f]);
    for (std::size_t v = s.points.size(); v < m.vert.size(); ++v)
        vcg::tri::Allocator<MeshD>::DeleteVertex(m, m.vert[v]);
    const Report r = Remesh(m, Quick(300));
    ASSERT_EQ(r.status, Status::Done) << r.message;
    EXPECT_EQ(r.resultTopology.components, 1);
    EXPECT_EQ(m.VN(), 300);
}

TEST(CCDMRemeshing, RefusesFacesWithoutTheirVertices)
{
    MeshD m, other;
    meshes::Fill(other, shapes::Sphere(1));
    for (const auto &spoil : std::vector<std::function<void()>>{
             [&] { vcg::tri::Allocator<MeshD>::DeleteVertex(m, m.vert[7]); },
             [&] { m.face[3].V(1) = nullptr; },
             [&] { m.face[3].V(1) = &other.vert[0]; },
         }) {
        meshes::Fill(m, shapes::Sphere(1));
        spoil();
        const int vertices = m.VN();
        const Report r = Remesh(m, Quick(100));
        EXPECT_EQ(r.status, Status::InvalidInput);
        EXPECT_EQ(r.message, "a face names a vertex that does not exist");
        EXPECT_EQ(m.VN(), vertices);
    }
}

TEST(CCDMRemeshing, RefusesBadParametersAndLeavesTheMeshAlone)
{
    const auto refused = [](const std::function<void(Params &)> &spoil) {
        MeshD m;
        meshes::Fill(m, shapes::Sphere(1));
        Params p = Quick(100);
        spoil(p);
        const Report r = Remesh(m, p);
        EXPECT_EQ(m.VN(), 42);
        EXPECT_FALSE(r.message.empty());
        return r.status == Status::InvalidParameter;
    };
    EXPECT_TRUE(refused([](Params &p) { p.vertexCount = 3; }));
    EXPECT_TRUE(refused([](Params &p) { p.vertexCount = -7; }));
    EXPECT_TRUE(refused([](Params &p) { p.featureAngle = 0; }));
    EXPECT_TRUE(refused([](Params &p) { p.featureAngle = std::nan(""); }));
    EXPECT_TRUE(refused([](Params &p) { p.lambda = 1.5; }));
    EXPECT_TRUE(refused([](Params &p) { p.globalIterations = -1; }));
    EXPECT_TRUE(refused([](Params &p) { p.localIterations = 0; }));
    EXPECT_TRUE(refused([](Params &p) { p.densityExponent = -1; }));
    EXPECT_TRUE(refused([](Params &p) { p.approximation = 1.01; }));
    EXPECT_TRUE(refused([](Params &p) { p.approximation = std::nan(""); }));
}

int calls = 0, last = 0, stopAt = 0;
bool monotone = true;
bool Count(const int at, const char *phase)
{
    monotone = monotone && at >= last && at <= 100 && phase != nullptr && *phase != 0;
    last = at;
    return ++calls != stopAt;
}

TEST(CCDMRemeshing, ProgressIsMonotoneAndCancelsAtEveryStep)
{
    calls = last = stopAt = 0;
    monotone = true;
    MeshD m;
    meshes::Fill(m, shapes::Sphere(2));
    ASSERT_EQ(Remesh(m, Quick(100), Count).status, Status::Done);
    EXPECT_TRUE(monotone);
    EXPECT_EQ(last, 100);
    const int total = calls;
    ASSERT_GT(total, 10);
    for (stopAt = 1; stopAt < total; ++stopAt) {
        meshes::Fill(m, shapes::Sphere(2));
        calls = last = 0;
        const Report r = Remesh(m, Quick(100), Count);
        EXPECT_EQ(r.status, Status::Cancelled);
        EXPECT_EQ(calls, stopAt) << "asked again after it said stop";
        EXPECT_EQ(m.VN(), 162);
    }
}

TEST(CCDMRemeshing, DensityFollowsVertexQuality)
{
    MeshD m;
    meshes::Fill(m, shapes::FlatGrid(40));
    for (auto &v : m.vert)
        v.Q() = v.P()[0] < 0.5 ? 1 : 8;
    Params p = Quick(3000);
    p.density = vcg::ccdm::DensityKind::Quality;
    const Report r = Remesh(m, p);
    ASSERT_EQ(r.status, Status::Done) << r.message;
    int left = 0, right = 0;
    for (const auto &v : m.vert) {
        left += v.cP()[0] < 0.45;
        right += v.cP()[0] > 0.55;
    }
    EXPECT_GT(right, 4 * left);
    MeshD bad;
    meshes::Fill(bad, shapes::FlatGrid(10));
    for (auto &v : bad.vert)
        v.Q() = -1;
    EXPECT_EQ(Remesh(bad, p).status, Status::InvalidInput);
}

TEST(CCDMRemeshing, MarkedEdgesBecomeFeatures)
{
    MeshD m;
    meshes::Fill(m, shapes::FlatGrid(10));
    for (auto &f : m.face)
        for (int k = 0; k < 3; ++k)
            if (std::abs(f.cV(k)->cP()[0] - 0.5) < 1e-9 && std::abs(f.cV((k + 1) % 3)->cP()[0] - 0.5) < 1e-9)
                f.SetFaceEdgeS(k);
    Params p = Quick(400);
    EXPECT_EQ(vcg::tri::CCDMRemeshing<MeshD>::Do(m, m, p).featureCurves, 4);
    meshes::Fill(m, shapes::FlatGrid(10));
    for (auto &f : m.face)
        for (int k = 0; k < 3; ++k)
            if (std::abs(f.cV(k)->cP()[0] - 0.5) < 1e-9 && std::abs(f.cV((k + 1) % 3)->cP()[0] - 0.5) < 1e-9)
                f.SetFaceEdgeS(k);
    p.useMarkedEdges = true;
    const Report r = Remesh(m, p);
    ASSERT_EQ(r.status, Status::Done);
    EXPECT_EQ(r.featureCurves, 7) << "the boundary in six parts and the marked line";
    int onLine = 0;
    for (const auto &v : m.vert)
        onLine += std::abs(v.cP()[0] - 0.5) < 1e-9;
    EXPECT_GE(onLine, 15);
}

} // namespace
} // namespace ccdm_remeshing_test
