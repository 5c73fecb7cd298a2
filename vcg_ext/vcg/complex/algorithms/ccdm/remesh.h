// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_REMESH_H
#define VCG_CCDM_REMESH_H

#include <cstdint>
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

} // namespace ccdm
} // namespace vcg

#endif
