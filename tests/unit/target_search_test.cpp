// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/target_search.h>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/mesh_quality.h>

#include "support/meshes.h"

namespace target_search_test {
namespace {

using namespace vcg::ccdm;
using meshes::MeshD;

Report Search(const shapes::Shape &s, const Params &p, MeshTables &out,
              const TargetSearch::Progress &progress = nullptr)
{
    return TargetSearch(p, progress).Run(meshes::Tables(s), out);
}

Params ForLength(double length)
{
    Params p;
    p.edgeLength = length;
    p.globalIterations = 10;
    return p;
}

Params ForError(double error)
{
    Params p;
    p.maxError = error;
    p.globalIterations = 10;
    return p;
}

double Distance(const shapes::Shape &s, const MeshTables &out)
{
    MeshD a, b;
    meshes::Fill(a, s);
    meshes::Fill(b, meshes::ToShape(out));
    return vcg::tri::MeshQuality<MeshD>::Distance(a, b, 200000).hausdorff;
}

TEST(TargetSearch, MeetsTheEdgeLengthInOneRun)
{
    struct Case {
        shapes::Shape shape;
        double angle, length;
    };
    for (const Case &c : {Case{shapes::Bumpy(4), 180, 0.1}, Case{shapes::CadPart(), 40, 0.12},
                          Case{shapes::Plate(40), 60, 0.08}, Case{shapes::RoundTorus(60, 30), 180, 0.15}}) {
        Params p = ForLength(c.length);
        p.featureAngle = c.angle;
        MeshTables out;
        const Report r = Search(c.shape, p, out);
        ASSERT_EQ(r.status, Status::Done) << r.message;
        EXPECT_EQ(r.target, TargetKind::EdgeLength);
        EXPECT_EQ(r.asked, c.length);
        EXPECT_NEAR(r.reached, c.length, 0.02 * c.length);
        EXPECT_EQ(r.runs, 1);
        // The same from the tables handed out.
        double sum = 0;
        int edges = 0;
        const ReferenceSurface surface(out.position, out.face);
        for (int t = 0; t < surface.FaceCount(); ++t)
            for (int e = 0; e < 3; ++e)
                if (surface.mesh.Mate(MakeSide(t, e)) < MakeSide(t, e)) {
                    sum += Norm(out.position[surface.mesh.Tail(MakeSide(t, e))] -
                                out.position[surface.mesh.Head(MakeSide(t, e))]);
                    ++edges;
                }
        EXPECT_NEAR(sum / edges, r.reached, 1e-9);
    }
}

TEST(TargetSearch, MeetsTheEdgeLengthWithADensity)
{
    Params p = ForLength(0.08);
    p.density = DensityKind::Curvature;
    MeshTables out;
    const Report r = Search(shapes::Bumpy(5), p, out);
    ASSERT_EQ(r.status, Status::Done) << r.message;
    EXPECT_NEAR(r.reached, 0.08, 0.02 * 0.08);
}

TEST(TargetSearch, ASecondRunPutsTheEdgeLengthOfARoughSurfaceRight)
{
    shapes::Shape rough = shapes::Sphere(5);
    shapes::AddNoise(rough, 0.02);
    MeshTables out;
    const Report r = Search(rough, ForLength(0.2), out);
    ASSERT_EQ(r.status, Status::Done) << r.message;
    EXPECT_EQ(r.runs, 2);
    EXPECT_NEAR(r.reached, 0.2, 0.02 * 0.2);
}

TEST(TargetSearch, EdgeLengthScalesWithTheMesh)
{
    shapes::Shape large = shapes::Bumpy(3);
    MeshTables small, scaled;
    const Report a = Search(large, ForLength(0.25), small);
    for (auto &q : large.points)
        for (double &x : q)
            x *= 1024;
    const Report b = Search(large, ForLength(0.25 * 1024), scaled);
    EXPECT_EQ(small.face, scaled.face);
    EXPECT_EQ(1024 * a.reached, b.reached);
}

TEST(TargetSearch, StaysWithinTheLargestError)
{
    struct Case {
        shapes::Shape shape;
        double angle, error;
    };
    for (const Case &c : {Case{shapes::Bumpy(4), 180, 0.004}, Case{shapes::CadPart(), 40, 0.004},
                          Case{shapes::RoundTorus(60, 30), 180, 0.01}}) {
        Params p = ForError(c.error);
        p.featureAngle = c.angle;
        MeshTables out;
        const Report r = Search(c.shape, p, out);
        ASSERT_EQ(r.status, Status::Done) << r.message;
        EXPECT_EQ(r.target, TargetKind::MaxError);
        EXPECT_EQ(r.resultTopology.vertices, static_cast<int>(out.position.size()));
        EXPECT_EQ(r.energy.size(), 11U) << "a full run is handed out";
        EXPECT_LE(r.reached, c.error);
        EXPECT_LE(Distance(c.shape, out), c.error);
        EXPECT_LE(r.runs, 8);
        // Half the vertices do not come as close.
        Params fewer = p;
        fewer.maxError.reset();
        fewer.vertexCount = r.resultTopology.vertices / 2;
        MeshTables other;
        EXPECT_EQ(Search(c.shape, fewer, other).status, Status::Done);
        EXPECT_GT(Distance(c.shape, other), c.error);
    }
}

TEST(TargetSearch, FewVerticesAreEnoughForAFlatSidedBox)
{
    Params p = ForError(1e-6);
    MeshTables out;
    const Report r = Search(shapes::Box(1, 2, 3), p, out);
    ASSERT_EQ(r.status, Status::Done) << r.message;
    EXPECT_LE(out.position.size(), 16U);
    EXPECT_LE(Distance(shapes::Box(1, 2, 3), out), 1e-6);
}

TEST(TargetSearch, SaysSoWhenTheErrorCannotBeReached)
{
    Params p = ForError(1e-9);
    p.globalIterations = 1;
    MeshTables out;
    const Report r = Search(shapes::Sphere(3), p, out);
    EXPECT_EQ(r.status, Status::NotReached);
    EXPECT_GT(r.reached, 1e-9);
    EXPECT_NE(r.message.find(" came within "), std::string::npos) << r.message;
    EXPECT_EQ(r.message.find("100000"), std::string::npos) << "not the cap, if it was not tried: " << r.message;
    EXPECT_TRUE(out.position.empty());
}

TEST(TargetSearch, TheDefaultIsTheDefaultGiven)
{
    // So that by default too the search begins with runs of few iterations.
    for (const OptimizerKind optimizer : {OptimizerKind::Accelerated, OptimizerKind::Annealing}) {
        Params p = ForError(0.02);
        p.optimizer = optimizer;
        p.globalIterations.reset();
        MeshTables unset, set;
        const Report a = Search(shapes::Bumpy(3), p, unset);
        p.globalIterations = GlobalIterations(p);
        const Report b = Search(shapes::Bumpy(3), p, set);
        ASSERT_EQ(a.status, Status::Done) << a.message;
        EXPECT_EQ(a.runs, b.runs);
        EXPECT_EQ(a.reached, b.reached);
        EXPECT_EQ(unset.position, set.position);
        EXPECT_EQ(unset.face, set.face);
    }
}

TEST(TargetSearch, TheLargestErrorIsTheSameFarFromTheOriginAndAtAnySize)
{
    // Coordinates of few digits, so that moving them rounds nothing. Boxes of single precision around the moved
    // points would hold everything, those of the shrunken ones nothing.
    shapes::Shape near = shapes::Bumpy(3);
    for (auto &q : near.points)
        for (double &x : q)
            x = std::round(x * 0x1p20) * 0x1p-20;
    shapes::Shape far = near, small = near;
    for (auto &q : far.points)
        for (double &x : q)
            x += 0x1p24;
    for (auto &q : small.points)
        for (double &x : q)
            x *= 0x1p-90;
    MeshTables a, b, c;
    const Report atOrigin = Search(near, ForError(0.02), a), away = Search(far, ForError(0.02), b),
                 tiny = Search(small, ForError(0.02), c);
    ASSERT_EQ(atOrigin.status, Status::Done) << atOrigin.message;
    // The result's coordinates are rounded out there.
    EXPECT_NEAR(away.reached, atOrigin.reached, 1e-6);
    EXPECT_EQ(b.face, a.face);
    EXPECT_EQ(tiny.reached, atOrigin.reached);
    EXPECT_EQ(c.face, a.face);
}

TEST(TargetSearch, AnEdgeLengthOutOfReachIsTold)
{
    const shapes::Shape triangle = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    MeshTables out;
    const Report r = Search(triangle, ForLength(100), out);
    ASSERT_EQ(r.status, Status::Done) << r.message;
    EXPECT_LT(r.reached, 2);
    ASSERT_FALSE(r.warnings.empty());
    EXPECT_NE(r.warnings.back().find("the edge length asked for was not reached"), std::string::npos);
    EXPECT_NE(r.warnings.back().find("fewer vertices cannot be had"), std::string::npos);
}

TEST(TargetSearch, RefusesFacesOfMissingVertices)
{
    for (const int index : {-1, 42, 1 << 30}) {
        MeshTables in = meshes::Tables(shapes::Sphere(1)), out;
        in.face[5][1] = index;
        for (const bool byError : {false, true}) {
            Params p;
            if (byError)
                p.maxError = 0.1;
            else
                p.vertexCount = 100;
            const Report r = TargetSearch(p, nullptr).Run(in, out);
            EXPECT_EQ(r.status, Status::InvalidInput);
            EXPECT_EQ(r.message, "a face names a vertex that does not exist");
        }
    }
}

TEST(TargetSearch, WantsExactlyOneTarget)
{
    const auto status = [](int n, std::optional<double> length, std::optional<double> error) {
        Params p;
        p.vertexCount = n;
        p.edgeLength = length;
        p.maxError = error;
        p.globalIterations = 1;
        MeshTables out;
        const Report r = Search(shapes::Sphere(2), p, out);
        EXPECT_EQ(r.message.empty(), r.status == Status::Done);
        return r.status;
    };
    EXPECT_EQ(status(0, {}, {}), Status::InvalidParameter);
    EXPECT_EQ(status(100, 0.2, {}), Status::InvalidParameter);
    EXPECT_EQ(status(100, {}, 0.1), Status::InvalidParameter);
    EXPECT_EQ(status(0, 0.2, 0.1), Status::InvalidParameter);
    EXPECT_EQ(status(0, 0.0, {}), Status::InvalidParameter);
    EXPECT_EQ(status(0, -1.0, {}), Status::InvalidParameter);
    EXPECT_EQ(status(0, std::nan(""), {}), Status::InvalidParameter);
    EXPECT_EQ(status(0, 1e-9, {}), Status::InvalidParameter) << "too many vertices";
    EXPECT_EQ(status(0, {}, 0.0), Status::InvalidParameter);
    EXPECT_EQ(status(0, {}, 1.5), Status::InvalidParameter);
    EXPECT_EQ(status(0, {}, std::nan("")), Status::InvalidParameter);
    EXPECT_EQ(status(100, {}, {}), Status::Done);
    EXPECT_EQ(status(0, 0.5, {}), Status::Done);
    EXPECT_EQ(status(0, {}, 0.1), Status::Done);
}

TEST(TargetSearch, ProgressNeverFallsAndCancels)
{
    int last = 0, calls = 0, stop = 0;
    bool monotone = true, after = false;
    const auto count = [&](int at, const char *phase) {
        after = after || (stop > 0 && calls >= stop);
        monotone = monotone && at >= last && at <= 100 && *phase != 0;
        last = at;
        return ++calls != stop;
    };
    Params p = ForError(0.02);
    p.globalIterations = 2;
    MeshTables out;
    ASSERT_EQ(Search(shapes::Bumpy(3), p, out, count).status, Status::Done);
    EXPECT_TRUE(monotone);
    EXPECT_EQ(last, 100);
    const int total = calls;
    for (stop = 1; stop < total; stop += 1 + total / 12) {
        calls = last = 0;
        after = false;
        MeshTables none;
        EXPECT_EQ(Search(shapes::Bumpy(3), p, none, count).status, Status::Cancelled) << stop << " of " << total;
        EXPECT_FALSE(after) << "asked again after it said stop";
        EXPECT_TRUE(none.position.empty());
    }
}

TEST(TargetSearch, IsTheSameForAnyNumberOfThreads)
{
    Params p = ForError(0.006);
    p.threads = 1;
    MeshTables one, more;
    const Report a = Search(shapes::Bumpy(4), p, one);
    p.threads = 3;
    const Report b = Search(shapes::Bumpy(4), p, more);
    EXPECT_EQ(a.reached, b.reached);
    EXPECT_EQ(one.position, more.position);
    EXPECT_EQ(one.face, more.face);
}

} // namespace
} // namespace target_search_test
