// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/density.h>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace density_test {
namespace {

using namespace vcg::ccdm;

ReferenceSurface Surface(const shapes::Shape &s)
{
    const MeshTables t = meshes::Tables(s);
    return ReferenceSurface(t.position, t.face);
}

TEST(CurvatureDensity, IsConstantOnASphere)
{
    // K = 1 / r^2 and H = 1 / r: phi = sqrt(2) / r.
    for (const double r : {1.0, 0.25}) {
        shapes::Shape s = shapes::Sphere(4);
        for (auto &p : s.points)
            for (double &x : p)
                x *= r;
        for (const double phi : CurvatureDensity(Surface(s)))
            EXPECT_NEAR(phi, std::sqrt(2.0) / r, 0.03 / r);
    }
}

TEST(CurvatureDensity, KnowsATorus)
{
    // Round torus of radii 1 and a: H = (1 + 2 a cos b) / (2 a (1 + a cos b)), K = cos b / (a (1 + a cos b)).
    const double a = 0.4;
    const int nu = 160, nv = 64;
    const std::vector<double> phi = CurvatureDensity(Surface(shapes::RoundTorus(nu, nv, a)));
    for (const int j : {0, 8, 16, 48}) {
        const double c = std::cos(2 * Pi * j / nv), r = 1 + a * c;
        const double h = (1 + 2 * a * c) / (2 * a * r), k = c / (a * r);
        // On top, where K changes its sign, smoothing |K| lifts it a little.
        EXPECT_NEAR(phi[j], std::sqrt(std::abs(k) + h * h), k * k > 1e-6 ? 0.05 : 0.11) << j;
    }
}

TEST(CurvatureDensity, IsPositiveOnFlatPartsAndBlindToCreases)
{
    ReferenceSurface box = Surface(shapes::Subdivide(shapes::Subdivide(shapes::Box(1, 1, 1))));
    for (int t = 0; t < box.mesh.TriangleCount(); ++t)
        for (int e = 0; e < 3; ++e) {
            const Side s = MakeSide(t, e);
            const Triangulation &m = box.mesh;
            if (TurnAngle(box.position[m.Tail(s)], box.position[m.Head(s)], box.position[m.Opposite(s)],
                          box.position[m.Opposite(m.Mate(s))]) > 1)
                box.mesh.SetConstrained(s, true);
        }
    const std::vector<double> phi = CurvatureDensity(box);
    for (const double x : phi) {
        EXPECT_GT(x, 0);
        EXPECT_NEAR(x, phi[0], 1e-9);
    }
}

TEST(DensityField, SpacingIsThatOfTheIdealTriangulation)
{
    // n vertices of valence six on area A: A = n * sqrt(3) / 2 * h^2.
    const ReferenceSurface s = Surface(shapes::FlatGrid(10));
    const DensityField d = MakeDensityField(s, std::vector<double>(s.position.size(), 5.0), true, 0.2, 1000);
    for (const double h : d.spacing)
        EXPECT_NEAR(1000 * std::sqrt(3.0) / 2 * h * h, 1, 1e-9);
}

TEST(DensityField, SpacingFollowsDensity)
{
    const ReferenceSurface s = Surface(shapes::FlatGrid(20));
    std::vector<double> phi;
    for (const Point &p : s.position)
        phi.push_back(1 + 3 * p[0]);
    const DensityField d = MakeDensityField(s, phi, false, 0.2, 1000);
    for (std::size_t v = 0; v < phi.size(); ++v) {
        EXPECT_NEAR(d.spacing[v] / d.spacing[0], std::sqrt(phi[0] / phi[v]), 1e-9);
        EXPECT_NEAR(d.rho[v], std::pow(phi[v], 0.2), 1e-7 * d.rho[v]) << "rounded to single precision";
    }
}

TEST(LimitGradation, BoundsTheGrowthOfTheSpacing)
{
    const shapes::Shape s = shapes::FlatGrid(40);
    const ReferenceSurface surface = Surface(s);
    std::vector<double> phi;
    for (const auto &p : s.points)
        phi.push_back(std::hypot(p[0] - 0.5, p[1] - 0.5) < 0.05 ? 1e4 : 1.0);
    std::vector<double> limited = phi;
    LimitGradation(surface, 1000, 0.1, limited);
    double integral = 0;
    for (int t = 0; t < surface.FaceCount(); ++t) {
        const Triangle &T = surface.mesh.triangle[t];
        integral += Norm(surface.AreaVector(t)) * (phi[T.v[0]] + phi[T.v[1]] + phi[T.v[2]]) / 3;
    }
    const auto spacing = [&](int v) { return std::sqrt(2 * integral / (std::sqrt(3.0) * 1000 * limited[v])); };
    double steepest = 0;
    for (const Triangle &T : surface.mesh.triangle)
        for (int k = 0; k < 3; ++k) {
            const int a = T.v[k], b = T.v[Next(k)];
            EXPECT_GE(limited[a], phi[a]);
            steepest =
                std::max(steepest, std::abs(spacing(a) - spacing(b)) / Norm(surface.position[a] - surface.position[b]));
        }
    EXPECT_LE(steepest, 0.1 + 1e-9);
    EXPECT_GT(steepest, 0.09);
}

} // namespace
} // namespace density_test
