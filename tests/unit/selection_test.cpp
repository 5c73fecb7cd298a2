// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm_remeshing.h>

#include <array>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/mesh_quality.h>

#include "support/meshes.h"

namespace selection_test {
namespace {

using meshes::MeshD;
using vcg::ccdm::Params;
using vcg::ccdm::Provenance;
using vcg::ccdm::Report;
using vcg::ccdm::Status;
using Remeshing = vcg::tri::CCDMRemeshing<MeshD>;
using Point = vcg::Point3d;

Params OfSelection(int n)
{
    Params p = meshes::Quick(n);
    p.featureAngle = 180;
    p.selectedFacesOnly = true;
    return p;
}

void Select(MeshD &m, const std::function<bool(const Point &)> &chosen)
{
    for (auto &f : m.face)
        if (chosen((f.cP(0) + f.cP(1) + f.cP(2)) / 3))
            f.SetS();
}

using Corners = std::array<Point, 3>;
Corners CornersOf(const meshes::FaceD &f)
{
    return {f.cP(0), f.cP(1), f.cP(2)};
}

// What was not selected is there still, to the last bit, in its order, and nothing is where the parts meet but edges of
// two faces.
void ExpectRestUntouched(const MeshD &in, const MeshD &out, const Provenance &p)
{
    std::vector<Corners> rest;
    for (const auto &f : in.face)
        if (!f.IsS())
            rest.push_back(CornersOf(f));
    ASSERT_EQ(p.keptFaces, static_cast<int>(rest.size()));
    for (std::size_t t = 0; t < rest.size(); ++t) {
        EXPECT_EQ(CornersOf(out.face[t]), rest[t]);
        EXPECT_EQ(CornersOf(in.face[static_cast<std::size_t>(p.face[t])]), rest[t]);
    }
    for (int v = 0; v < p.keptVertices; ++v)
        EXPECT_EQ(out.vert[v].cP(), in.vert[static_cast<std::size_t>(p.sameVertex[v])].cP());
    const auto before = vcg::tri::MeshQuality<MeshD>::Measure(in), after = vcg::tri::MeshQuality<MeshD>::Measure(out);
    EXPECT_TRUE(after.manifold);
    EXPECT_EQ(after.euler, before.euler);
    EXPECT_EQ(after.boundaryLoops, before.boundaryLoops);
    EXPECT_EQ(after.components, before.components);
}

Report RunOn(const MeshD &in, MeshD &out, const Params &params, Provenance &p)
{
    return Remeshing::Do(in, out, params, nullptr, &p);
}

TEST(Selection, RemeshesTheSelectedHalfOnly)
{
    MeshD in, out;
    meshes::Fill(in, shapes::Bumpy(3));
    Select(in, [](const Point &c) { return c[2] > 0.1; });
    Provenance p;
    const Report r = RunOn(in, out, OfSelection(in.VN() + 100), p);
    ASSERT_EQ(r.status, Status::Done) << r.message;
    EXPECT_EQ(out.VN(), in.VN() + 100);
    EXPECT_EQ(r.reached, out.VN());
    EXPECT_EQ(r.extraVertices, 0);
    EXPECT_EQ(r.keptVertices, p.keptVertices);
    ExpectRestUntouched(in, out, p);
}

// Bits of the surface all over, many of them touching in single vertices.
TEST(Selection, PatchesThatTouchInVertices)
{
    MeshD in, out;
    meshes::Fill(in, shapes::Sphere(3));
    Select(in, [](const Point &c) {
        const double s = std::sin(9 * c[0]) * std::sin(9 * c[1]) * std::sin(9 * c[2]);
        return s > 0;
    });
    Provenance p;
    const Report r = RunOn(in, out, OfSelection(in.VN() + 300), p);
    ASSERT_EQ(r.status, Status::Done) << r.message;
    EXPECT_EQ(out.VN(), in.VN() + 300 + r.extraVertices);
    ExpectRestUntouched(in, out, p);
}

// Two selected squares of a checkerboard share a vertex only.
TEST(Selection, CheckerboardOfAGrid)
{
    MeshD in, out;
    meshes::Fill(in, shapes::FlatGrid(24));
    vcg::Box3d box;
    for (const auto &v : in.vert)
        box.Add(v.cP());
    Select(in, [&](const Point &c) {
        const double x = (c[0] - box.min[0]) / box.DimX(), y = (c[1] - box.min[1]) / box.DimY();
        return (static_cast<int>(3 * x) + static_cast<int>(3 * y)) % 2 == 0;
    });
    Provenance p;
    const Report r = RunOn(in, out, OfSelection(in.VN()), p);
    ASSERT_EQ(r.status, Status::Done) << r.message;
    EXPECT_EQ(out.VN(), in.VN());
    ExpectRestUntouched(in, out, p);
}

TEST(Selection, AllFacesAreAnOrdinaryRun)
{
    MeshD in, out, ordinary;
    meshes::Fill(in, shapes::Bumpy(2));
    Select(in, [](const Point &) { return true; });
    Provenance p;
    ASSERT_EQ(RunOn(in, out, OfSelection(200), p).status, Status::Done);
    Params params = OfSelection(200);
    params.selectedFacesOnly = false;
    ASSERT_EQ(Remeshing::Do(in, ordinary, params).status, Status::Done);
    ASSERT_EQ(out.VN(), ordinary.VN());
    for (int v = 0; v < out.VN(); ++v)
        EXPECT_EQ(out.vert[v].cP(), ordinary.vert[v].cP());
    EXPECT_EQ(p.keptFaces, 0);
}

TEST(Selection, RefusesWhatCannotBeDone)
{
    MeshD in, out;
    meshes::Fill(in, shapes::Bumpy(2));
    Provenance p;
    EXPECT_EQ(RunOn(in, out, OfSelection(200), p).message, "no face is selected");
    Select(in, [](const Point &c) { return c[2] > 0.5; });
    const Report few = RunOn(in, out, OfSelection(20), p);
    EXPECT_EQ(few.status, Status::InvalidParameter);
    EXPECT_NE(few.message.find("the vertex count must be at least"), std::string::npos);
    EXPECT_EQ(out.VN(), 0);
}

// Three faces at an edge, two of them selected: joining the result to the third is not possible.
TEST(Selection, RefusesACrowdedEdge)
{
    MeshD in, out;
    shapes::Shape s;
    s.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 0, 1}};
    s.faces = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    meshes::Fill(in, s);
    in.face[0].SetS();
    in.face[1].SetS();
    Provenance p;
    const Report r = RunOn(in, out, OfSelection(20), p);
    EXPECT_EQ(r.status, Status::InvalidInput);
    EXPECT_EQ(r.message, "1 edge of the selection has more than two faces");
}

// The rest may be anything: here it is not even manifold.
TEST(Selection, LeavesABrokenRestAlone)
{
    MeshD in, out;
    shapes::Shape s = shapes::Bumpy(3);
    const int apex = static_cast<int>(s.points.size());
    s.points.push_back({0, 0, -3});
    int fins = 0;
    for (std::size_t t = 0; t < s.faces.size() && fins < 3; ++t)
        if (s.points[s.faces[t][0]][2] < -0.5 && s.points[s.faces[t][1]][2] < -0.5) {
            s.faces.push_back({s.faces[t][0], s.faces[t][1], apex});
            ++fins;
        }
    meshes::Fill(in, s);
    Select(in, [](const Point &c) { return c[2] > 0.3; });
    Provenance p;
    const Report r = RunOn(in, out, OfSelection(in.VN() + 50), p);
    ASSERT_EQ(r.status, Status::Done) << r.message;
    EXPECT_EQ(out.VN(), in.VN() + 50);
    EXPECT_EQ(p.keptFaces + r.resultTopology.faces, out.FN());
}

} // namespace
} // namespace selection_test
