// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/centroid_rules.h>

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/delaunay.h>

#include "support/meshes.h"

namespace relocation_test {
namespace {

using namespace vcg::ccdm;

// Integral of rho |x - c|^2 over a triangle by subdivision into n^2 small ones.
double NumericalMoment(const Point &a, const Point &b, const Point &c, const Point &x, double rho, int n)
{
    double sum = 0;
    const double area = Norm(Cross(b - a, c - a)) / 2 / n / n;
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j)
            for (const int up : {0, 1}) {
                if (up == 1 && i + j + 1 >= n)
                    continue;
                const double u = (i + (up ? 2.0 : 1.0) / 3) / n, w = (j + (up ? 2.0 : 1.0) / 3) / n;
                sum += rho * area * SquaredNorm(a + (b - a) * u + (c - a) * w - x);
            }
    return sum;
}

TEST(Energy, AgreesWithNumericalIntegration)
{
    for (const shapes::Shape &s : {shapes::Bumpy(1), shapes::Plate(9)}) {
        Remesh r = meshes::AsRemesh(meshes::MakeModel(s, 100, 180));
        for (std::size_t v = 0; v < r.rho.size(); ++v)
            r.rho[v] = 1 + 0.5 * r.position[v][0] * r.position[v][0];
        double sum = 0;
        for (const Triangle &T : r.mesh.triangle) {
            const Point &a = r.position[T.v[0]], &b = r.position[T.v[1]], &c = r.position[T.v[2]];
            const double rho = (r.rho[T.v[0]] + r.rho[T.v[1]] + r.rho[T.v[2]]) / 3;
            for (const int v : T.v)
                sum += NumericalMoment(a, b, c, r.position[v], rho, 40);
        }
        EXPECT_NEAR(Energy(r, meshes::Alone()) / sum, 1, 2e-3);
    }
}

TEST(PatchCentroid, MinimisesTheMomentOfTheStar)
{
    // The centroid of the star has the least moment: nearby points have more (equation 2).
    const Model model = meshes::MakeModel(shapes::FlatGrid(4), 100, 180);
    Remesh r = meshes::AsRemesh(model);
    const int v = 12;
    r.position[v] += Point(0.04, -0.06, 0);
    const Point x = r.position[v];
    Relocator relocator(model, r);
    Point centre(0, 0, 0);
    relocator.Sweep([&](const LocalStar &star, int w) {
        if (w == v)
            centre = x + PatchCentroid{r, true}(star, w);
        return Point(0, 0, 0);
    });
    Star star;
    r.mesh.GatherStar(v, star);
    const auto moment = [&](const Point &y) {
        double sum = 0;
        for (int k = 0; k < star.Triangles(); ++k)
            sum += NumericalMoment(x, r.position[star.outer[k]], r.position[star.OuterAfter(k)], y, 1, 60);
        return sum;
    };
    for (const Point &d : {Point(0.01, 0, 0), Point(-0.01, 0, 0), Point(0, 0.01, 0), Point(0, -0.01, 0)})
        EXPECT_GT(moment(centre + d), moment(centre));
}

TEST(Relocator, SettlesAPlaneMeshOnItsCentroids)
{
    shapes::Shape s = shapes::FlatGrid(8);
    const Model model = meshes::MakeModel(s, 100, 180);
    Remesh r = meshes::AsRemesh(model);
    Random random(2);
    Relocator relocator(model, r);
    relocator.Sweep(Perturbation{0.3, random.Bits()});
    double largest = 1;
    for (int i = 0; i < 300 && largest > 1e-7; ++i) {
        largest = 0;
        relocator.Sweep([&](const LocalStar &star, int v) {
            const Point d = PatchCentroid{r, true}(star, v);
            if (r.place[v].kind == VertexKind::Free)
                largest = std::max(largest, Norm(d));
            return d;
        });
    }
    EXPECT_LT(largest, 1e-6) << "a centroidal patch triangulation: each vertex at the centroid of its star";
}

TEST(Relocator, KeepsVerticesOnTheSurfaceAndOnTheirCurves)
{
    for (const shapes::Shape &s :
         {shapes::Bumpy(3), shapes::CadPart(), shapes::KleinBottle(40, 24), shapes::Plate(30)}) {
        const Model model = meshes::MakeModel(s, 1000, 60);
        Remesh r = meshes::AsRemesh(model);
        const std::vector<Point> before = r.position;
        Random random(4);
        Relocator relocator(model, r);
        for (int i = 0; i < 5; ++i) {
            relocator.Sweep(Perturbation{0.2, random.Bits()});
            relocator.Sweep(PatchCentroid{r, true});
        }
        int moved = 0;
        for (int v = 0; v < r.VertexCount(); ++v) {
            const Place &p = r.place[v];
            moved += Norm(r.position[v] - before[v]) > 0;
            EXPECT_LT(model.surface.NearestOn(p.face, r.position[v]).squaredDistance, 1e-20);
            if (p.kind == VertexKind::Corner) {
                EXPECT_EQ(Norm(r.position[v] - before[v]), 0);
            }
            if (p.kind == VertexKind::Curve) {
                const FeatureCurve &c = model.features.curve[p.curve];
                const Point &a = model.surface.position[c.vertex[p.segment]];
                const Point &b = model.surface.position[c.vertex[p.segment + 1]];
                EXPECT_LT(Norm(a + (b - a) * c.Fraction(p.segment, p.s) - r.position[v]), 1e-12);
            }
        }
        EXPECT_GT(moved, 0);
    }
}

TEST(Relocator, RefusesToFoldAStar)
{
    // Steps far beyond the star: the mesh must stay free of folds in the plane.
    const Model model = meshes::MakeModel(shapes::FlatGrid(10), 100, 180);
    Remesh r = meshes::AsRemesh(model);
    Relocator relocator(model, r);
    Random random(9);
    for (int i = 0; i < 20; ++i)
        relocator.Sweep(Perturbation{1.0, random.Bits()});
    for (const Triangle &T : r.mesh.triangle) {
        const Point &a = r.position[T.v[0]];
        EXPECT_GT(Cross(r.position[T.v[1]] - a, r.position[T.v[2]] - a)[2], 0);
    }
}

TEST(Relocator, TangentialStepsDoNotShrinkASphere)
{
    const Model model = meshes::MakeModel(shapes::Sphere(4), 2562, 180);
    Remesh r = meshes::AsRemesh(model);
    const auto area = [&] {
        double sum = 0;
        for (const Triangle &T : r.mesh.triangle) {
            const Point &a = r.position[T.v[0]];
            sum += Norm(Cross(r.position[T.v[1]] - a, r.position[T.v[2]] - a)) / 2;
        }
        return sum;
    };
    const double before = area();
    Relocator relocator(model, r);
    for (int i = 0; i < 30; ++i)
        relocator.Sweep(PatchCentroid{r, true});
    EXPECT_NEAR(area() / before, 1, 0.002);
}

// Sweeps and flips in turn, with rings that are kept and without: the same stars, so the same positions up to the order
// of the sums. A ring that a flip has made stale would show at once. Returns the rings known at the end, by what they
// hold: plain ones, ones with a wall, of curve vertices, and open ones.
std::array<int, 4> CompareKnownRings(const Model &model)
{
    Remesh walked = meshes::AsRemesh(model), known = walked;
    known.mesh.KeepRings();
    long long flips = 0;
    std::array<int, 4> kinds{};
    for (int i = 0; i < 12; ++i) {
        for (Remesh *r : {&walked, &known}) {
            Relocator relocator(model, *r);
            relocator.Sweep(Perturbation{0.3, 7U + static_cast<unsigned>(i)});
            flips += DelaunayFlipper(meshes::Alone()).Run(*r);
            relocator.Sweep(CellCentroid{*r, true});
        }
        kinds.fill(0);
        for (int v = 0; v < known.VertexCount(); ++v) {
            const Triangulation::Ring *ring = known.mesh.KnownRing(v);
            if (ring == nullptr)
                continue;
            Star star;
            known.mesh.GatherStar(v, star);
            std::vector<int> outer(ring->begin(), std::find(ring->begin(), ring->end(), -1));
            int marks = 0;
            for (int &o : outer) {
                marks |= o;
                o &= Triangulation::RingNumber;
            }
            EXPECT_EQ((marks & Triangulation::RingOpen) != 0, !star.closed);
            EXPECT_EQ(outer.size(), star.outer.size());
            EXPECT_TRUE(std::is_permutation(star.outer.begin(), star.outer.end(), outer.begin(), outer.end()));
            EXPECT_EQ((marks & Triangulation::RingSpoke) != 0, known.place[v].kind == VertexKind::Curve);
            kinds[0] += marks == (marks & Triangulation::RingNumber);
            kinds[1] += (marks & Triangulation::RingWall) != 0;
            kinds[2] += (marks & Triangulation::RingSpoke) != 0;
            kinds[3] += (marks & Triangulation::RingOpen) != 0;
        }
    }
    EXPECT_GT(flips, 100);
    for (int v = 0; v < known.VertexCount(); ++v)
        EXPECT_LT(Norm(known.position[v] - walked.position[v]), 1e-6);
    return kinds;
}

TEST(Relocator, KnownRingsChangeNothing)
{
    const auto smooth = CompareKnownRings(meshes::MakeModel(shapes::Bumpy(3), 642, 180));
    EXPECT_GT(smooth[0], 600);
    EXPECT_EQ(smooth[1] + smooth[2] + smooth[3], 0);

    shapes::Shape box = shapes::Box(1, 1, 1);
    for (int i = 0; i < 4; ++i)
        box = shapes::Subdivide(box);
    const auto creased = CompareKnownRings(meshes::MakeModel(box, static_cast<int>(box.points.size()), 40));
    EXPECT_GT(creased[0], 600);
    EXPECT_GT(creased[1], 100);
    EXPECT_GT(creased[2], 100);
    EXPECT_EQ(creased[3], 0);

    const auto open = CompareKnownRings(meshes::MakeModel(shapes::FlatGrid(24), 625, 40));
    EXPECT_GT(open[0], 300);
    EXPECT_GT(open[3], 80);
    EXPECT_EQ(open[3], open[2]);
}

TEST(Relocator, AscendFollowsTheGradientAndRaisesTheScore)
{
    const Model model = meshes::MakeModel(shapes::FlatGrid(8), 81, 180);
    const Remesh r = meshes::AsRemesh(model);
    const Point target(0.45, 0.53, 0);
    int v = 0;
    while (r.place[v].kind != VertexKind::Free || Norm(r.position[v] - target) > 0.13)
        ++v;
    const double before = Norm(r.position[v] - target);
    const Point start = r.position[v];
    const auto nearness = [&](const LocalStar &, const Point &q, Point *gradient, double) {
        const Point d = target - start - q;
        if (gradient != nullptr)
            *gradient += d;
        return -Norm(d);
    };
    for (const bool cheap : {false, true}) {
        Remesh moved = r;
        Relocator relocator(model, moved);
        EXPECT_TRUE(relocator.Ascend(v, 0.2, nearness, cheap));
        EXPECT_LT(Norm(moved.position[v] - target), before);
        EXPECT_GT(Dot(moved.position[v] - start, target - start), 0.99 * Norm(moved.position[v] - start) * before);
        // Down the same slope it does not go.
        const auto slope = [](const LocalStar &, const Point &q, Point *gradient, double) {
            if (gradient != nullptr)
                *gradient += Point(1, 0, 0);
            return -SquaredNorm(q);
        };
        EXPECT_FALSE(relocator.Ascend(v, 0.2, slope, cheap));
    }
}

TEST(Perturbation, StepsLieInTheTangentPlaneWithinLambda)
{
    const Model model = meshes::MakeModel(shapes::Bumpy(3), 600, 180);
    Remesh r = meshes::AsRemesh(model);
    Relocator relocator(model, r);
    Random random(1);
    double longest = 0;
    relocator.Sweep([&](const LocalStar &star, int v) {
        const Point d = Perturbation{0.2, random.Bits()}(star, v);
        EXPECT_NEAR(Dot(d, Normalized(star.normal)), 0, 1e-12);
        EXPECT_LE(Norm(d), 0.2 * star.radius * (1 + 1e-9));
        longest = std::max(longest, Norm(d) / star.radius);
        return Point(0, 0, 0);
    });
    EXPECT_GT(longest, 0.19);
}

} // namespace
} // namespace relocation_test
