// SPDX-License-Identifier: GPL-3.0-or-later
// A box of twelve triangles becomes one of 2000 vertices, with its twelve creases. The README shows a part of this.
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
class MyMesh : public vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>>
{
};

int main()
{
    MyMesh mesh;
    vcg::tri::Hexahedron(mesh);
    vcg::tri::CCDMRemeshing<MyMesh>::Params params;
    params.vertexCount = 2000;
    const auto report = vcg::tri::CCDMRemeshing<MyMesh>::Do(mesh, params);
    if (report.status != vcg::ccdm::Status::Done)
        std::cerr << report.message << '\n'; // the mesh is as it was
    std::cout << mesh.VN() << " vertices, " << mesh.FN() << " triangles\n";
    return report.status == vcg::ccdm::Status::Done ? 0 : 1;
}
