// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_CCDM_REMESH_LAYER_H
#define FILTER_CCDM_REMESH_LAYER_H

#include <vector>

#include <vcg/complex/complex.h>

#include <vcg/complex/algorithms/ccdm/provenance.h>

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
/// The plugin's own mesh: the host's mesh type is touched in the conversions only, so that no
/// algorithm is instantiated over it.
class Mesh : public vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>>
{
public:
    /// Of corner k of a face.
    int IndexOf(const Face &f, int k) const { return static_cast<int>(f.cV(k) - vert.data()); }
};

/// Copies the live elements of a layer: positions, vertex quality, selected faces and selected face edges.
void CopyFromLayer(const CMeshO &layer, Mesh &mesh);

/// Whether a layer still has the positions, the faces and the selected faces of a copy that was made of it.
bool IsAsCopied(const CMeshO &layer, const Mesh &copy);

/// Unit normals of the vertices, the faces around each weighted with their angles there; null where there is none.
std::vector<vcg::Point3d> VertexNormals(const Mesh &mesh);

/// Length of the diagonal of the bounding box of what the faces use, or the selected ones of them.
double Diagonal(const Mesh &mesh, bool selectedOnly = false);

/// Number of face edges that are selected, an edge that two faces have selected counted twice.
int SelectedEdgeCount(const Mesh &mesh);

/// Number of faces that are selected.
int SelectedFaceCount(const Mesh &mesh);

/// About how many vertices a run will spend on the faces that it remeshes; the largest integer when it is to find out.
int VertexBudget(const Mesh &input, const vcg::ccdm::Params &params);

/// Remeshes `input`; an error in the parameters and in the report is relative to the diagonal of the whole input, also
/// when only the selected faces are remeshed. `provenance` may be null. Throws Failure with the reason when there is no
/// result.
vcg::ccdm::Report RemeshCopy(const Mesh &input, Mesh &result, const vcg::ccdm::Params &params,
                             vcg::CallBackPos *progress, vcg::ccdm::Provenance *provenance);

} // namespace filter_ccdm

#endif
