// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_MENDED_FIGURES_H
#define VCG_CCDM_MENDED_FIGURES_H

#include <vcg/complex/algorithms/ccdm/parameters.h>
#include <vcg/complex/algorithms/mesh_quality.h>

namespace vcg {
namespace ccdm {

/// The figures of an input with the counts and the topology that it has once it is mended, which is what a result is
/// to be compared with.
inline tri::MeshQualityReport AsMended(tri::MeshQualityReport q, const Report &report)
{
    const InputDefects &d = report.defects;
    const TopologyCounts &t = report.inputTopology;
    if (d.mergedVertices + d.duplicateFaces + d.copiedVertices == 0)
        return q;
    q.vertices = t.vertices + q.unreferenced;
    q.edges = t.edges;
    q.faces = t.faces;
    q.euler = t.euler;
    q.components = t.components;
    q.boundaryLoops = t.boundaryLoops;
    q.orientable = t.orientable;
    q.manifold = true;
    q.nonManifoldEdges = q.nonManifoldVertices = 0;
    const int missing = 2 * t.components - t.euler - t.boundaryLoops;
    q.genus = t.orientable ? missing / 2.0 : missing;
    return q;
}

/// A result beside its input as mended; `parallel`: on two threads.
template <class MeshType>
tri::MeshComparison CompareMended(const MeshType &input, const MeshType &result, const Report &report, bool parallel)
{
    const bool sewn = report.defects.mergedVertices > 0;
    tri::MeshComparison c = tri::MeshQuality<MeshType>::Compare(input, result, sewn, parallel);
    c.before = AsMended(c.before, report);
    return c;
}

} // namespace ccdm
} // namespace vcg

#endif
