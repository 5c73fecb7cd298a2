// SPDX-License-Identifier: GPL-3.0-or-later
// cgal_remesh INPUT.ply OUTPUT.ply LENGTH ITERATIONS ANGLE: CGAL's isotropic remeshing to an edge length.
//
// Edges whose faces turn by more than ANGLE degrees, and boundaries, are constrained: they may be split and
// collapsed, but stay where they are.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Surface_mesh.h>

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Edge = Mesh::Edge_index;

// CGAL's meshes are oriented; a soup that cannot be oriented without cutting it is refused.
Mesh Read(const std::string &path)
{
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> faces;
    if (!CGAL::IO::read_PLY(path, points, faces))
        throw std::runtime_error("the input cannot be read");
    PMP::remove_isolated_points_in_polygon_soup(points, faces);
    if (!PMP::orient_polygon_soup(points, faces))
        throw std::runtime_error("the input is not an orientable manifold");
    Mesh mesh;
    PMP::polygon_soup_to_polygon_mesh(points, faces, mesh);
    return mesh;
}

void Remesh(Mesh &mesh, double length, unsigned iterations, double angle)
{
    auto sharp = mesh.add_property_map<Edge, bool>("e:sharp", false).first;
    PMP::detect_sharp_edges(mesh, angle, sharp);
    for (const Edge e : mesh.edges())
        sharp[e] = sharp[e] || mesh.is_border(e);
    PMP::isotropic_remeshing(
        mesh.faces(), length, mesh,
        PMP::parameters::number_of_iterations(iterations).edge_is_constrained_map(sharp).protect_constraints(false));
    mesh.remove_property_map(sharp);
    mesh.collect_garbage();
}

} // namespace

int main(int argc, char **argv)
{
    if (argc != 6) {
        std::cerr << "usage: cgal_remesh INPUT.ply OUTPUT.ply LENGTH ITERATIONS ANGLE\n";
        return 2;
    }
    try {
        Mesh mesh = Read(argv[1]);
        Remesh(mesh, std::atof(argv[3]), static_cast<unsigned>(std::atoi(argv[4])), std::atof(argv[5]));
        std::ofstream out(argv[2], std::ios::binary);
        CGAL::IO::set_binary_mode(out);
        if (!CGAL::IO::write_PLY(out, mesh))
            throw std::runtime_error("the output cannot be written");
    } catch (const std::exception &e) {
        std::cerr << e.what() << '\n';
        return 1;
    }
    return 0;
}
