// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_REMESH_MESH_TYPE_H
#define CCDM_REMESH_MESH_TYPE_H

#include <vector>

#include <vcg/complex/complex.h>

namespace ccdm_remesh {

class Vertex;
class Face;

struct UsedTypes : vcg::UsedTypes<vcg::Use<Vertex>::AsVertexType, vcg::Use<Face>::AsFaceType> {
};

class Vertex : public vcg::Vertex<UsedTypes, vcg::vertex::Coord3d, vcg::vertex::Normal3d, vcg::vertex::Qualityf,
                                  vcg::vertex::Mark, vcg::vertex::BitFlags>
{
};
class Face
    : public vcg::Face<UsedTypes, vcg::face::VertexRef, vcg::face::Normal3d, vcg::face::FFAdj, vcg::face::BitFlags>
{
};
/// The mesh of the command line: double precision, vertex quality as the caller's density.
class Mesh : public vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>>
{
};

} // namespace ccdm_remesh

#endif
