// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_PROVENANCE_H
#define VCG_CCDM_PROVENANCE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/input_mesh.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>

namespace vcg {
namespace ccdm {

/// Where the elements of a result lie on the input: what attributes are looked up with. Faces and vertices of the
/// input by their indices, weights in the order of the input face's vertices.
struct Provenance {
    /// The corner of a result face as it is seen from that face, where a feature passes through the vertex.
    struct SideCorner {
        int face = 0;    ///< of the result
        int corner = 0;  ///< 0 to 2
        SurfacePoint at; ///< where that side of the feature has it
    };

    std::vector<SurfacePoint>
        vertex;                      ///< one for each result vertex; face -1: a vertex that no face uses was left as is
    std::vector<int> sameVertex;     ///< the input vertex that a result vertex is, such as a corner; -1: it is new
    std::vector<int> face;           ///< for each result face the input face that lies under its centroid
    std::vector<SideCorner> onSides; ///< by face; no entry: the vertex's own point will do
    int keptVertices = 0;            ///< the first of the result were not remeshed
    int keptFaces = 0;               ///< the same; their corners are those of the input face, in its order

    /// The input's point at a corner of a result face, on that face's side of all features: where attributes have a
    /// seam along a feature, this is the side to look them up on.
    SurfacePoint Corner(int resultFace, int corner, int itsVertex) const
    {
        const auto key = std::pair(resultFace, corner);
        const auto found =
            std::lower_bound(onSides.begin(), onSides.end(), key,
                             [](const SideCorner &a, const auto &b) { return std::pair(a.face, a.corner) < b; });
        return found != onSides.end() && std::pair(found->face, found->corner) == key ? found->at : vertex[itsVertex];
    }
};

/// Finds the provenance of a finished remesh.
class ProvenanceFinder
{
public:
    ProvenanceFinder(const Model &model, const Remesh &remesh, const InputMesh &prepared, const MeshTables &input)
        : _model(model), _surface(model.surface), _remesh(remesh), _prepared(prepared), _input(input)
    {
    }

    Provenance Run(Workers &workers) const
    {
        Provenance p;
        const int vertices = _remesh.VertexCount(), triangles = _remesh.mesh.TriangleCount();
        p.vertex.resize(vertices);
        p.sameVertex.assign(vertices, -1);
        p.face.resize(triangles);
        Chunks::For(workers, vertices, [&](int first, int last, int) {
            for (int v = first; v < last; ++v) {
                p.vertex[v] = Caller(OnFace(_remesh.place[v].face, v));
                p.sameVertex[v] = SameVertex(v);
            }
        });
        using SideCorner = Provenance::SideCorner;
        p.onSides = Chunks::CollectList<SideCorner>(workers, triangles,
                                                    [&](int first, int last, std::vector<SideCorner> &found) {
                                                        for (int t = first; t < last; ++t)
                                                            p.face[t] = _prepared.originalFace[Under(t, found)];
                                                    });
        return p;
    }

    /// The caller's vertex that a corner, which never moves, is; -1 for any other vertex.
    int SameVertex(int v) const
    {
        return _remesh.place[v].kind == VertexKind::Corner ? _prepared.original[ReferenceCorner(_model, _remesh, v)]
                                                           : -1;
    }

private:
    const Model &_model;
    const ReferenceSurface &_surface;
    const Remesh &_remesh;
    const InputMesh &_prepared;
    const MeshTables &_input;

    SurfacePoint OnFace(int face, int v) const
    {
        const Foot foot = _surface.NearestOn(face, _remesh.position[v]);
        return {face, {foot.weight[0], foot.weight[1], foot.weight[2]}};
    }

    // In the caller's numbering of faces and corners.
    SurfacePoint Caller(const SurfacePoint &p) const
    {
        SurfacePoint q;
        q.face = _prepared.originalFace[p.face];
        const auto &corner = _input.face[q.face];
        for (int i = 0; i < 3; ++i) {
            const int v = _prepared.original[_surface.mesh.triangle[p.face].v[i]];
            q.weight[std::find(corner.begin(), corner.end(), v) - corner.begin()] = p.weight[i];
        }
        return q;
    }

    // The reference face under the centroid of a triangle. On the way the corners that lie on features are put on
    // the triangle's side of them.
    int Under(int t, std::vector<Provenance::SideCorner> &sides) const
    {
        const Triangle &T = _remesh.mesh.triangle[t];
        const Point centroid = (_remesh.position[T.v[0]] + _remesh.position[T.v[1]] + _remesh.position[T.v[2]]) / 3;
        double least = std::numeric_limits<double>::infinity();
        int under = -1;
        for (int k = 0; k < 3; ++k) {
            const int v = T.v[k];
            if (_remesh.place[v].kind == VertexKind::Free) {
                Look(_remesh.place[v].face, v, centroid, least, under);
                continue;
            }
            const std::vector<int> faces = ReferenceFacesAt(_model, _remesh, v);
            // From the right side the way to the centroid crosses no feature. Around the loose end of a feature
            // both sides lead there: then the side whose face is nearer at the start.
            int best = faces.front();
            std::pair<double, double> bestWay(std::numeric_limits<double>::infinity(), 0);
            for (const int face : faces) {
                const double reach = SquaredNorm(_remesh.position[v] - centroid);
                const double end = _surface.Project(face, _remesh.position[v], centroid, 0).second.squaredDistance;
                // To a thousandth of the way, so that rounding does not decide between faces of one side.
                const std::pair<double, double> way(std::floor(1e3 * std::sqrt(end / reach)),
                                                    _surface.NearestOn(face, centroid).squaredDistance);
                if (way < bestWay) {
                    bestWay = way;
                    best = face;
                }
            }
            sides.push_back({t, k, Caller(OnFace(best, v))});
            Look(best, v, centroid, least, under);
        }
        return under;
    }

    void Look(int from, int v, const Point &centroid, double &least, int &under) const
    {
        const auto [face, foot] = _surface.Project(from, _remesh.position[v], centroid, 0);
        if (foot.squaredDistance < least) {
            least = foot.squaredDistance;
            under = face;
        }
    }
};

} // namespace ccdm
} // namespace vcg

#endif
