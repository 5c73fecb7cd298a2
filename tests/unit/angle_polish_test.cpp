// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/angle_polish.h>

#include <algorithm>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/centroid_rules.h>
#include <vcg/complex/algorithms/ccdm/verification.h>

#include "support/meshes.h"

namespace angle_polish_test {
namespace {

using namespace vcg::ccdm;

TEST(SmallestAngle, AgreesWithTheArcTangent)
{
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const Point p[3] = {Point(random.Unit(), random.Unit(), random.Unit()),
                            Point(random.Unit(), random.Unit(), random.Unit()),
                            Point(random.Unit(), random.Unit(), random.Unit())};
        double least = Pi;
        for (int k = 0; k < 3; ++k) {
            const Point u = p[(k + 1) % 3] - p[k], w = p[(k + 2) % 3] - p[k];
            least = std::min(least, std::atan2(Norm(Cross(u, w)), Dot(u, w)));
        }
        EXPECT_NEAR(SmallestAngle(p[0], p[1], p[2]), least, 1.5e-4);
    }
    EXPECT_EQ(SmallestAngle(Point(0, 0, 0), Point(0, 0, 0), Point(0, 0, 0)), 0);
}

TEST(LargestCosine, IsTheSameInAnyOrderOfTheSides)
{
    const auto all = [](double a, double b, double c) {
        const double cosine = LargestCosine(a, b, c);
        for (const double other : {LargestCosine(a, c, b), LargestCosine(b, a, c), LargestCosine(b, c, a),
                                   LargestCosine(c, a, b), LargestCosine(c, b, a)})
            EXPECT_NEAR(other, cosine, 1e-15);
        return cosine;
    };
    EXPECT_NEAR(all(9, 16, 25), 0.8, 1e-15);
    EXPECT_NEAR(all(1, 1, 1), 0.5, 1e-15);
    EXPECT_NEAR(all(1, 1, 4), 1, 1e-15); // three points of a line
    EXPECT_EQ(all(0, 1, 1), 1);          // two points at one place: the angle between the long sides is 0
    EXPECT_EQ(all(0, 0, 0), 1);
}

TEST(SmallestAngleGradient, IsZeroWhereThereIsNone)
{
    const Point u(1, 0, 0), w(2, 0, 0), none(0, 0, 0);
    EXPECT_EQ(SmallestAngleGradient(u, w, Cross(u, w), 1, 4, 1), none);
    EXPECT_EQ(SmallestAngleGradient(none, w, Cross(none, w), 0, 4, 4), none);
}

TEST(SmallestAngleGradient, AgreesWithFiniteDifferences)
{
    Random random(9);
    int compared = 0;
    for (int i = 0; i < 1000; ++i) {
        const Point u(random.Unit(), random.Unit(), random.Unit()), w(random.Unit(), random.Unit(), random.Unit());
        const double side[3] = {SquaredNorm(u), SquaredNorm(w), SquaredNorm(u - w)};
        const double least = *std::min_element(side, side + 3);
        // Away from the places where another angle becomes the smallest, and from flat triangles.
        if (std::count_if(side, side + 3, [&](double l) { return l < 1.1 * least; }) > 1 ||
            Norm(Cross(u, w)) < 0.2 * SquaredNorm(u))
            continue;
        const Point gradient = SmallestAngleGradient(u, w, Cross(u, w), side[0], side[1], side[2]);
        for (const Point &d : {Normalized(u), Normalized(w), Normalized(Cross(u, w))}) {
            const double step = 0.02 * std::sqrt(least);
            const double slope = (SmallestAngle(d * step, u, w) - SmallestAngle(d * -step, u, w)) / (2 * step);
            EXPECT_NEAR(Dot(gradient, d), slope, 0.03 / std::sqrt(least));
            ++compared;
        }
    }
    EXPECT_GT(compared, 500);
}

TEST(AnglePolish, RaisesTheMeanSmallestAngleAndKeepsTheSurface)
{
    const Model model = meshes::MakeModel(shapes::Bumpy(4), 2562, 180);
    Remesh r = meshes::AsRemesh(model);
    Random random(3);
    Relocator(model, r).Sweep(Perturbation{0.3, random.Bits()});
    const auto mean = [&] {
        double sum = 0;
        for (const Triangle &T : r.mesh.triangle)
            sum += SmallestAngle(r.position[T.v[0]], r.position[T.v[1]], r.position[T.v[2]]);
        return sum / r.mesh.TriangleCount() * 180 / Pi;
    };
    const double before = mean();
    AnglePolish(model, r, meshes::Alone()).Run(14);
    EXPECT_GT(mean(), before + 5);
    EXPECT_EQ(VerifyTriangulation(r.mesh).fault, "");
    for (int v = 0; v < r.VertexCount(); ++v)
        EXPECT_LT(model.surface.NearestOn(r.place[v].face, r.position[v]).squaredDistance, 1e-20);
}

} // namespace
} // namespace angle_polish_test
