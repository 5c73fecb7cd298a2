// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/trial_patch.h>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/verification.h>

#include "support/meshes.h"

namespace trial_patch_test {
namespace {

using namespace vcg::ccdm;

bool Same(const Remesh &a, const Remesh &b)
{
    bool same = a.position == b.position && a.rho == b.rho && a.mesh.incident == b.mesh.incident;
    for (int t = 0; t < a.mesh.TriangleCount(); ++t) {
        const Triangle &x = a.mesh.triangle[t], &y = b.mesh.triangle[t];
        same = same && std::equal(std::begin(x.v), std::end(x.v), y.v) &&
               std::equal(std::begin(x.n), std::end(x.n), y.n) && x.constrained == y.constrained;
    }
    for (int v = 0; v < a.VertexCount(); ++v)
        same = same && a.place[v].face == b.place[v].face;
    return same;
}

TEST(TrialPatch, TakesBackMovesAndFlips)
{
    for (const shapes::Shape &s : {shapes::Bumpy(3), shapes::KleinBottle(24, 12), shapes::CadPart()}) {
        const Model model = meshes::MakeModel(s, 600, 40);
        Remesh r = meshes::AsRemesh(model);
        r.mesh.KeepRings();
        TrialPatch patch(model, r);
        int changed = 0;
        for (int t = 0; t < r.mesh.TriangleCount(); t += 37) {
            const Remesh before = r;
            patch.Take(t, 3);
            patch.Sweep(Perturbation{0.8, static_cast<std::uint64_t>(t)});
            patch.Relax(3, [](int) { return false; });
            EXPECT_EQ(VerifyTriangulation(r.mesh).fault, "");
            changed += !Same(r, before);
            for (int v = 0; v < r.VertexCount(); ++v)
                if (!patch.Contains(v)) {
                    ASSERT_EQ(Norm(r.position[v] - before.position[v]), 0) << "a vertex outside has moved";
                }
            patch.Restore();
            ASSERT_TRUE(Same(r, before));
        }
        EXPECT_GT(changed, 0);
    }
}

TEST(TrialPatch, LeavesFeaturesAndFixedVerticesAlone)
{
    const Model model = meshes::MakeModel(shapes::CadPart(), 600, 40);
    Remesh r = meshes::AsRemesh(model);
    TrialPatch patch(model, r);
    for (int t = 0; t < r.mesh.TriangleCount(); ++t) {
        patch.Take(t, 2);
        for (const int v : patch.Vertices())
            EXPECT_EQ(r.place[v].kind, VertexKind::Free);
    }
    const Model round = meshes::MakeModel(shapes::Bumpy(3), 642, 180);
    Remesh b = meshes::AsRemesh(round);
    TrialPatch around(round, b);
    around.Take(0, 3);
    const int fixed = around.Vertices().front();
    around.Sweep(Perturbation{0.5, 1});
    const Point stay = b.position[fixed];
    around.Relax(5, [&](int v) { return v == fixed; });
    EXPECT_EQ(Norm(b.position[fixed] - stay), 0);
}

} // namespace
} // namespace trial_patch_test
