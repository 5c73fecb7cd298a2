// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_RESULT_CHECK_H
#define VCG_CCDM_RESULT_CHECK_H

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <vcg/complex/algorithms/ccdm/patch_schedule.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>
#include <vcg/complex/algorithms/ccdm/verification.h>

namespace vcg {
namespace ccdm {

/// Proof of a result before it is handed out.
struct ResultCheck {
    TopologyCounts topology;
    int foldedEdges = 0; ///< edges whose faces turn by more than 150 degrees
    std::string fault;   ///< the first thing found wrong; empty when all is well

    ResultCheck(const Model &model, const Remesh &remesh) : ResultCheck(model, remesh, *std::make_unique<Workers>(1)) {}
    ResultCheck(const Model &model, const Remesh &remesh, Workers &workers)
    {
        const Verification v(remesh.mesh, workers);
        topology = v.counts;
        fault = v.fault;
        if (!fault.empty())
            return;
        for (const Point &p : remesh.position)
            if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
                fault = "a vertex is not finite";
        CheckFolds(model, remesh, workers);
    }

private:
    // A fold is right only where the input itself turns that sharply within two lengths of the edges
    // around it: at a knife edge, or on a part that is thinner than the spacing.
    void CheckFolds(const Model &model, const Remesh &remesh, Workers &workers)
    {
        struct Fold {
            Point middle;
            double reach;
        };
        std::vector<Fold> folds;
        const Triangulation &m = remesh.mesh;
        for (const Side s : FoldedEdges(remesh, workers)) {
            ++foldedEdges;
            const Point &p = remesh.position[m.Tail(s)], &q = remesh.position[m.Head(s)];
            if (!m.Constrained(s))
                folds.push_back({(p + q) / 2, 2 * std::max({Norm(q - p), Norm(remesh.position[m.Opposite(s)] - p),
                                                            Norm(remesh.position[m.Opposite(m.Mate(s))] - p)})});
        }
        int unfounded = 0;
        for (const Fold &f : folds)
            unfounded += !BendsNear(model, f.middle, f.reach);
        if (unfounded > 0)
            fault = std::to_string(unfounded) + " edges are folded where the input is not";
    }

    static std::vector<Side> FoldedEdges(const Remesh &remesh, Workers &workers)
    {
        const Triangulation &m = remesh.mesh;
        return InnerEdgesWhere(m, workers, [&](Side s) { return Turn(m, remesh.position, s) > FoldTurn; });
    }

    // Whether the input's normals within `reach` of p differ by more than 75 degrees.
    static bool BendsNear(const Model &model, const Point &p, double reach)
    {
        const ReferenceSurface &surface = model.surface;
        std::vector<Point> normals;
        for (int t = 0; t < surface.FaceCount(); ++t)
            if (surface.NearestOn(t, p).squaredDistance <= reach * reach)
                normals.push_back(Normalized(surface.AreaVector(t)));
        // The normal furthest from the first, then the one furthest from that: nearly the widest pair.
        const auto furthest = [&](const Point &n) {
            return *std::min_element(normals.begin(), normals.end(),
                                     [&](const Point &a, const Point &b) { return Dot(a, n) < Dot(b, n); });
        };
        if (normals.empty())
            return false;
        const Point one = furthest(normals.front());
        return Dot(one, furthest(one)) < SharpCosine;
    }

    static constexpr double SharpCosine = 0.25881904510252074; // of 75 degrees
    static constexpr double FoldTurn = 150 * Pi / 180;

    static double Turn(const Triangulation &m, const std::vector<Point> &x, Side s)
    {
        return TurnAngle(x[m.Tail(s)], x[m.Head(s)], x[m.Opposite(s)], x[m.Opposite(m.Mate(s))]);
    }
};

} // namespace ccdm
} // namespace vcg

#endif
