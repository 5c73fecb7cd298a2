// SPDX-License-Identifier: GPL-3.0-or-later
// A box of twelve triangles becomes one of a hundred vertices, with its twelve creases.
#include <iostream>

#include <vcg/complex/algorithms/ccdm_remeshing.h>
#include <vcg/complex/algorithms/create/platonic.h>

class Vertex;
class Face;
struct Types : vcg::UsedTypes<vcg::Use<Vertex>::AsVertexType, vcg::Use<Face>::AsFaceType> {
};
class Vertex : public vcg::Vertex<Types, vcg::vertex::Coord3d, vcg::vertex::Normal3d, vcg::vertex::BitFlags>
{
};
class Face : public vcg::Face<Types, vcg::face::VertexRef, vcg::face::FFAdj, vcg::face::Normal3d, vcg::face::BitFlags>
{
};
class Mesh : public vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>>
{
};

int main()
{
    Mesh mesh;
    vcg::tri::Hexahedron(mesh);
    vcg::tri::CCDMRemeshing<Mesh>::Params params;
    params.vertexCount = 100;
    const auto report = vcg::tri::CCDMRemeshing<Mesh>::Do(mesh, params);
    std::cout << mesh.VN() << " vertices, " << mesh.FN() << " triangles\n";
    if (report.status == vcg::ccdm::Status::Done)
        return 0;
    std::cerr << report.message << '\n';
    return 1;
}
