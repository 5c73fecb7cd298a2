// SPDX-License-Identifier: GPL-3.0-or-later
// What must hold for every surface, vertex count and seed.
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm_remeshing.h>
#include <vcg/complex/algorithms/mesh_quality.h>

#include "support/meshes.h"

namespace {

using meshes::MeshD;
using vcg::ccdm::MeshTables;
using vcg::ccdm::Params;
using vcg::ccdm::Remesher;
using vcg::ccdm::Report;
using vcg::ccdm::Status;
using vcg::tri::MeshQualityReport;

struct Case {
    const char *name;
    shapes::Shape shape;
    double angle;
    double averageAngle; ///< least average of the smallest angles at n = 2500; 1.5 degrees less at n = 400
};

const std::vector<Case> &Cases()
{
    static const std::vector<Case> cases = {
        {"sphere", shapes::Sphere(4), 180, 52},
        {"bumpy", shapes::Bumpy(4), 180, 52},
        {"torus", shapes::RoundTorus(60, 30), 180, 52},
        {"high_genus", shapes::HighGenus(2), 180, 49},
        {"cad_part", shapes::CadPart(), 40, 49},
        {"box", shapes::Box(1, 2, 3), 40, 50},
        {"thin_box", shapes::Box(1, 1, 0.05), 40, 50},
        {"twisted_bar", shapes::TwistedBar(80, 3), 60, 50},
        {"plate", shapes::Plate(40), 60, 50},
        {"bust", shapes::Bust(4, 0.02), 180, 50},
        {"klein_bottle", shapes::KleinBottle(80, 48), 180, 51},
        {"moebius", shapes::MoebiusStrip(80, 10), 180, 50},
        {"two_components", shapes::TwoComponents(), 180, 52},
    };
    return cases;
}

Params Parameters(const Case &c, int n, unsigned seed)
{
    Params p;
    p.vertexCount = n;
    p.featureAngle = c.angle;
    p.seed = seed;
    return p;
}

MeshTables Remeshed(const MeshTables &input, const Params &p, Report *report = nullptr)
{
    MeshTables out;
    const Report r = Remesher(p, nullptr).Run(input, out);
    EXPECT_EQ(r.status, Status::Done) << r.message;
    if (report != nullptr)
        *report = r;
    return out;
}

MeshQualityReport Measured(const MeshTables &t)
{
    MeshD m;
    meshes::Fill(m, meshes::ToShape(t));
    return vcg::tri::MeshQuality<MeshD>::Measure(m);
}

class EverySurface : public testing::TestWithParam<std::tuple<std::size_t, int, unsigned>>
{
};

TEST_P(EverySurface, KeepsItsTopologyAndGetsItsVertices)
{
    const Case &c = Cases()[std::get<0>(GetParam())];
    const int n = std::get<1>(GetParam());
    SCOPED_TRACE(c.name);
    const MeshTables input = meshes::Tables(c.shape);
    Report report;
    const MeshTables out = Remeshed(input, Parameters(c, n, std::get<2>(GetParam())), &report);
    const MeshQualityReport before = Measured(input), after = Measured(out);
    // Counted by the metrics, which know nothing of the remesher's tables.
    EXPECT_EQ(after.euler, before.euler);
    EXPECT_EQ(after.components, before.components);
    EXPECT_EQ(after.boundaryLoops, before.boundaryLoops);
    EXPECT_EQ(after.orientable, before.orientable);
    EXPECT_TRUE(after.manifold);
    EXPECT_EQ(after.unreferenced, 0);
    EXPECT_EQ(after.vertices, n + report.extraVertices);
    if (n >= 400) {
        EXPECT_EQ(report.extraVertices, 0);
        EXPECT_EQ(after.foldedEdges, 0);
        EXPECT_GT(after.angleMinAvg, n >= 2500 ? c.averageAngle : c.averageAngle - 1.5);
    }
    // Every vertex lies on the input.
    MeshD original, vertices;
    meshes::Fill(original, c.shape);
    const vcg::tri::TriangleTree tree(vcg::tri::TriangleSoup::From(original));
    int hint = -1;
    for (const auto &p : out.position)
        EXPECT_LT(std::sqrt(tree.SquaredDistance(p, hint)), 1e-12);
}

std::string NameOf(const testing::TestParamInfo<EverySurface::ParamType> &info)
{
    return std::string(Cases()[std::get<0>(info.param)].name) + "_" + std::to_string(std::get<1>(info.param)) +
           "_seed" + std::to_string(std::get<2>(info.param));
}

INSTANTIATE_TEST_SUITE_P(Surfaces, EverySurface,
                         testing::Combine(testing::Range<std::size_t>(0, Cases().size()),
                                          testing::Values(30, 400, 2500), testing::Values(1U, 2U)),
                         NameOf);

TEST(Targets, ManyHolesTakeNoMoreVerticesThanAsked)
{
    // The rims alone need more vertices than a coarse level has.
    const shapes::Shape s = shapes::Grid(
        31, 31, [](int i, int j) { return i % 2 == 0 || j % 2 == 0; },
        [](double x, double y) {
            return shapes::P{x, y, 0};
        });
    Params p;
    p.vertexCount = 4000;
    Report report;
    const MeshTables out = Remeshed(meshes::Tables(s), p, &report);
    EXPECT_EQ(report.inputTopology.boundaryLoops, 226);
    EXPECT_EQ(out.position.size(), 4000U);
}

TEST(Targets, EverySurfaceMeetsItsEdgeLength)
{
    for (const Case &c : Cases()) {
        Report first;
        const MeshTables input = meshes::Tables(c.shape);
        Remeshed(input, Parameters(c, 1500, 1), &first);
        Params p = Parameters(c, 0, 1);
        p.edgeLength = first.meanEdgeLength;
        MeshTables out;
        const Report r = vcg::ccdm::TargetSearch(p, nullptr).Run(input, out);
        ASSERT_EQ(r.status, Status::Done) << r.message;
        EXPECT_NEAR(r.reached, first.meanEdgeLength, 0.02 * first.meanEdgeLength) << c.name;
        EXPECT_LE(r.runs, 2) << c.name;
        EXPECT_NEAR(static_cast<double>(out.position.size()), 1500, 60) << c.name;
    }
}

TEST(Targets, SurfacesOfAllKindsKeepWithinTheirLargestError)
{
    // Smooth, creased, noisy with a boundary, one-sided.
    for (const std::size_t k : {1, 4, 8, 9}) {
        const Case &c = Cases()[k];
        Params p = Parameters(c, 0, 1);
        p.maxError = 0.01;
        p.globalIterations = 5;
        const MeshTables input = meshes::Tables(c.shape);
        MeshTables out;
        const Report r = vcg::ccdm::TargetSearch(p, nullptr).Run(input, out);
        ASSERT_EQ(r.status, Status::Done) << c.name << ": " << r.message;
        MeshD a, b;
        meshes::Fill(a, c.shape);
        meshes::Fill(b, meshes::ToShape(out));
        EXPECT_LE(vcg::tri::MeshQuality<MeshD>::Distance(a, b, 50000).hausdorff, 0.01) << c.name;
    }
}

TEST(Certificate, AgreesWithTheMetricsOnEverySurface)
{
    for (const Case &c : Cases())
        for (const int n : {60, 1000}) {
            Report r;
            const MeshTables out = Remeshed(meshes::Tables(c.shape), Parameters(c, n, 1), &r);
            EXPECT_NEAR(r.angles.reached, Measured(out).angleMin, 1e-6) << c.name;
            EXPECT_EQ(r.angles.below.empty(), r.angles.reached >= 40 - 1e-6) << c.name;
        }
}

TEST(Determinism, SameSeedSameBytes)
{
    for (const Case &c : Cases()) {
        const MeshTables input = meshes::Tables(c.shape);
        const MeshTables a = Remeshed(input, Parameters(c, 500, 3)), b = Remeshed(input, Parameters(c, 500, 3));
        EXPECT_EQ(a.position, b.position) << c.name;
        EXPECT_EQ(a.face, b.face) << c.name;
        EXPECT_NE(a.position, Remeshed(input, Parameters(c, 500, 4)).position) << c.name;
    }
}

TEST(Metamorphic, ScalingByAPowerOfTwoScalesTheResult)
{
    for (const Case &c : {Cases()[1], Cases()[4]}) {
        MeshTables scaled = meshes::Tables(c.shape);
        const MeshTables a = Remeshed(scaled, Parameters(c, 500, 1));
        for (auto &p : scaled.position)
            p *= 1.0 / 1024;
        const MeshTables b = Remeshed(scaled, Parameters(c, 500, 1));
        EXPECT_EQ(a.face, b.face);
        for (std::size_t v = 0; v < a.position.size(); ++v)
            EXPECT_EQ(a.position[v] / 1024.0, b.position[v]);
    }
}

TEST(Metamorphic, RenumberingDoesNotMatter)
{
    for (const Case &c : Cases()) {
        const MeshTables input = meshes::Tables(c.shape);
        MeshTables other;
        const int n = static_cast<int>(input.position.size());
        other.position.resize(n);
        for (int v = 0; v < n; ++v)
            other.position[n - 1 - v] = input.position[v];
        for (auto f = input.face.rbegin(); f != input.face.rend(); ++f)
            other.face.push_back({n - 1 - (*f)[2], n - 1 - (*f)[0], n - 1 - (*f)[1]});
        // Vertices at equal positions would be told apart by number only.
        EXPECT_EQ(Remeshed(input, Parameters(c, 400, 1)).position, Remeshed(other, Parameters(c, 400, 1)).position)
            << c.name;
    }
}

TEST(Metamorphic, RotationKeepsQuality)
{
    const Case &c = Cases()[1];
    MeshTables turned = meshes::Tables(c.shape);
    const double plain = Measured(Remeshed(turned, Parameters(c, 1500, 1))).angleMinAvg;
    for (auto &p : turned.position)
        p = vcg::ccdm::Point(0.6 * p[0] - 0.8 * p[1], 0.8 * p[0] + 0.6 * p[1], p[2]);
    EXPECT_NEAR(Measured(Remeshed(turned, Parameters(c, 1500, 1))).angleMinAvg, plain, 0.4);
}

TEST(Metamorphic, ASecondCopyGetsItsShare)
{
    const Case &c = Cases()[1];
    const MeshTables two = meshes::Tables(shapes::Together(c.shape, c.shape, 10));
    const MeshTables out = Remeshed(two, Parameters(c, 2000, 1));
    const auto left = std::count_if(out.position.begin(), out.position.end(), [](const auto &p) { return p[0] < 5; });
    EXPECT_NEAR(static_cast<double>(left), 1000, 20);
    EXPECT_EQ(Measured(out).components, 2);
}

TEST(Metamorphic, FarFromTheOriginAndTiny)
{
    const Case &c = Cases()[4];
    const double plain = Measured(Remeshed(meshes::Tables(c.shape), Parameters(c, 600, 1))).angleMinAvg;
    MeshTables far = meshes::Tables(c.shape), tiny = far;
    for (auto &p : far.position)
        p += vcg::ccdm::Point(1e7, -1e7, 1e7);
    for (auto &p : tiny.position)
        p *= 1e-9;
    EXPECT_NEAR(Measured(Remeshed(far, Parameters(c, 600, 1))).angleMinAvg, plain, 0.7);
    EXPECT_NEAR(Measured(Remeshed(tiny, Parameters(c, 600, 1))).angleMinAvg, plain, 0.7);
}

TEST(Threads, GiveTheSameBytes)
{
    for (const std::size_t k : {std::size_t{1}, std::size_t{4}})
        for (const auto optimizer : {vcg::ccdm::OptimizerKind::Accelerated, vcg::ccdm::OptimizerKind::Annealing}) {
            const Case &c = Cases()[k];
            Params p = Parameters(c, 6000, 1);
            p.optimizer = optimizer;
            p.globalIterations = 6;
            p.threads = 1;
            const MeshTables one = Remeshed(meshes::Tables(c.shape), p);
            for (const int threads : {2, 4}) {
                p.threads = threads;
                const MeshTables more = Remeshed(meshes::Tables(c.shape), p);
                ASSERT_EQ(more.position.size(), one.position.size());
                for (std::size_t v = 0; v < one.position.size(); ++v)
                    ASSERT_EQ(more.position[v], one.position[v]);
                ASSERT_EQ(more.face, one.face);
            }
        }
}

TEST(VertexCounts, FromTooFewToFarMoreThanTheInput)
{
    for (const int n : {4, 5, 8, 12, 20, 50, 1000, 10000}) {
        Report r;
        const MeshTables out = Remeshed(meshes::Tables(shapes::Sphere(2)), Parameters(Cases()[0], n, 1), &r);
        EXPECT_EQ(static_cast<int>(out.position.size()), n);
        EXPECT_EQ(r.extraVertices, 0);
    }
    Report r;
    const MeshTables torus = Remeshed(meshes::Tables(shapes::RoundTorus(30, 20)), Parameters(Cases()[2], 4, 1), &r);
    EXPECT_GE(torus.position.size(), 7U);
    EXPECT_EQ(r.extraVertices, static_cast<int>(torus.position.size()) - 4);
    EXPECT_FALSE(r.warnings.empty());
}

TEST(Quality, MoreIterationsGiveBetterTriangles)
{
    const Case &c = Cases()[1];
    Params p = Parameters(c, 1500, 1);
    double last = 0;
    for (const int rounds : {0, 5, 40}) {
        p.globalIterations = rounds;
        const double angle = Measured(Remeshed(meshes::Tables(c.shape), p)).angleMinAvg;
        EXPECT_GT(angle, last + 0.3);
        last = angle;
    }
    EXPECT_GT(last, 52.2);
}

} // namespace
