// SPDX-License-Identifier: GPL-3.0-or-later
// measure_mesh MESH, or measure_mesh ORIGINAL RESULT [SAMPLES]: any program's result by the project's own metrics, as
// JSON. SAMPLES: points on each surface from which the distances are measured.
//
// Angles in degrees, shares in percent, distances relative to the diagonal of the original's bounding box.
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include <vcg/complex/algorithms/mesh_quality.h>

#include "mesh_io.h"

namespace {

using Json = nlohmann::ordered_json;
using ccdm_remesh::Mesh;
using Quality = vcg::tri::MeshQuality<Mesh>;
using vcg::tri::MeshQualityReport;

constexpr int usualSamples = 1000000;
constexpr int binWidth = 2; // degrees

void Read(const std::string &path, Mesh &mesh)
{
    const auto read = ccdm_remesh::ReadMesh(path, mesh);
    if (!read.fault.empty())
        throw std::runtime_error(path + ": " + read.fault);
}

// How many of all angles lie in each bin from 0 to 180 degrees.
Json AngleHistogram(const Mesh &mesh)
{
    std::array<int, 180 / binWidth> count = {};
    for (const auto &f : mesh.face)
        for (int k = 0; k < 3; ++k) {
            const vcg::Point3d u = f.cP1(k) - f.cP0(k), w = f.cP2(k) - f.cP0(k);
            const double angle = std::atan2((u ^ w).Norm(), u * w) * 180 / M_PI;
            ++count[std::min<std::size_t>(static_cast<std::size_t>(angle / binWidth), count.size() - 1)];
        }
    return count;
}

Json QualityJson(const Mesh &mesh)
{
    const MeshQualityReport q = Quality::Measure(mesh);
    Json j;
    j["vertices"] = q.vertices - q.unreferenced;
    j["angle_min_avg"] = q.angleMinAvg;
    j["angle_min"] = q.angleMin;
    j["pct_lt30"] = q.pctLt30;
    j["q_fb99_avg"] = q.qFb99Avg;
    j["q_fb99_min"] = q.qFb99Min;
    j["pct_valence6"] = q.pctValence6;
    j["folded_edges"] = q.foldedEdges;
    j["euler"] = q.euler;
    j["components"] = q.components;
    j["boundary_loops"] = q.boundaryLoops;
    j["orientable"] = q.orientable;
    j["manifold"] = q.manifold;
    j["area"] = q.area;
    return j;
}

Json Compare(const Mesh &original, const Mesh &result, int samples)
{
    Json before = QualityJson(original), j = QualityJson(result);
    bool kept = true;
    for (const char *key : {"euler", "components", "boundary_loops", "orientable", "manifold"})
        kept = kept && before[key] == j[key];
    j["topology_kept"] = kept;
    const auto d = Quality::Distance(original, result, samples);
    j["hausdorff"] = d.hausdorff;
    j["rms"] = d.rms;
    j["angle_histogram"] = AngleHistogram(result);
    return j;
}

} // namespace

int main(int argc, char **argv)
{
    const int samples = argc == 4 ? std::atoi(argv[3]) : usualSamples;
    if (argc < 2 || argc > 4 || samples < 1) {
        std::cerr << "usage: measure_mesh MESH | measure_mesh ORIGINAL RESULT [SAMPLES]\n";
        return 2;
    }
    try {
        Mesh first, second;
        Read(argv[1], first);
        if (argc > 2)
            Read(argv[2], second);
        std::cout << (argc > 2 ? Compare(first, second, samples) : QualityJson(first)).dump() << '\n';
    } catch (const std::exception &e) {
        std::cerr << e.what() << '\n';
        return 1;
    }
    return 0;
}
