// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/polish.h>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/centroid_rules.h>
#include <vcg/complex/algorithms/ccdm/extremes.h>
#include <vcg/complex/algorithms/ccdm/result_check.h>
#include <vcg/complex/algorithms/ccdm/verification.h>

#include "support/meshes.h"

namespace polish_test {
namespace {

using namespace vcg::ccdm;

double SmallestAngle(const Remesh &r)
{
    double least = Pi;
    for (const Triangle &T : r.mesh.triangle)
        for (int i = 0; i < 3; ++i) {
            const Point &x = r.position[T.v[i]];
            const Point u = r.position[T.v[Next(i)]] - x, w = r.position[T.v[Prev(i)]] - x;
            least = std::min(least, std::atan2(Norm(Cross(u, w)), Dot(u, w)));
        }
    return least * 180 / Pi;
}

TEST(Polish, RaisesTheSmallestAngle)
{
    const Model model = meshes::MakeModel(shapes::Sphere(4), 2562, 180);
    Remesh r = meshes::AsRemesh(model);
    Relocator relocator(model, r);
    Random random(3);
    for (int i = 0; i < 3; ++i)
        relocator.Sweep(Perturbation{0.4, random.Bits()});
    const double before = SmallestAngle(r);
    ASSERT_LT(before, 25);
    EXPECT_EQ(Polish(model, r, meshes::Alone()).RaiseAngles(34, 0.1, 40), 0);
    EXPECT_GE(SmallestAngle(r), 34 - 1e-6);
    EXPECT_EQ(VerifyTriangulation(r.mesh).fault, "");
}

TEST(Polish, LeavesPinnedVerticesWhereTheyAre)
{
    const Model model = meshes::MakeModel(shapes::Sphere(4), 2562, 180);
    for (const std::uint64_t seed : {1, 7, 13}) {
        Remesh r = meshes::AsRemesh(model);
        Relocator(model, r).Sweep(Perturbation{0.4, seed});
        std::vector<int> pinned;
        for (int v = 0; v < r.VertexCount(); v += 5)
            pinned.push_back(v);
        const std::vector<Point> before = r.position;
        Polish polish(model, r, meshes::Alone());
        polish.Pin(pinned);
        const int left = polish.RaiseAngles(34, 0.1, 40);
        int moved = 0;
        for (int v = 0; v < r.VertexCount(); ++v)
            if (r.position[v] != before[v]) {
                EXPECT_NE(v % 5, 0);
                ++moved;
            }
        EXPECT_GT(moved, 50);
        EXPECT_GT(left, 0);
        // What the pins have hindered is mended without them.
        polish.Pin({});
        EXPECT_EQ(polish.RaiseAngles(34, 0.1, 40), 0);
        EXPECT_GE(SmallestAngle(r), 34 - 1e-6);
    }
}

TEST(Polish, OpensAFold)
{
    // One vertex of a plane mesh drawn across its neighbours.
    const Model model = meshes::MakeModel(shapes::FlatGrid(10), 121, 180);
    Remesh r = meshes::AsRemesh(model);
    for (int v = 0; v < r.VertexCount(); ++v)
        if (Norm(r.position[v] - Point(0.5, 0.5, 0)) < 1e-9) {
            r.position[v] = Point(0.63, 0.55, 0);
            for (int t = 0; t < model.surface.FaceCount(); ++t)
                if (model.surface.NearestOn(t, r.position[v]).squaredDistance < 1e-20)
                    r.place[v].face = t;
        }
    ASSERT_GT(ResultCheck(model, r).foldedEdges, 0);
    EXPECT_NE(ResultCheck(model, r).fault, "") << "a fold on a plane must not pass";
    EXPECT_EQ(Polish(model, r, meshes::Alone()).Unfold(20), 0);
    EXPECT_EQ(ResultCheck(model, r).foldedEdges, 0);
    EXPECT_EQ(ResultCheck(model, r).fault, "");
}

TEST(ExtremeCapture, PutsAVertexOnATip)
{
    // A sphere with one spike, and a remesh that has the spike's vertex elsewhere.
    shapes::Shape s = shapes::Sphere(4);
    int tip = 0;
    for (std::size_t v = 0; v < s.points.size(); ++v)
        if (s.points[v][2] > s.points[tip][2])
            tip = static_cast<int>(v);
    const shapes::P axis = s.points[tip];
    for (auto &p : s.points) {
        const double d = std::hypot(p[0] - axis[0], p[1] - axis[1], p[2] - axis[2]);
        const double lift = 1 + 0.25 * std::exp(-d * d / 0.01);
        for (double &x : p)
            x *= lift;
    }
    const Model model = meshes::MakeModel(s, 2562, 180);
    Remesh r = meshes::AsRemesh(model);
    Relocator relocator(model, r);
    // Half a spacing off the tip.
    relocator.Sweep([&](const LocalStar &star, int v) {
        return v == tip ? Relocator::TangentStep(star, 0.43 * star.radius, 0.13 * star.radius) : Point(0, 0, 0);
    });
    const double off = Norm(r.position[tip] - model.surface.position[tip]);
    ASSERT_GT(off, 0);
    Probes probes(model, r, meshes::Alone());
    const std::vector<int> captured = ExtremeCapture(model, r, probes, meshes::Alone()).Run(5, 10);
    ASSERT_EQ(captured.size(), 1U);
    EXPECT_EQ(Norm(r.position[captured[0]] - model.surface.position[tip]), 0);
}

// A sphere with one vertex lifted by so many spacings, and a remesh that is round there: how far from the tip the
// nearest vertex lies, in spacings, once tips were captured with `minAngle` degrees at least.
double AfterCapture(double lift, double minAngle)
{
    constexpr int lifted = 20;
    shapes::Shape s = shapes::Sphere(4);
    const double h = meshes::MakeModel(s, 2562, 180).density.spacing[0];
    for (double &x : s.points[lifted])
        x *= 1 + lift * h;
    const Model model = meshes::MakeModel(s, 2562, 180);
    Remesh r = meshes::AsRemesh(model);
    const Point tip = r.position[lifted];
    r.position[lifted] /= 1 + lift * h;
    Probes probes(model, r, meshes::Alone());
    ExtremeCapture(model, r, probes, meshes::Alone()).Run(5, minAngle);
    for (int t = 0; t < r.mesh.TriangleCount(); ++t)
        EXPECT_LE(LargestCosine(r, t), std::cos(25 * Pi / 180));
    double nearest = 1e300;
    for (const Point &p : r.position)
        nearest = std::min(nearest, Norm(p - tip) / h);
    return nearest;
}

TEST(ExtremeCapture, APartThatIsMissingMayHaveSmallerAngles)
{
    // On the tips the angles are 42 and 38 degrees; on the last they would be less than 25.
    EXPECT_EQ(AfterCapture(0.9, 30), 0);
    EXPECT_GT(AfterCapture(0.9, 50), 0.8);
    EXPECT_EQ(AfterCapture(1.1, 50), 0);
    EXPECT_GT(AfterCapture(3.5, 50), 0.5);
}

TEST(ExtremeCapture, CapturesInSeveralRegionsOnAnyNumberOfThreads)
{
    constexpr int every = 997;
    shapes::Shape s = shapes::Sphere(6);
    const int count = static_cast<int>(s.points.size());
    ASSERT_GT(Regions::Count(count), 1);
    const double h = meshes::MakeModel(s, count, 180).density.spacing[0], lift = 1 + 0.5 * h;
    for (int v = every; v < count; v += every)
        for (double &x : s.points[v])
            x *= lift;
    const Model model = meshes::MakeModel(s, count, 180);
    Remesh first;
    std::vector<int> firstCaptured;
    for (const int threads : {1, 2, 4}) {
        Workers workers(threads);
        Remesh r = meshes::AsRemesh(model);
        std::vector<Point> tips;
        for (int v = every; v < count; v += every) {
            tips.push_back(r.position[v]);
            r.position[v] /= lift;
        }
        Probes probes(model, r, workers);
        const std::vector<int> captured = ExtremeCapture(model, r, probes, workers).Run(5, 25);
        EXPECT_GE(captured.size(), tips.size());
        for (const Point &tip : tips) {
            double nearest = 1e300;
            for (const int v : captured)
                nearest = std::min(nearest, Norm(r.position[v] - tip));
            EXPECT_LT(nearest, 0.3 * h) << "it was 0.5";
        }
        EXPECT_EQ(VerifyTriangulation(r.mesh).fault, "");
        if (threads == 1) {
            first = r;
            firstCaptured = captured;
        }
        EXPECT_EQ(captured, firstCaptured) << threads;
        EXPECT_EQ(r.position, first.position) << threads;
        EXPECT_TRUE(meshes::SameTriangles(r, first)) << threads;
    }
}

TEST(ExtremeCapture, TakesWhatLooksFarOnlyFromTheWrongSheetForNear)
{
    // Every probe of a mesh that holds all vertices of the input is at distance zero, however crumpled that is.
    const Model model = meshes::MakeModel(shapes::Bust(4, 0.5), 2562, 180);
    Remesh r = meshes::AsRemesh(model);
    Probes probes(model, r, meshes::Alone());
    const std::vector<Point> before = r.position;
    EXPECT_TRUE(ExtremeCapture(model, r, probes, meshes::Alone()).Run(5, 25).empty());
    for (std::size_t v = 0; v < before.size(); ++v)
        EXPECT_EQ(Norm(r.position[v] - before[v]), 0);
}

TEST(Polish, GivesUpOnWhatCannotBeHelped)
{
    // A wire: no mesh with so few vertices has good angles. Bounded by attempts, not by the clock: the flips and
    // moves of a bounded polish leave most triangles as they are.
    const Model model = meshes::MakeModel(shapes::RoundTorus(200, 6, 0.01), 100, 180);
    Remesh r = meshes::AsRemesh(model);
    const std::vector<Point> before = r.position;
    Polish polish(model, r, meshes::Alone());
    EXPECT_GT(polish.RaiseAngles(40, 0.1, 20), 1000);
    int moved = 0;
    for (std::size_t v = 0; v < before.size(); ++v)
        moved += Norm(r.position[v] - before[v]) > 0;
    EXPECT_LT(moved, r.VertexCount());
    EXPECT_EQ(VerifyTriangulation(r.mesh).fault, "");
}

TEST(Polish, ShakesWhatNoSmallMoveHelpsAndSpoilsNothing)
{
    int better = 0, left = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const Model model = meshes::MakeModel(shapes::Bumpy(3), 642, 180);
        Remesh r = meshes::AsRemesh(model);
        Relocator relocator(model, r);
        for (unsigned i = 0; i < 3; ++i) {
            relocator.Sweep(Perturbation{0.5, 100 * seed + i});
            DelaunayFlipper(meshes::Alone()).Run(r);
        }
        Polish polish(model, r, meshes::Alone());
        if (polish.RaiseAngles(40, 0.2, 20) == 0)
            continue;
        ++left;
        const double before = SmallestAngle(r);
        polish.Shake(seed, 50);
        EXPECT_GE(SmallestAngle(r), before - 1e-9);
        better += SmallestAngle(r) > before + 1e-3;
        EXPECT_EQ(VerifyTriangulation(r.mesh).fault, "");
        for (int v = 0; v < r.VertexCount(); ++v)
            EXPECT_LT(model.surface.NearestOn(r.place[v].face, r.position[v]).squaredDistance, 1e-20);
    }
    EXPECT_GT(left, 4);
    EXPECT_GT(better, left / 2);
}

TEST(ResultCheck, PassesASoundMeshAndFindsBadOnes)
{
    const Model model = meshes::MakeModel(shapes::Bumpy(3), 600, 180);
    Remesh r = meshes::AsRemesh(model);
    EXPECT_EQ(ResultCheck(model, r).fault, "");
    Remesh broken = r;
    broken.position[5] = Point(0, std::nan(""), 0);
    EXPECT_NE(ResultCheck(model, broken).fault, "");
    broken = r;
    broken.mesh.triangle[7].n[0] = NoSide;
    EXPECT_NE(ResultCheck(model, broken).fault, "");
}

TEST(ResultCheck, AllowsTheFoldsOfAKnifeEdge)
{
    // A wedge of 10 degrees whose edge is not marked as a feature.
    const shapes::Shape s = {{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0.09}, {0.5, 1, -0.09}}, {{0, 1, 2}, {1, 0, 3}}};
    const Model model = meshes::MakeModel(s, 10, 180);
    const Remesh r = meshes::AsRemesh(model);
    const ResultCheck check(model, r);
    EXPECT_EQ(check.foldedEdges, 1);
    EXPECT_EQ(check.fault, "");
}

} // namespace
} // namespace polish_test
