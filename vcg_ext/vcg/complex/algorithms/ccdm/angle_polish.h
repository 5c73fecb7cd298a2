// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_ANGLE_POLISH_H
#define VCG_CCDM_ANGLE_POLISH_H

#include <algorithm>
#include <cmath>
#include <vector>

#include <vcg/complex/algorithms/ccdm/delaunay.h>
#include <vcg/complex/algorithms/ccdm/relocation.h>

namespace vcg {
namespace ccdm {

/// Smallest angle of a triangle in radians, to 1e-4 (Abramowitz, Stegun 1964, 4.4.45: only square roots
/// and products, the same bits on every machine).
inline double SmallestAngle(const Point &a, const Point &b, const Point &c)
{
    const double la = SquaredNorm(c - b), lb = SquaredNorm(a - c), lc = SquaredNorm(b - a);
    // It lies opposite the shortest side.
    const double shortest = std::min({la, lb, lc});
    const double product = la <= lb && la <= lc ? lb * lc : lb <= lc ? la * lc : la * lb;
    if (!(product > 0))
        return 0;
    const double x = std::min((la + lb + lc - 2 * shortest) / (2 * std::sqrt(product)), 1.0);
    return std::sqrt(1 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 - x * 0.0187293)));
}

/// Raises the sum of the smallest angles of all triangles by flips and small moves.
class AnglePolish
{
public:
    AnglePolish(const Model &model, Remesh &remesh, Workers &workers)
        : _remesh(remesh), _schedule(remesh, workers), _relocator(workers.Count(), Relocator(model, remesh))
    {
    }

    /// `rounds` times through all edges and vertices, the moves getting smaller.
    void Run(int rounds)
    {
        double size = 0.1;
        for (int round = 0; round < rounds; ++round, size *= 0.8) {
            Flip();
            _schedule.ForVertices([&](int v, int worker) {
                if (_remesh.place[v].kind != VertexKind::Corner)
                    _relocator[worker].Climb(v, size, 0.5 * round, Sum);
            });
        }
        Flip();
    }

private:
    Remesh &_remesh;
    PatchSchedule _schedule;
    std::vector<Relocator> _relocator; // one for each worker

    static double Sum(const LocalStar &s, const Point &q)
    {
        double sum = 0;
        for (int k = 0; k < s.triangles; ++k)
            sum += SmallestAngle(q, s.spoke[k], s.spoke[s.After(k)]);
        return sum;
    }

    bool FlipHelps(Side s, const Hinge &h) const
    {
        if (_remesh.mesh.Constrained(s))
            return false;
        const double before = SmallestAngle(h.a, h.p, h.q) + SmallestAngle(h.b, h.p, h.q);
        const double after = SmallestAngle(h.a, h.p, h.b) + SmallestAngle(h.a, h.b, h.q);
        return after > before + 1e-3;
    }

    void Flip()
    {
        _schedule.ForEdges([&](Side s) { return FlipHelps(s, Hinge(_remesh, s)); },
                           [&](Side s) {
                               if (_remesh.mesh.Mate(s) == NoSide)
                                   return;
                               const Hinge h(_remesh, s);
                               if (FlipHelps(s, h) && MayFlip(_remesh, s, h))
                                   _remesh.mesh.Flip(s);
                           });
    }
};

} // namespace ccdm
} // namespace vcg

#endif
