// SPDX-License-Identifier: GPL-3.0-or-later
// Whole runs on several threads, for ThreadSanitizer to look at.
#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/target_search.h>

#include "support/meshes.h"

namespace races_test {
namespace {

using namespace vcg::ccdm;

void OnFourThreads(const shapes::Shape &s, Params p)
{
    p.threads = 4;
    p.globalIterations = 2;
    MeshTables out;
    Provenance provenance;
    const Report report = TargetSearch(p, nullptr).Run(meshes::Tables(s), out, &provenance);
    EXPECT_EQ(report.status, Status::Done) << report.message;
}

TEST(Races, Surfaces)
{
    Params p;
    // Enough for a coarse level and for many patches.
    p.vertexCount = 4200;
    OnFourThreads(shapes::Bumpy(4), p);
}

TEST(Races, FeaturesAndCurvature)
{
    Params p;
    p.vertexCount = 1500;
    p.density = DensityKind::Curvature;
    p.approximation = 1;
    OnFourThreads(shapes::CadPart(), p);
}

TEST(Races, AnnealingAndAnError)
{
    Params p;
    p.optimizer = OptimizerKind::Annealing;
    p.sampler = SamplerKind::Random;
    p.maxError = 0.02;
    OnFourThreads(shapes::Plate(20), p);
}

} // namespace
} // namespace races_test
