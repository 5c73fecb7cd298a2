// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm_remeshing.h>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace provenance_test {
namespace {

using meshes::MeshD;
using meshes::Quick;
using vcg::ccdm::BoundaryKind;
using vcg::ccdm::Params;
using vcg::ccdm::Provenance;
using vcg::ccdm::Report;
using vcg::ccdm::Status;
using vcg::ccdm::SurfacePoint;
using Remeshing = vcg::tri::CCDMRemeshing<MeshD>;
using Point = vcg::Point3d;

Point At(const MeshD &m, const SurfacePoint &p)
{
    Point x(0, 0, 0);
    for (int k = 0; k < 3; ++k)
        x += m.face[p.face].cP(k) * p.weight[k];
    return x;
}

int IndexOf(const MeshD &m, const meshes::VertexD *v)
{
    return static_cast<int>(v - m.vert.data());
}

// Every vertex is where its provenance says, and so is every corner that a feature passes through.
void ExpectPlacesMatch(const MeshD &in, const MeshD &out, const Provenance &p)
{
    ASSERT_EQ(p.vertex.size(), out.vert.size());
    ASSERT_EQ(p.sameVertex.size(), out.vert.size());
    ASSERT_EQ(p.face.size(), out.face.size());
    for (std::size_t v = static_cast<std::size_t>(p.keptVertices); v < out.vert.size(); ++v) {
        const SurfacePoint &at = p.vertex[v];
        EXPECT_NEAR(at.weight[0] + at.weight[1] + at.weight[2], 1, 1e-9);
        EXPECT_LT((At(in, at) - out.vert[v].cP()).Norm(), 1e-9);
    }
    for (std::size_t v = 0; v < out.vert.size(); ++v)
        if (p.sameVertex[v] >= 0) {
            EXPECT_EQ(in.vert[static_cast<std::size_t>(p.sameVertex[v])].cP(), out.vert[v].cP());
        }
    for (const Provenance::SideCorner &c : p.onSides)
        EXPECT_LT((At(in, c.at) - out.face[static_cast<std::size_t>(c.face)].cP(c.corner)).Norm(), 1e-9);
}

TEST(Provenance, PlacesEveryVertexOfASmoothSurface)
{
    MeshD in, out;
    meshes::Fill(in, shapes::Bumpy(3));
    Provenance p;
    ASSERT_EQ(Remeshing::Do(in, out, Quick(400), nullptr, &p).status, Status::Done);
    ExpectPlacesMatch(in, out, p);
    EXPECT_TRUE(p.onSides.empty());
}

TEST(Provenance, SkipsDeletedElementsOfTheInput)
{
    MeshD in, out;
    meshes::Fill(in, shapes::Together(shapes::Sphere(2), shapes::Bumpy(3), 5));
    const shapes::Shape gone = shapes::Sphere(2);
    for (std::size_t f = 0; f < gone.faces.size(); ++f)
        vcg::tri::Allocator<MeshD>::DeleteFace(in, in.face[f]);
    for (std::size_t v = 0; v < gone.points.size(); ++v)
        vcg::tri::Allocator<MeshD>::DeleteVertex(in, in.vert[v]);
    Provenance p;
    ASSERT_EQ(Remeshing::Do(in, out, Quick(400), nullptr, &p).status, Status::Done);
    ExpectPlacesMatch(in, out, p);
}

// On a box each side is its own attribute domain: a face of the result and all of its corners must be looked up on
// the side that the face lies on.
TEST(Provenance, SeesCornersFromTheRightSideOfACrease)
{
    MeshD in, out;
    meshes::Fill(in, shapes::Box(1, 1.3, 1.7));
    Provenance p;
    ASSERT_EQ(Remeshing::Do(in, out, Quick(500), nullptr, &p).status, Status::Done);
    ExpectPlacesMatch(in, out, p);
    EXPECT_GT(p.onSides.size(), 100U);
    const auto normal = [](const meshes::FaceD &f) { return ((f.cP(1) - f.cP(0)) ^ (f.cP(2) - f.cP(0))).Normalize(); };
    for (std::size_t f = 0; f < out.face.size(); ++f) {
        const Point own = normal(out.face[f]);
        EXPECT_GT(own * normal(in.face[static_cast<std::size_t>(p.face[f])]), 0.99);
        for (int k = 0; k < 3; ++k) {
            const SurfacePoint at = p.Corner(static_cast<int>(f), k, IndexOf(out, out.face[f].cV(k)));
            EXPECT_GT(own * normal(in.face[static_cast<std::size_t>(at.face)]), 0.99);
            EXPECT_LT((At(in, at) - out.face[f].cP(k)).Norm(), 1e-9);
        }
    }
}

// The corners of a box come back to the last bit, whatever its place and size.
TEST(Provenance, CornersKeepTheirCoordinates)
{
    MeshD in, out;
    shapes::Shape box = shapes::Box(0.1, 0.3, 0.7);
    for (shapes::P &q : box.points)
        for (int k = 0; k < 3; ++k)
            q[k] = q[k] / 3 + 1e3 / 7;
    meshes::Fill(in, box);
    Provenance p;
    ASSERT_EQ(Remeshing::Do(in, out, Quick(300), nullptr, &p).status, Status::Done);
    std::vector<char> found(in.vert.size(), 0);
    for (std::size_t v = 0; v < out.vert.size(); ++v)
        if (p.sameVertex[v] >= 0) {
            found[static_cast<std::size_t>(p.sameVertex[v])] = 1;
            EXPECT_EQ(out.vert[v].cP(), in.vert[static_cast<std::size_t>(p.sameVertex[v])].cP());
        }
    int corners = 0;
    for (std::size_t v = 0; v < in.vert.size(); ++v)
        corners += found[v];
    EXPECT_EQ(corners, 8);
}

TEST(Boundary, FixedKeepsEveryBoundaryVertex)
{
    const shapes::Shape disc = shapes::Cut(shapes::Bumpy(3), [](const shapes::P &q) { return q[2] > 0.1; });
    MeshD in, out;
    meshes::Fill(in, disc);
    std::vector<int> edges(in.vert.size() * in.vert.size(), 0);
    const auto index = [&](int a, int b) {
        return static_cast<std::size_t>(std::min(a, b)) * in.vert.size() + std::max(a, b);
    };
    for (const auto &f : in.face)
        for (int k = 0; k < 3; ++k)
            ++edges[index(IndexOf(in, f.cV(k)), IndexOf(in, f.cV((k + 1) % 3)))];
    std::vector<char> boundary(in.vert.size(), 0);
    for (int a = 0; a < in.VN(); ++a)
        for (int b = a + 1; b < in.VN(); ++b)
            if (edges[index(a, b)] == 1)
                boundary[static_cast<std::size_t>(a)] = boundary[static_cast<std::size_t>(b)] = 1;
    Params params = Quick(900);
    params.featureAngle = 180;
    params.boundary = BoundaryKind::Fixed;
    Provenance p;
    const Report r = Remeshing::Do(in, out, params, nullptr, &p);
    ASSERT_EQ(r.status, Status::Done) << r.message;
    EXPECT_EQ(out.VN(), 900);
    for (const int same : p.sameVertex)
        if (same >= 0)
            boundary[static_cast<std::size_t>(same)] = 0;
    EXPECT_EQ(std::count(boundary.begin(), boundary.end(), char(1)), 0);
}

// The outline of a square: its four corners stay unless the boundary is to be smooth.
TEST(Boundary, SmoothRoundsCornersOff)
{
    MeshD in;
    meshes::Fill(in, shapes::FlatGrid(20));
    for (const BoundaryKind kind : {BoundaryKind::Sliding, BoundaryKind::Smooth}) {
        MeshD out;
        Params params = Quick(150);
        params.boundary = kind;
        const Report r = Remeshing::Do(in, out, params);
        ASSERT_EQ(r.status, Status::Done) << r.message;
        EXPECT_EQ(out.VN(), 150);
        EXPECT_EQ(r.featureCorners, kind == BoundaryKind::Smooth ? 0 : 4);
        double area = 0;
        for (const auto &f : out.face)
            area += ((f.cP(1) - f.cP(0)) ^ (f.cP(2) - f.cP(0))).Norm() / 2;
        double whole = 0;
        for (const auto &f : in.face)
            whole += ((f.cP(1) - f.cP(0)) ^ (f.cP(2) - f.cP(0))).Norm() / 2;
        EXPECT_NEAR(area / whole, 1, kind == BoundaryKind::Smooth ? 0.05 : 1e-9);
        EXPECT_LT(area, kind == BoundaryKind::Smooth ? 0.9999 * whole : 1.0001 * whole);
    }
}

} // namespace
} // namespace provenance_test
