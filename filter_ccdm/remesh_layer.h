// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_CCDM_REMESH_LAYER_H
#define FILTER_CCDM_REMESH_LAYER_H

#include <vector>

#include <vcg/complex/complex.h>

#include "parameters.h"

namespace filter_ccdm {

class Vertex;
class Face;
struct UsedTypes : vcg::UsedTypes<vcg::Use<Vertex>::AsVertexType, vcg::Use<Face>::AsFaceType> {
};
class Vertex : public vcg::Vertex<UsedTypes, vcg::vertex::Coord3d, vcg::vertex::Qualityd, vcg::vertex::BitFlags>
{
};
class Face : public vcg::Face<UsedTypes, vcg::face::VertexRef, vcg::face::BitFlags>
{
};
/// The plugin's own mesh: the host's mesh type is touched in the two conversions only, so that no
/// algorithm is instantiated over it.
class Mesh : public vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>>
{
};

/// Copies the live elements of a layer: positions, vertex quality, face-edge selection.
void CopyFromLayer(const CMeshO &layer, Mesh &mesh);

/// Replaces the content of a layer by a mesh and brings its box and normals up to date.
void CopyToLayer(const Mesh &mesh, MeshModel &layer);

/// Length of the diagonal of the bounding box of what the faces use.
double Diagonal(const Mesh &mesh);

/// Number of face edges that are selected, an edge that two faces have selected counted twice.
int SelectedEdgeCount(const Mesh &mesh);

/// Remeshes `input`. Throws Failure with the reason when there is no result.
vcg::ccdm::Report RemeshCopy(const Mesh &input, Mesh &result, const vcg::ccdm::Params &params,
                             vcg::CallBackPos *progress);

} // namespace filter_ccdm

#endif
