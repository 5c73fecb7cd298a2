// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_RESULT_CHECK_H
#define VCG_CCDM_RESULT_CHECK_H

#include <cmath>
#include <string>

#include <vcg/complex/algorithms/ccdm/remesh.h>

namespace vcg {
namespace ccdm {

/// Proof of a result before it is handed out.
struct ResultCheck {
    TopologyCounts topology;
    int foldedEdges = 0; ///< edges whose faces turn by more than 150 degrees
    std::string fault;   ///< the first thing found wrong; empty when all is well

    ResultCheck(const Model &model, const Remesh &remesh)
    {
        const Verification v = VerifyTriangulation(remesh.mesh);
        topology = v.counts;
        fault = v.fault;
        if (!fault.empty())
            return;
        for (const Point &p : remesh.position)
            if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
                fault = "a vertex is not finite";
        (void)model;
        for (int t = 0; t < remesh.mesh.TriangleCount(); ++t)
            for (int e = 0; e < 3; ++e) {
                const Side s = MakeSide(t, e), mate = remesh.mesh.Mate(s);
                if (mate > s)
                    foldedEdges += Turn(remesh, s) > 150 * Pi / 180;
            }
    }

    static double Turn(const Remesh &r, Side s)
    {
        const Triangulation &m = r.mesh;
        return TurnAngle(r.position[m.Tail(s)], r.position[m.Head(s)], r.position[m.Opposite(s)],
                         r.position[m.Opposite(m.Mate(s))]);
    }
};

} // namespace ccdm
} // namespace vcg

#endif
