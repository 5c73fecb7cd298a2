// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_CCDM_WEDGE_TEXTURE_H
#define FILTER_CCDM_WEDGE_TEXTURE_H

#include <array>
#include <vector>

#include "layer_content.h"

namespace filter_ccdm {

/// The texture coordinates that a layer has at the corners of its faces: a copy, and the charts that they form.
class WedgeTexture
{
public:
    WedgeTexture() = default;
    /// `input` is the layer's mesh as CopyFromLayer() gives it.
    WedgeTexture(const CMeshO &layer, const Mesh &input);

    bool Empty() const { return _wedges.empty(); }

    /// Number of edges between faces that are remeshed where the coordinates or the textures of the two differ.
    int SeamCount(const Mesh &input, bool selectedOnly) const;

    /// Number of vertices where such seams end, branch or meet: all of them must stay.
    int SeamCorners(const Mesh &input, bool selectedOnly) const;

    /// Selects the seam edges.
    void MarkSeams(Mesh &input) const;

    /// Gives the new faces their coordinates. Returns how many triangles touch two charts, where seams bend or run
    /// close together within the spacing: such a triangle continues the chart under its centroid.
    int Carry(const vcg::ccdm::Provenance &provenance, const Mesh &input, const Mesh &result,
              LayerContent &content) const;

private:
    struct Coordinates {
        double u = 0, v = 0;
        short texture = 0;
    };
    struct EdgeSide {
        int face, edge; // edge k runs from corner k to the next
    };

    std::vector<std::array<Coordinates, 3>> _wedges; // of each face
    std::vector<std::array<EdgeSide, 2>> _seam;
    std::vector<int> _chart; // of each face

    void FindCharts(const Mesh &input);
    static bool IsRemeshed(const std::array<EdgeSide, 2> &sides, const Mesh &input, bool selectedOnly);
    Coordinates At(const vcg::ccdm::SurfacePoint &p) const;
    Coordinates Continued(int face, const Mesh &input, const vcg::Point3d &p) const;
};

} // namespace filter_ccdm

#endif
