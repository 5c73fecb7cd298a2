// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/coarse_level.h>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace coarse_level_test {
namespace {

using namespace vcg::ccdm;

TEST(CoarseLevel, ATriangleAcrossAGapTellsThatPartsAreLost)
{
    const Model model = meshes::MakeModel(shapes::Sphere(4), 2562, 180);
    const CoarseLevel level(model);
    const Remesh whole = meshes::AsRemesh(model);
    EXPECT_FALSE(level.MayLackParts(whole, 0));
    // One vertex on the far side: its triangles lead through the ball.
    Remesh across = whole;
    across.position[0] = -whole.position[0];
    for (int v = 0; v < whole.VertexCount(); ++v)
        if (Norm(whole.position[v] - across.position[0]) < 1e-9)
            across.place[0].face = whole.place[v].face;
    EXPECT_TRUE(level.MayLackParts(across, 0));
    EXPECT_TRUE(level.HasMoreParts(whole, across));
    EXPECT_FALSE(level.HasMoreParts(across, whole));
}

TEST(CoarseLevel, ASmallAngleTellsThatPartsAreLost)
{
    const Model model = meshes::MakeModel(shapes::Sphere(4), 2562, 180);
    const CoarseLevel level(model);
    const Remesh whole = meshes::AsRemesh(model);
    EXPECT_FALSE(level.MayLackParts(whole, 40));
    EXPECT_TRUE(level.MayLackParts(whole, 59));
    Remesh worse = whole;
    worse.position[0] = (whole.position[0] + whole.position[whole.mesh.triangle[whole.mesh.incident[0]].v[0] == 0
                                                                ? whole.mesh.triangle[whole.mesh.incident[0]].v[1]
                                                                : whole.mesh.triangle[whole.mesh.incident[0]].v[0]]) /
                        2;
    EXPECT_TRUE(level.MayLackParts(worse, 40));
    EXPECT_TRUE(level.HasMoreParts(whole, worse));
    EXPECT_FALSE(level.HasMoreParts(worse, whole));
}

} // namespace
} // namespace coarse_level_test
