// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_EDGE_LENGTH_H
#define VCG_CCDM_EDGE_LENGTH_H

#include <cmath>
#include <vector>

#include <vcg/complex/algorithms/ccdm/density.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>

namespace vcg {
namespace ccdm {

/// Number of vertices, not rounded, with which a remesh of density `phi` has mean edge length `length`, in
/// the surface's units. `euler` is the surface's characteristic; its boundary sides are marked.
///
/// A patch of n phi_hat dA vertices has three edges a vertex, of length sqrt(2 / (sqrt(3) n phi_hat)): the
/// mean over the edges is sqrt(2 / (sqrt(3) n)) times the integral of sqrt(phi_hat). Of V vertices and b
/// boundary edges a surface has F = 2 V - 2 euler - b triangles, which have to fill the area. Measured: what
/// triangles that are not equilateral add to the length, and what the chords take from it, cancel to 1
/// percent, but for rough surfaces.
inline double VerticesForEdgeLength(const ReferenceSurface &surface, const std::vector<double> &phi, int euler,
                                    double length)
{
    std::vector<double> root(phi.size());
    for (std::size_t v = 0; v < phi.size(); ++v)
        root[v] = std::sqrt(phi[v]);
    const double total = Integral(surface, phi), mean = Integral(surface, root);
    const double inner = 2 * mean * mean / (std::sqrt(3.0) * total * length * length);
    double boundary = 0;
    const Triangulation &m = surface.mesh;
    for (int t = 0; t < m.TriangleCount(); ++t)
        for (int e = 0; e < 3; ++e) {
            const Side s = MakeSide(t, e);
            if (m.Mate(s) == NoSide)
                boundary += surface.EdgeLength(s) * (root[m.Tail(s)] + root[m.Head(s)]) / 2;
        }
    // In units of the local spacing.
    boundary *= std::sqrt(std::sqrt(3.0) * inner / (2 * total));
    return inner + euler + boundary / 2;
}

/// Mean length of the edges of a remesh.
inline double MeanEdgeLength(const Remesh &remesh)
{
    const Triangulation &m = remesh.mesh;
    double sum = 0;
    int count = 0;
    for (int t = 0; t < m.TriangleCount(); ++t)
        for (int e = 0; e < 3; ++e) {
            const Side s = MakeSide(t, e);
            if (m.Mate(s) != NoSide && m.Mate(s) < s)
                continue;
            sum += Norm(remesh.position[m.Tail(s)] - remesh.position[m.Head(s)]);
            ++count;
        }
    return count > 0 ? sum / count : 0;
}

} // namespace ccdm
} // namespace vcg

#endif
