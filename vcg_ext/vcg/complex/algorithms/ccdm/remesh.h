// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_REMESH_H
#define VCG_CCDM_REMESH_H

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include <vcg/complex/algorithms/ccdm/density.h>
#include <vcg/complex/algorithms/ccdm/feature_graph.h>
#include <vcg/complex/algorithms/ccdm/reference_surface.h>

namespace vcg {
namespace ccdm {

/// What a vertex of the remesh may do.
enum class VertexKind : std::uint8_t {
    Free,  ///< moves over the surface
    Curve, ///< slides along its feature curve
    Corner ///< stays
};

/// Where a vertex of the remesh lies on the reference surface.
struct Place {
    int face = -1;   ///< reference face that holds it
    int curve = -1;  ///< feature curve, for VertexKind::Curve
    double s = 0;    ///< arc length along that curve
    int segment = 0; ///< segment of that curve that holds s
    VertexKind kind = VertexKind::Free;
};

/// The evolving mesh: its vertices lie on the reference surface at all times.
struct Remesh {
    Triangulation mesh;
    std::vector<Point> position;
    std::vector<Place> place;
    std::vector<double> rho; ///< energy weight at each vertex

    int VertexCount() const { return static_cast<int>(position.size()); }
};

/// Everything about the input that the remesher consults, none of which changes any more.
struct Model {
    ReferenceSurface surface;
    FeatureGraph features;
    DensityField density;
};

/// Reference vertex of a vertex that is a corner.
inline int ReferenceCorner(const Model &model, const Remesh &remesh, int v)
{
    const auto &r = model.surface.mesh.triangle[remesh.place[v].face].v;
    const auto squared = [&](int a) { return SquaredNorm(model.surface.position[a] - remesh.position[v]); };
    return *std::min_element(std::begin(r), std::end(r), [&](int a, int b) { return squared(a) < squared(b); });
}

/// Reference faces at a vertex, on every side of the features that it lies on.
inline std::vector<int> ReferenceFacesAt(const Model &model, const Remesh &remesh, int v)
{
    const Place &place = remesh.place[v];
    const Triangulation &m = model.surface.mesh;
    std::vector<int> faces;
    if (place.kind == VertexKind::Curve) {
        const FeatureCurve &c = model.features.curve[place.curve];
        const Side s = c.side[c.SegmentAt(place.s, place.segment)];
        faces.push_back(SideTriangle(s));
        if (m.Mate(s) != NoSide)
            faces.push_back(SideTriangle(m.Mate(s)));
    } else if (place.kind == VertexKind::Corner) {
        Star star;
        m.GatherStar(ReferenceCorner(model, remesh, v), star);
        for (const Side s : star.corner)
            faces.push_back(SideTriangle(s));
    } else {
        faces.push_back(place.face);
    }
    return faces;
}

/// Squared distance from the surface of a point near vertex v, along the sheet that v lies on; `slack` as
/// for ReferenceSurface::Project.
inline double SquaredDistanceNear(const Model &model, const Remesh &remesh, int v, const Point &p, double slack = 0)
{
    return model.surface.Project(remesh.place[v].face, remesh.position[v], p, slack).second.squaredDistance;
}

/// Largest squared distance from the surface of a star's triangles, as seen at their centroids and at
/// the middles of their sides.
inline double StarSquaredDistance(const Model &model, const Remesh &remesh, int v, const Star &star)
{
    double worst = 0;
    const Point &x = remesh.position[v];
    for (int k = 0; k < star.Triangles(); ++k) {
        const Point &a = remesh.position[star.outer[k]], &b = remesh.position[star.OuterAfter(k)];
        const int from = remesh.place[v].kind == VertexKind::Free ? v : star.outer[k];
        for (const Point &p : {Point((x + a + b) / 3), Point((x + a) / 2), Point((a + b) / 2)})
            worst = std::max(worst, SquaredDistanceNear(model, remesh, from, p));
    }
    return worst;
}

} // namespace ccdm
} // namespace vcg

#endif
