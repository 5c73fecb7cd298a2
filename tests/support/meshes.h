// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_TESTS_SUPPORT_MESHES_H
#define CCDM_TESTS_SUPPORT_MESHES_H

#include <algorithm>
#include <iterator>
#include <vector>

#include <vcg/complex/complex.h>

#include <vcg/complex/algorithms/ccdm/input_mesh.h>
#include <vcg/complex/algorithms/ccdm/parallel.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>

#include "support/shapes.h"

/// Mesh types for the tests, and ways to fill them.
namespace meshes {

class VertexD;
class FaceD;
struct UsedD : vcg::UsedTypes<vcg::Use<VertexD>::AsVertexType, vcg::Use<FaceD>::AsFaceType> {
};
class VertexD : public vcg::Vertex<UsedD, vcg::vertex::Coord3d, vcg::vertex::Qualityd, vcg::vertex::BitFlags>
{
};
class FaceD : public vcg::Face<UsedD, vcg::face::VertexRef, vcg::face::BitFlags>
{
};
class MeshD : public vcg::tri::TriMesh<std::vector<VertexD>, std::vector<FaceD>>
{
};

class VertexF;
class FaceF;
struct UsedF : vcg::UsedTypes<vcg::Use<VertexF>::AsVertexType, vcg::Use<FaceF>::AsFaceType> {
};
class VertexF : public vcg::Vertex<UsedF, vcg::vertex::InfoOcf, vcg::vertex::Coord3f, vcg::vertex::Normal3f,
                                   vcg::vertex::QualityfOcf, vcg::vertex::BitFlags>
{
};
class FaceF : public vcg::Face<UsedF, vcg::face::InfoOcf, vcg::face::VertexRef, vcg::face::Normal3f,
                               vcg::face::FFAdjOcf, vcg::face::BitFlags>
{
};
/// Single precision with optional components, as MeshLab's own mesh.
class MeshF : public vcg::tri::TriMesh<vcg::vertex::vector_ocf<VertexF>, vcg::face::vector_ocf<FaceF>>
{
};

template <class MeshType>
void Fill(MeshType &m, const shapes::Shape &s)
{
    m.Clear();
    auto v = vcg::tri::Allocator<MeshType>::AddVertices(m, s.points.size());
    for (const shapes::P &p : s.points) {
        for (int k = 0; k < 3; ++k)
            v->P()[k] = static_cast<typename MeshType::ScalarType>(p[k]);
        ++v;
    }
    auto f = vcg::tri::Allocator<MeshType>::AddFaces(m, s.faces.size());
    for (const shapes::F &face : s.faces) {
        for (int k = 0; k < 3; ++k)
            f->V(k) = &m.vert[face[k]];
        ++f;
    }
}

inline vcg::ccdm::MeshTables Tables(const shapes::Shape &s)
{
    vcg::ccdm::MeshTables t;
    for (const shapes::P &p : s.points)
        t.position.push_back(vcg::ccdm::Point(p[0], p[1], p[2]));
    for (const shapes::F &f : s.faces)
        t.face.push_back({f[0], f[1], f[2]});
    return t;
}

inline shapes::Shape ToShape(const vcg::ccdm::MeshTables &t)
{
    shapes::Shape s;
    for (const vcg::ccdm::Point &p : t.position)
        s.points.push_back({p[0], p[1], p[2]});
    for (const auto &f : t.face)
        s.faces.push_back({f[0], f[1], f[2]});
    return s;
}

/// Parameters of a short run.
inline vcg::ccdm::Params Quick(int vertices)
{
    vcg::ccdm::Params p;
    p.vertexCount = vertices;
    p.globalIterations = 5;
    return p;
}

/// A shape as a reference surface with uniform density for n vertices and features by angle.
inline vcg::ccdm::Model MakeModel(const shapes::Shape &s, int n, double featureAngle)
{
    vcg::ccdm::Model model;
    const vcg::ccdm::MeshTables t = Tables(s);
    model.surface = vcg::ccdm::ReferenceSurface(t.position, t.face);
    vcg::ccdm::MarkFeatures(model.surface, featureAngle, {});
    model.density =
        vcg::ccdm::MakeDensityField(model.surface, std::vector<double>(t.position.size(), 1.0), true, 0.2, n);
    model.features =
        vcg::ccdm::FeatureTracer(model.surface, model.density.spacing, {}, vcg::ccdm::CornerRules{50}).Trace();
    return model;
}

/// One thread, for parts that are tested by themselves.
inline vcg::ccdm::Workers &Alone()
{
    static vcg::ccdm::Workers workers(1);
    return workers;
}

/// The model's own triangulation as a remesh, every vertex off the features free.
inline vcg::ccdm::Remesh AsRemesh(const vcg::ccdm::Model &model)
{
    vcg::ccdm::Remesh r;
    r.mesh = model.surface.mesh;
    r.position = model.surface.position;
    r.rho = model.density.rho;
    r.place.resize(r.position.size());
    for (std::size_t v = 0; v < r.place.size(); ++v)
        r.place[v].face = r.mesh.incident[v];
    for (std::size_t c = 0; c < model.features.curve.size(); ++c) {
        const vcg::ccdm::FeatureCurve &curve = model.features.curve[c];
        for (int k = 0; k < curve.Segments(); ++k) {
            vcg::ccdm::Place &p = r.place[curve.vertex[k]];
            p.kind = vcg::ccdm::VertexKind::Curve;
            p.curve = static_cast<int>(c);
            p.segment = k;
            p.s = curve.arc[k];
            p.face = vcg::ccdm::SideTriangle(curve.side[k]);
        }
    }
    for (const int v : model.features.corner)
        r.place[v].kind = vcg::ccdm::VertexKind::Corner;
    return r;
}

/// Whether two remeshes name the same vertices in the same triangles, which have the same neighbours and features.
inline bool SameTriangles(const vcg::ccdm::Remesh &a, const vcg::ccdm::Remesh &b)
{
    return std::equal(a.mesh.triangle.begin(), a.mesh.triangle.end(), b.mesh.triangle.begin(), b.mesh.triangle.end(),
                      [](const vcg::ccdm::Triangle &s, const vcg::ccdm::Triangle &t) {
                          return std::equal(std::begin(s.v), std::end(s.v), std::begin(t.v)) &&
                                 std::equal(std::begin(s.n), std::end(s.n), std::begin(t.n)) &&
                                 s.constrained == t.constrained;
                      });
}

} // namespace meshes

#endif
