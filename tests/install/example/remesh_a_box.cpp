// SPDX-License-Identifier: GPL-3.0-or-later
// remesh_a_box [INPUT.ply OUTPUT.ply]: a mesh, or else a box of twelve triangles, becomes one of 2000 vertices, with
// its creases. The README shows a part of this.
#include <iostream>

#include <vcg/complex/algorithms/ccdm_remeshing.h>
#include <vcg/complex/algorithms/create/platonic.h>
#include <wrap/io_trimesh/export_ply.h>
#include <wrap/io_trimesh/import_ply.h>

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

int main(int argc, char **argv)
{
    MyMesh mesh;
    if (argc != 3)
        vcg::tri::Hexahedron(mesh);
    else if (vcg::tri::io::ImporterPLY<MyMesh>::Open(mesh, argv[1]) != 0)
        return 1;
    vcg::tri::CCDMRemeshing<MyMesh>::Params params;
    params.vertexCount = 2000;
    const auto report = vcg::tri::CCDMRemeshing<MyMesh>::Do(mesh, params);
    if (report.status != vcg::ccdm::Status::Done)
        std::cerr << report.message << '\n'; // the mesh is as it was
    std::cout << mesh.VN() << " vertices, " << mesh.FN() << " triangles\n";
    if (argc == 3 && vcg::tri::io::ExporterPLY<MyMesh>::Save(mesh, argv[2]) != 0)
        return 1;
    return report.status == vcg::ccdm::Status::Done ? 0 : 1;
}
