// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that are cancelled, at every step where they can be.
#include <vcg/complex/algorithms/ccdm_remeshing.h>

#include <gtest/gtest.h>

#include "support/mesh_state.h"
#include "support/meshes.h"

namespace faults_test {
namespace {

using mesh_state::Bytes;
using mesh_state::GeometryOf;
using meshes::MeshD;
using vcg::ccdm::Params;
using vcg::ccdm::Report;
using vcg::ccdm::Status;
using Remeshing = vcg::tri::CCDMRemeshing<MeshD>;

int calls = 0, stopAt = 0;
bool Stop(const int /*at*/, const char * /*phase*/)
{
    return ++calls != stopAt;
}

Report Run(const MeshD &in, MeshD &out, const Params &params, int stop)
{
    calls = 0;
    stopAt = stop;
    return Remeshing::Do(in, out, params, Stop);
}

void Fill(MeshD &m, const shapes::Shape &s)
{
    meshes::Fill(m, s);
    for (auto &f : m.face)
        if (f.cP(0)[2] + f.cP(1)[2] + f.cP(2)[2] > 0)
            f.SetS();
}

// Cancels at up to `most` of the steps. By turns one and two threads, into another mesh and in place.
void ExpectCancelsEverywhere(const shapes::Shape &shape, Params params, int most = 200)
{
    MeshD in, out, result;
    Fill(in, shape);
    params.threads = 2;
    const Report undisturbed = Run(in, result, params, 0);
    ASSERT_EQ(undisturbed.status, Status::Done) << undisturbed.message;
    const int total = calls;
    ASSERT_GT(total, 10);
    meshes::Fill(out, shapes::Tetrahedron());
    const std::string inBefore = Bytes(in), outBefore = Bytes(out);
    const int stride = (total + most - 1) / most;
    // The last call says that it is done.
    for (int k = 1, turn = 0; k < total; k += stride, ++turn) {
        const bool inPlace = turn / 2 % 2 == 1;
        params.threads = 1 + turn % 2;
        const Report r = Run(in, inPlace ? in : out, params, k);
        ASSERT_EQ(r.status, Status::Cancelled) << "call " << k << " of " << total << ": " << r.message;
        EXPECT_NE(r.message.find("cancelled while"), std::string::npos) << r.message;
        EXPECT_EQ(calls, k) << "asked again after it said stop";
        ASSERT_TRUE(Bytes(in) == inBefore) << "call " << k;
        ASSERT_TRUE(Bytes(out) == outBefore) << "call " << k;
    }
    ASSERT_EQ(Run(in, out, params, 0).status, Status::Done);
    EXPECT_TRUE(GeometryOf(out) == GeometryOf(result));
    EXPECT_EQ(calls, total);
    ASSERT_EQ(Run(in, in, params, 0).status, Status::Done);
    EXPECT_TRUE(GeometryOf(in) == GeometryOf(result));
}

TEST(Cancelling, WithACoarseLevel)
{
    ExpectCancelsEverywhere(shapes::Sphere(3), meshes::Quick(4000), 30);
}

TEST(Cancelling, WithFeatures)
{
    ExpectCancelsEverywhere(shapes::TwistedBar(24, 3), meshes::Quick(300));
}

TEST(Cancelling, WithCurvature)
{
    Params p = meshes::Quick(300);
    p.density = vcg::ccdm::DensityKind::Curvature;
    ExpectCancelsEverywhere(shapes::Bumpy(2), p);
}

TEST(Cancelling, WhileAnnealing)
{
    Params p = meshes::Quick(200);
    p.optimizer = vcg::ccdm::OptimizerKind::Annealing;
    p.sampler = vcg::ccdm::SamplerKind::Random;
    p.approximation = 1;
    ExpectCancelsEverywhere(shapes::Bumpy(2), p);
}

TEST(Cancelling, TowardsAnEdgeLength)
{
    Params p = meshes::Quick(0);
    p.edgeLength = 0.3;
    ExpectCancelsEverywhere(shapes::Bumpy(2), p);
}

TEST(Cancelling, TowardsALargestError)
{
    Params p = meshes::Quick(0);
    p.maxError = 0.03;
    ExpectCancelsEverywhere(shapes::Bumpy(2), p, 20);
}

TEST(Cancelling, OfSelectedFaces)
{
    Params p = meshes::Quick(200);
    p.featureAngle = 180;
    p.selectedFacesOnly = true;
    ExpectCancelsEverywhere(shapes::Bumpy(2), p);
}

} // namespace
} // namespace faults_test
