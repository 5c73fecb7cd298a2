// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes to a small mesh and parameters, remeshed: a proven mesh comes out, or a refusal that says why and leaves the
// output alone.
#include <cmath>
#include <vector>

#include <vcg/complex/algorithms/ccdm/selection.h>

#include "fuzz/bytes.h"
#include "fuzz/mesh_from_bytes.h"
#include "fuzz/targets.h"
#include "fuzz/topology.h"

namespace fuzz {
namespace {

using namespace vcg::ccdm;

Params ParamsFromBytes(Bytes &in)
{
    Params p;
    p.threads = 1;
    const int target = in.Below(64);
    if (target == 0)
        p.edgeLength = in.Between(1, 10);
    else // A largest error takes runs of thousands of vertices: the unit tests have it.
        p.vertexCount = in.Between(4, target < 12 ? 200 : 40);
    constexpr double angles[] = {40, 180, 5, 60, 90};
    p.featureAngle = angles[in.Below(5)];
    p.globalIterations = in.Below(3);
    p.localIterations = in.Between(1, 2);
    p.optimizer = in.Below(4) == 0 ? OptimizerKind::Annealing : OptimizerKind::Accelerated;
    p.sampler = in.Below(4) == 0 ? SamplerKind::Random : SamplerKind::Front;
    p.relocation = static_cast<RelocationKind>(in.Below(3));
    p.density = static_cast<DensityKind>(in.Below(3));
    p.boundary = static_cast<BoundaryKind>(in.Below(3));
    p.repair = static_cast<RepairKind>(in.Below(2));
    constexpr double weights[] = {0.25, 0, 0.5, 1};
    p.approximation = weights[in.Below(4)];
    p.lambda = in.Below(5) * 0.25;
    p.minAngle = in.Below(4) * 15;
    p.useMarkedEdges = in.Flag();
    p.selectedFacesOnly = in.Below(8) == 0;
    p.seed = static_cast<std::uint32_t>(in.Next());
    return p;
}

int Unused(const MeshTables &mesh)
{
    const auto size = static_cast<int>(mesh.position.size());
    return size - CountTopology(mesh.face, size).vertices;
}

void CheckResult(const Report &report, const Params &params, const MeshTables &input, const MeshTables &result)
{
    const auto t = CountTopology(result.face, static_cast<int>(result.position.size()));
    // What is not selected stays, unused vertices too.
    Expect(Unused(result) <= (params.selectedFacesOnly ? Unused(input) : 0), "a vertex of the result is in no face");
    for (const Point &p : result.position)
        Expect(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]), "a coordinate is not finite");
    if (params.vertexCount != 0)
        Expect(static_cast<int>(result.position.size()) == params.vertexCount + report.extraVertices &&
                   report.extraVertices >= 0,
               "the vertex count is not the one reported");
    if (params.selectedFacesOnly)
        return; // the rest of the mesh may be no surface
    Expect(t.fault.empty(), t.fault);
    const TopologyCounts &a = report.inputTopology, &b = report.resultTopology;
    Expect(report.topologyPreserved && a.SameTypeAs(b), "the topology is reported as changed");
    Expect(t.euler == a.euler && t.components == a.components && t.boundaryLoops == a.boundaryLoops &&
               t.orientable == a.orientable,
           "the topology is not the input's");
    Expect(t.faces == b.faces && t.edges == b.edges, "the counts are not those reported");
}

} // namespace

void RunRemesher(const std::uint8_t *data, std::size_t size)
{
    Bytes in(data, size);
    const Params params = ParamsFromBytes(in);
    MeshTables input = MeshFromBytes(in);
    if (params.density == DensityKind::Quality)
        for (std::size_t v = 0; v < input.position.size(); ++v)
            input.field.push_back(in.Empty() ? 1 : in.Below(4) - (in.Next() == 255));
    std::vector<char> chosen;
    for (std::size_t t = 0; t < input.face.size(); ++t) {
        input.marked.push_back(static_cast<std::uint8_t>(in.Below(8)));
        chosen.push_back(static_cast<char>(in.Empty() || in.Below(4) != 0));
    }
    MeshTables output;
    output.position.push_back(Point(1, 2, 3));
    const Report report = params.selectedFacesOnly ? SelectionRemesher(params, nullptr).Run(input, chosen, output)
                                                   : TargetSearch(params, nullptr).Run(input, output);
    if (report.status == Status::Done) {
        CheckResult(report, params, input, output);
    } else {
        Expect(!report.message.empty(), "a refusal without a reason");
        Expect(report.status != Status::Cancelled, "cancelled by nobody");
        Expect(output.position.size() == 1 && output.face.empty(), "a refusal that changed the output");
    }
}

} // namespace fuzz
