// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/certificate.h>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/initial_mesh.h>
#include <vcg/complex/algorithms/ccdm/remesher.h>
#include <vcg/complex/algorithms/ccdm/sampling.h>

#include "support/meshes.h"

namespace certificate_test {
namespace {

using namespace vcg::ccdm;
using Reason = SmallAngleReason;

Report Remeshed(const shapes::Shape &s, int n, double angle, double minAngle, MeshTables &out, int iterations = 20)
{
    Params p;
    p.vertexCount = n;
    p.featureAngle = angle;
    p.minAngle = minAngle;
    p.globalIterations = iterations;
    Report r = Remesher(p, nullptr).Run(meshes::Tables(s), out);
    EXPECT_EQ(r.status, Status::Done) << r.message;
    return r;
}

// A flat triangle with a corner of 15 degrees at the origin, finely divided.
shapes::Shape Splinter()
{
    const double a = 15 * shapes::Pi / 180;
    shapes::Shape s = {{{0, 0, 0}, {4, 0, 0}, {4 * std::cos(a), 4 * std::sin(a), 0}}, {{0, 1, 2}}};
    for (int i = 0; i < 4; ++i)
        s = shapes::Subdivide(s);
    return s;
}

TEST(Certificate, NamesTheCornerOfASplinter)
{
    MeshTables out;
    const Report r = Remeshed(Splinter(), 150, 40, 40, out);
    EXPECT_LE(r.angles.reached, 15 + 1e-9);
    EXPECT_EQ(r.angles.Count(Reason::InputCorner), 1);
    for (const SmallAngle &a : r.angles.below)
        if (a.reason == Reason::InputCorner) {
            EXPECT_LT(std::hypot(a.position[0], a.position[1]), 0.3) << "at the tip";
            EXPECT_LE(a.degrees, 15 + 1e-9);
        }
    // Behind the tip the two sides are still closer than the spacing; the wide corners force nothing.
    EXPECT_EQ(r.angles.Count(Reason::ThinPart), 0);
    EXPECT_EQ(r.angles.Count(Reason::FewVertices), 0);
    for (const SmallAngle &a : r.angles.below)
        if (a.reason == Reason::CloseFeatures) {
            EXPECT_LT(std::hypot(a.position[0], a.position[1]), 2);
        }
}

TEST(Certificate, NamesTheRimsOfASlab)
{
    MeshTables out;
    const Report r = Remeshed(shapes::Extrude(shapes::FlatGrid(20), 0.02), 500, 40, 40, out);
    ASSERT_FALSE(r.angles.below.empty());
    int walls = 0;
    for (const SmallAngle &a : r.angles.below) {
        // A centroid between the two rims lies in a wall.
        const bool wall = a.position[2] > 1e-9 && a.position[2] < 0.02 - 1e-9;
        walls += wall;
        if (wall) {
            EXPECT_EQ(a.reason, Reason::CloseFeatures);
        }
    }
    EXPECT_GT(walls, 10);
}

AngleCertificate Certified(const Model &model, const Remesh &remesh, double target)
{
    ThinParts thin(model);
    return Certifier(model, remesh, thin, target, true).Run();
}

// A mesh of n random points, not optimised.
AngleCertificate CertifiedAtRandom(const shapes::Shape &s, int n, double target)
{
    const Model model = meshes::MakeModel(s, n, 180);
    SampleSet samples;
    Random random(1);
    samples.onFaces = SampleFaces(model.surface, model.density, n, random);
    Remesh r;
    EXPECT_TRUE(InitialMeshBuilder(model, samples).Build(r, [](double) { return true; }));
    return Certified(model, r, target);
}

TEST(Certificate, NamesAThinRod)
{
    const AngleCertificate c = CertifiedAtRandom(shapes::RoundTorus(200, 24, 0.05), 100, 45);
    ASSERT_FALSE(c.below.empty());
    EXPECT_GT(c.Count(Reason::ThinPart), 0);
    EXPECT_EQ(c.Count(Reason::ThinPart) + c.Count(Reason::FewVertices), static_cast<int>(c.below.size()));
}

TEST(Certificate, NamesTooFewVerticesOnABall)
{
    const AngleCertificate c = CertifiedAtRandom(shapes::Sphere(4), 14, 50);
    ASSERT_FALSE(c.below.empty());
    EXPECT_EQ(c.Count(Reason::FewVertices), static_cast<int>(c.below.size()));
}

TEST(Certificate, MakesUpNoReason)
{
    // Triangulations that could be better, of surfaces where nothing stands in the way.
    struct Case {
        shapes::Shape shape;
        double angle, target;
    };
    for (const Case &c :
         {Case{shapes::Sphere(3), 180, 58}, Case{shapes::RoundTorus(60, 30), 180, 50},
          Case{shapes::FlatGrid(20), 180, 50}, Case{shapes::Extrude(shapes::FlatGrid(10), 0.3), 40, 50}}) {
        const Model model = meshes::MakeModel(c.shape, static_cast<int>(c.shape.points.size()), c.angle);
        const AngleCertificate found = Certified(model, meshes::AsRemesh(model), c.target);
        ASSERT_FALSE(found.below.empty());
        EXPECT_EQ(found.Count(Reason::Unexplained), static_cast<int>(found.below.size()));
    }
}

TEST(Certificate, ListsEveryTriangleBelowTheTarget)
{
    MeshTables out;
    shapes::Shape s = shapes::CadPart();
    for (shapes::P &p : s.points)
        p[0] += 50;
    const Report r = Remeshed(s, 1000, 40, 45, out, 0);
    EXPECT_EQ(r.angles.target, 45);
    std::vector<int> below;
    double least = 180;
    for (std::size_t t = 0; t < out.face.size(); ++t) {
        double smallest = 180;
        for (int k = 0; k < 3; ++k) {
            const Point &a = out.position[out.face[t][k]];
            smallest = std::min(smallest, TurnBetween(out.position[out.face[t][(k + 1) % 3]] - a,
                                                      out.position[out.face[t][(k + 2) % 3]] - a) *
                                              180 / Pi);
        }
        least = std::min(least, smallest);
        if (smallest < 45 - 1e-6)
            below.push_back(static_cast<int>(t));
    }
    EXPECT_NEAR(r.angles.reached, least, 1e-9);
    ASSERT_EQ(r.angles.below.size(), below.size());
    int counted = 0;
    for (int k = 0; k < SmallAngleReasonCount; ++k)
        counted += r.angles.Count(static_cast<Reason>(k));
    EXPECT_EQ(counted, static_cast<int>(below.size()));
    for (std::size_t i = 0; i < below.size(); ++i) {
        const SmallAngle &a = r.angles.below[i];
        EXPECT_EQ(a.face, below[i]);
        EXPECT_LT(a.degrees, 45);
        const auto &f = out.face[a.face];
        const Point c = (out.position[f[0]] + out.position[f[1]] + out.position[f[2]]) / 3;
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(a.position[k], c[k], 1e-9);
    }
}

} // namespace
} // namespace certificate_test
