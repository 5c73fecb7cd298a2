// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/centroid_rules.h>

#include <functional>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/delaunay.h>

#include "support/meshes.h"

namespace centroid_rules_test {
namespace {

using namespace vcg::ccdm;

// The centroid of a vertex's planar Voronoi cell by brute force: the points of a fine grid that are
// nearer to it than to any other vertex.
Point CellByGrid(const Remesh &r, int v, double reach, const std::function<double(const Point &)> &rho)
{
    Point sum(0, 0, 0);
    double mass = 0;
    const int n = 400;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Point p = r.position[v] + Point((2 * (i + 0.5) / n - 1) * reach, (2 * (j + 0.5) / n - 1) * reach, 0);
            bool nearest = p[0] >= 0 && p[1] >= 0 && p[0] <= 1 && p[1] <= 1;
            for (int o = 0; o < r.VertexCount() && nearest; ++o)
                nearest = SquaredNorm(p - r.position[o]) >= SquaredNorm(p - r.position[v]);
            if (nearest) {
                sum += p * rho(p);
                mass += rho(p);
            }
        }
    return sum / mass - r.position[v];
}

struct Plane {
    Model model;
    Remesh remesh;
    explicit Plane(bool uniform)
    {
        const shapes::Shape s = shapes::FlatGrid(8);
        model = meshes::MakeModel(s, 81, 180);
        if (!uniform) {
            std::vector<double> phi;
            for (const auto &p : s.points)
                phi.push_back(1 + 2 * p[0]);
            model.density = MakeDensityField(model.surface, phi, false, 1, 81);
        }
        remesh = meshes::AsRemesh(model);
        Relocator relocator(model, remesh);
        Random random(5);
        relocator.Sweep(Perturbation{0.35, random.Bits()});
        DelaunayFlipper(meshes::Alone()).Run(remesh);
    }
    template <class Rule = CellCentroid>
    Point Displacement(int v, bool uniform)
    {
        // The rule as a sweep applies it: a probe keeps what it returns and moves nothing.
        Point found(0, 0, 0);
        const Rule rule{remesh, uniform};
        Relocator(model, remesh).Sweep([&](const LocalStar &star, int w) {
            if (w == v)
                found = rule(star, w);
            return Point(0, 0, 0);
        });
        return found;
    }
};

TEST(CellCentroid, IsTheCentroidOfTheVoronoiCell)
{
    Plane plane(true);
    int seen = 0;
    for (int v = 0; v < plane.remesh.VertexCount(); ++v) {
        const Point &p = plane.remesh.position[v];
        if (std::abs(p[0] - 0.5) > 0.3 || std::abs(p[1] - 0.5) > 0.3)
            continue;
        const Point wanted = CellByGrid(plane.remesh, v, 0.2, [](const Point &) { return 1.0; });
        EXPECT_LT(Norm(plane.Displacement(v, true) - wanted), 1e-3);
        ++seen;
    }
    EXPECT_GT(seen, 9);
}

TEST(CellCentroid, FollowsTheDensity)
{
    Plane plane(false);
    for (int v = 0; v < plane.remesh.VertexCount(); ++v) {
        const Point &p = plane.remesh.position[v];
        if (std::abs(p[0] - 0.5) > 0.2 || std::abs(p[1] - 0.5) > 0.2)
            continue;
        const Point wanted = CellByGrid(plane.remesh, v, 0.2, [](const Point &q) { return 1 + 2 * q[0]; });
        // The density moves the centroid by about 1e-3.
        EXPECT_LT(Norm(plane.Displacement(v, false) - wanted), 2e-4);
    }
}

TEST(CellCentroid, IsClippedAtTheBoundary)
{
    // Vertices next to the boundary, where the circumcentres of obtuse triangles lie outside.
    Plane plane(true);
    for (int v = 0; v < plane.remesh.VertexCount(); ++v) {
        if (plane.remesh.place[v].kind != VertexKind::Free)
            continue;
        const Point wanted = CellByGrid(plane.remesh, v, 0.25, [](const Point &) { return 1.0; });
        EXPECT_LT(Norm(plane.Displacement(v, true) - wanted), 4e-3);
    }
}

TEST(MeanCircumcentre, LeadsToTheLeastInterpolationErrorOfTheStar)
{
    // Chen, Holst 2011: with the ring fixed, the mean circumcentre minimises the integral of the linear
    // interpolation of |x|^2, up to a constant the sum over the triangles of area times the sum of the corners' |x|^2.
    Plane plane(true);
    for (int v = 0; v < plane.remesh.VertexCount(); ++v) {
        if (plane.remesh.place[v].kind != VertexKind::Free)
            continue;
        const auto error = [&](const Point &at) {
            double sum = 0;
            plane.remesh.mesh.VisitSpokes(v, [&](int, Side s) {
                const Triangle &T = plane.remesh.mesh.triangle[SideTriangle(s)];
                const int i = T.IndexOf(v);
                const Point &a = plane.remesh.position[T.v[Next(i)]], &b = plane.remesh.position[T.v[Prev(i)]];
                sum += std::abs(Cross(a - at, b - at)[2]) * (SquaredNorm(at) + SquaredNorm(a) + SquaredNorm(b));
                return true;
            });
            return sum;
        };
        const Point end = plane.remesh.position[v] + plane.Displacement<MeanCircumcentre>(v, true);
        for (int k = 0; k < 8; ++k) {
            const Point aside(0.003 * std::cos(k * Pi / 4), 0.003 * std::sin(k * Pi / 4), 0);
            EXPECT_GT(error(end + aside), error(end) - 1e-12);
        }
    }
}

TEST(MeanCircumcentre, WeighsByTheDensity)
{
    Plane plane(false);
    int moved = 0;
    for (int v = 0; v < plane.remesh.VertexCount(); ++v)
        if (plane.remesh.place[v].kind == VertexKind::Free) {
            const Point dense = plane.Displacement<MeanCircumcentre>(v, false);
            const Point even = plane.Displacement<MeanCircumcentre>(v, true);
            moved += Norm(dense - even) > 1e-4;
            EXPECT_LT(Norm(dense - even), 0.05);
        }
    EXPECT_GT(moved, 20);
}

TEST(HeavyBall, ConvergesToTheRulesFixedPointSooner)
{
    const Model model = meshes::MakeModel(shapes::Bumpy(4), 2562, 180);
    const auto energyAfter = [&](bool heavy) {
        Remesh r = meshes::AsRemesh(model);
        Relocator relocator(model, r);
        DelaunayFlipper flipper(meshes::Alone());
        Random random(5);
        for (int i = 0; i < 3; ++i)
            relocator.Sweep(Perturbation{0.5, random.Bits()});
        std::vector<Point> last = r.position;
        const HeavyBall<CellCentroid> pull = {{r, true}, {{r, true}}, r.position, last};
        for (int i = 0; i < 30; ++i) {
            flipper.Run(r);
            if (heavy)
                relocator.Sweep(pull);
            else
                relocator.Sweep(CellCentroid{r, true});
        }
        flipper.Run(r);
        return Energy(r, meshes::Alone());
    };
    EXPECT_LT(energyAfter(true), energyAfter(false));
}

TEST(CurveCentroid, SpacesACurveMoreEvenlyThanTheStar)
{
    const Model model = meshes::MakeModel(shapes::FlatGrid(10), 121, 180);
    // Longest over shortest boundary edge, once the rule has settled.
    const auto spread = [&](auto makeRule) {
        Remesh r = meshes::AsRemesh(model);
        Relocator relocator(model, r);
        DelaunayFlipper flipper(meshes::Alone());
        Random random(7);
        relocator.Sweep(Perturbation{0.4, random.Bits()});
        const auto rule = makeRule(r);
        for (int i = 0; i < 200; ++i) {
            flipper.Run(r);
            relocator.Sweep([&](const LocalStar &star, int v) { return rule(star, v); });
        }
        double least = 1, most = 0;
        for (int t = 0; t < r.mesh.TriangleCount(); ++t)
            for (int e = 0; e < 3; ++e) {
                const Side s = MakeSide(t, e);
                if (r.mesh.Mate(s) != NoSide)
                    continue;
                const double d = Norm(r.position[r.mesh.Tail(s)] - r.position[r.mesh.Head(s)]);
                least = std::min(least, d);
                most = std::max(most, d);
            }
        return most / least;
    };
    const double star = spread([](const Remesh &r) { return PatchCentroid{r, true}; });
    const double curve = spread([](const Remesh &r) { return CurveCentroid{{r, true}}; });
    EXPECT_GT(star, 1.3);
    EXPECT_LT(curve - 1, 0.8 * (star - 1));
}

} // namespace
} // namespace centroid_rules_test
