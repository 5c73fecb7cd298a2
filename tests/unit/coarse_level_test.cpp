// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/coarse_level.h>

#include <cmath>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace coarse_level_test {
namespace {

using namespace vcg::ccdm;

// An equilateral triangle whose corners lie on the unit sphere and whose middle is `depth` spacings below it.
Remesh Sunk(const Model &model, double depth)
{
    Remesh r;
    const double h = model.density.spacing[0];
    const double z = 1 - depth * h, radius = std::sqrt(1 - z * z);
    for (int k = 0; k < 3; ++k) {
        const double angle = 2 * Pi * k / 3;
        r.position.push_back(Point(radius * std::cos(angle), radius * std::sin(angle), z));
        r.place.emplace_back();
        double nearest = 1e300;
        for (int t = 0; t < model.surface.FaceCount(); ++t) {
            const double d = model.surface.NearestOn(t, r.position.back()).squaredDistance;
            if (d < nearest) {
                nearest = d;
                r.place.back().face = t;
            }
        }
    }
    r.rho.assign(3, 1);
    r.mesh.Build(3, {{0, 1, 2}});
    return r;
}

TEST(CoarseLevel, ATriangleAcrossAGapTellsThatPartsAreLost)
{
    const Model model = meshes::MakeModel(shapes::Sphere(5), 500, 180);
    const CoarseLevel level(model, meshes::Alone());
    EXPECT_FALSE(level.MayLackParts(Sunk(model, 0.6), 0));
    EXPECT_TRUE(level.MayLackParts(Sunk(model, 0.8), 0));
}

TEST(CoarseLevel, FewerGapsCountForMoreThanAngles)
{
    const Model model = meshes::MakeModel(shapes::Sphere(5), 500, 180);
    const CoarseLevel level(model, meshes::Alone());
    const Remesh gap = Sunk(model, 0.8), none = Sunk(model, 0.4);
    EXPECT_TRUE(level.IsSurpassed(gap, none));
    EXPECT_FALSE(level.IsSurpassed(none, gap));
    EXPECT_FALSE(level.IsSurpassed(gap, gap)) << "no fewer";
}

TEST(CoarseLevel, ASmallAngleTellsThatPartsAreLost)
{
    const Model model = meshes::MakeModel(shapes::Sphere(4), 2562, 180);
    const CoarseLevel level(model, meshes::Alone());
    const Remesh whole = meshes::AsRemesh(model);
    EXPECT_FALSE(level.MayLackParts(whole, 40));
    EXPECT_TRUE(level.MayLackParts(whole, 59));
    // Half way to one of its neighbours.
    Remesh worse = whole;
    const Triangle &T = whole.mesh.triangle[whole.mesh.incident[0]];
    const int neighbour = T.v[Next(T.IndexOf(0))];
    worse.position[0] = (whole.position[0] + whole.position[neighbour]) / 2;
    EXPECT_TRUE(level.MayLackParts(worse, 40));
    EXPECT_TRUE(level.IsSurpassed(worse, whole));
    EXPECT_FALSE(level.IsSurpassed(whole, worse));
}

} // namespace
} // namespace coarse_level_test
