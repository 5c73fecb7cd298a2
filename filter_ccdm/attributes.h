// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_CCDM_ATTRIBUTES_H
#define FILTER_CCDM_ATTRIBUTES_H

#include <vector>

#include <QStringList>

#include "attribute_columns.h"
#include "wedge_texture.h"

namespace filter_ccdm {

/// The attributes of a layer as they were when the run began, on their way to its result. What lies on a face is
/// interpolated from the face's vertices; a vertex or a face that was not remeshed keeps all that it has, to the
/// last bit.
class AttributeCarrier
{
public:
    /// `input` is the layer's mesh as CopyFromLayer() gives it; it is referred to.
    AttributeCarrier(const MeshModel &layer, const Mesh &input, const Settings &settings);

    /// Leaves those edges of `input`, the mesh given before, selected that the remesher must keep as features beside
    /// those that it finds: the selected ones, if the settings ask for them, and the seams of the texture coordinates.
    /// Whether there are any goes into the parameters.
    void MarkFeatures(Mesh &input, vcg::ccdm::Params &params);

    /// Whether there is anything to carry: else no provenance is needed.
    bool Any() const;

    /// Completes the new content of a layer with all that is carried.
    void Carry(const vcg::ccdm::Provenance &provenance, const Mesh &result, LayerContent &content);

    /// One line each, for the log: what was carried, what was not, what is to be known about it.
    QStringList Describe() const;

private:
    const Mesh &_input;
    bool _all;       // attributes are carried
    bool _partial;   // only the selected faces are remeshed
    bool _userEdges; // the selected edges are features
    Columns _columns;
    WedgeTexture _texture;
    // Of the live elements, in order.
    std::vector<int> _vertexFlags, _faceFlags;
    std::vector<vcg::Point3d> _vertexNormals, _faceNormals;
    QStringList _notCarried, _notes;
    int _crossed = 0;

    void ReadElements(const CMeshO &layer);
    void NameTheRest(const MeshModel &layer);
    void CarryVertices(const vcg::ccdm::Provenance &provenance, LayerContent &content) const;
    void CarryFaces(const vcg::ccdm::Provenance &provenance, LayerContent &content) const;
    void RestoreKept(const vcg::ccdm::Provenance &provenance, const Mesh &result, LayerContent &content) const;
    int NearestVertex(const vcg::ccdm::SurfacePoint &at) const;
    void Value(const Column &column, const vcg::ccdm::Provenance &provenance, std::size_t vertex, double *to) const;
};

/// What goes from a layer to a new one beside the mesh: transform, camera, and the textures if it has coordinates for
/// them.
void CopySettings(const MeshModel &from, MeshModel &to);

} // namespace filter_ccdm

#endif
