// SPDX-License-Identifier: GPL-3.0-or-later
// measure_density INPUT RESULT DENSITY ANGLE GRADATION: the density phi that was wanted at the vertices of a result.
//
// DENSITY is curvature or quality, ANGLE the feature angle in degrees, GRADATION the growth of the spacing that the
// remesher allows (0: any). One line for each vertex of RESULT: phi before and after that limit, interpolated in the
// nearest triangle of INPUT, both by the remesher's own functions.
#include <algorithm>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <vcg/complex/algorithms/ccdm/density.h>
#include <vcg/complex/algorithms/ccdm/input_mesh.h>
#include <vcg/complex/algorithms/closest.h>
#include <vcg/space/index/grid_static_ptr.h>

#include "read_tables.h"

namespace {

using ccdm_remesh::Face;
using ccdm_remesh::Mesh;
using vcg::ccdm::InputMesh;
using vcg::ccdm::MeshTables;
using vcg::ccdm::Point;
using vcg::ccdm::ReferenceSurface;

// Finds the face of the surface that is nearest to a point.
class NearestFace
{
public:
    explicit NearestFace(const MeshTables &tables)
    {
        auto v = vcg::tri::Allocator<Mesh>::AddVertices(_mesh, tables.position.size());
        for (const Point &p : tables.position)
            (v++)->P() = p;
        auto f = vcg::tri::Allocator<Mesh>::AddFaces(_mesh, tables.face.size());
        for (const auto &corner : tables.face) {
            for (int k = 0; k < 3; ++k)
                f->V(k) = &_mesh.vert[corner[k]];
            ++f;
        }
        vcg::tri::UpdateBounding<Mesh>::Box(_mesh);
        _grid.Set(_mesh.face.begin(), _mesh.face.end());
    }

    int operator()(const Point &p)
    {
        vcg::face::PointDistanceBaseFunctor<double> distance;
        vcg::tri::EmptyTMark<Mesh> unmarked;
        double least = 0;
        Point foot;
        const Face *face = _grid.GetClosest(distance, unmarked, p, std::numeric_limits<double>::max(), least, foot);
        if (face == nullptr)
            throw std::runtime_error("a vertex of the result has no nearest face");
        return static_cast<int>(face - _mesh.face.data());
    }

private:
    Mesh _mesh;
    vcg::GridStaticPtr<Face, double> _grid;
};

double At(const ReferenceSurface &surface, int face, const Point &p, const std::vector<double> &field)
{
    const vcg::ccdm::Foot foot = surface.NearestOn(face, p);
    return surface.Interpolate({face, {foot.weight[0], foot.weight[1], foot.weight[2]}}, field);
}

void Print(const std::string &inputPath, const std::string &resultPath, bool quality, double angle, double gradation)
{
    const MeshTables given = ReadTables(inputPath, quality), result = ReadTables(resultPath, false);
    const InputMesh input(given);
    if (!input.refusal.empty())
        throw std::runtime_error(inputPath + ": " + input.refusal);
    ReferenceSurface surface(input.mesh.position, input.mesh.face);
    vcg::ccdm::MarkFeatures(surface, angle, {});
    const std::vector<double> raw = quality ? input.mesh.field : vcg::ccdm::CurvatureDensity(surface);
    std::vector<double> limited = raw;
    if (gradation > 0)
        vcg::ccdm::LimitGradation(surface, static_cast<int>(result.position.size()), gradation, limited);
    NearestFace nearest(input.mesh);
    const Point centre = input.Restore(Point(0, 0, 0));
    std::cout << std::setprecision(9);
    for (const Point &p : result.position) {
        const Point unit = (p - centre) / input.Scale();
        const int face = nearest(unit);
        std::cout << At(surface, face, unit, raw) << ' ' << At(surface, face, unit, limited) << '\n';
    }
}

} // namespace

int main(int argc, char **argv)
{
    const std::string kind = argc == 6 ? argv[3] : "";
    if (kind != "curvature" && kind != "quality") {
        std::cerr << "usage: measure_density INPUT RESULT curvature|quality ANGLE GRADATION\n";
        return 2;
    }
    try {
        Print(argv[1], argv[2], kind == "quality", std::atof(argv[4]), std::atof(argv[5]));
    } catch (const std::exception &e) {
        std::cerr << e.what() << '\n';
        return 1;
    }
    return 0;
}
