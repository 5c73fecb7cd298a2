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

/// Smallest angle in radians of the triangle with these squared lengths of the sides, to 1e-4 (Abramowitz, Stegun
/// 1964, 4.4.45: only square roots and products, the same bits on every machine).
inline double SmallestAngle(double la, double lb, double lc)
{
    const double x = std::min(LargestCosine(la, lb, lc), 1.0);
    return std::sqrt(1 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 - x * 0.0187293)));
}

inline double SmallestAngle(const Point &a, const Point &b, const Point &c)
{
    return SmallestAngle(SquaredNorm(c - b), SquaredNorm(a - c), SquaredNorm(b - a));
}

/// How the smallest angle of the triangle (q, u, w) changes with q, at q = 0; `cross` is u x w, and uu, ww and uw are
/// the squared lengths of u, w and w - u. Where two or three angles are about equally small, the mean of what they
/// say: the smallest alone would lead to and fro.
inline Point SmallestAngleGradient(const Point &u, const Point &w, const Point &cross, double uu, double ww, double uw)
{
    constexpr double alike = 0.03; // of the squared length of the shortest side; measured
    // An angle is as small as the side opposite to it is short.
    const double least = std::min({uu, ww, uw}), scale = 1 / (alike * least);
    const auto weight = [&](double side) { return std::max(0.0, 1 - (side - least) * scale); };
    const double atQ = weight(uw), atU = weight(ww), atW = weight(uu);
    const double product = (atQ + atU + atW) * Norm(cross) * uu * ww;
    if (!(product > 0))
        return Point(0, 0, 0);
    const double all = 1 / product;
    return Cross(cross, u) * ((atQ - atU) * ww * all) + Cross(cross, w) * ((atW - atQ) * uu * all);
}

/// Smallest angle of triangle k of a star; adds to the gradient `weight(angle)` times what the angle changes by.
template <class Weight>
double SmallestAngleAt(const LocalStar &star, int k, Point &gradient, const Weight &weight)
{
    const Point &u = star.spoke[k], &w = star.spoke[k + 1];
    const double uu = star.squared[k], ww = star.squared[k + 1], uw = SquaredNorm(w - u);
    const double angle = SmallestAngle(uw, ww, uu);
    gradient += SmallestAngleGradient(u, w, star.cross[k], uu, ww, uw) * weight(angle);
    return angle;
}

/// Raises the sum of the smallest angles of all triangles by flips and small moves.
class AnglePolish
{
public:
    AnglePolish(const Model &model, Remesh &remesh, Workers &workers)
        : _remesh(remesh), _schedule(remesh, workers), _relocator(workers, Relocator(model, remesh))
    {
    }

    /// `rounds` times through all edges and vertices, the moves getting smaller.
    void Run(int rounds)
    {
        double size = 0.06;
        for (int round = 0; round < rounds; ++round, size *= 0.82) {
            Flip();
            _schedule.ForVertices([&](int v, int worker) {
                _relocator[worker].PrefetchAfter(v);
                if (_remesh.place[v].kind != VertexKind::Corner)
                    _relocator[worker].Ascend(v, size, Sum, true);
            });
        }
        Flip();
    }

private:
    Remesh &_remesh;
    PatchSchedule _schedule;
    PerWorker<Relocator> _relocator;

    // Sum of the smallest angles of the star with its centre at q.
    static double Sum(const LocalStar &s, const Point &q, Point *gradient, double /*wanted*/)
    {
        double sum = 0;
        for (int k = 0; k < s.triangles; ++k)
            sum += gradient != nullptr ? SmallestAngleAt(s, k, *gradient, [](double) { return 1.0; })
                                       : SmallestAngle(q, s.spoke[k], s.spoke[k + 1]);
        return sum;
    }

    bool FlipHelps(Side s, const Hinge &h) const
    {
        if (_remesh.mesh.Constrained(s) || h.Slender())
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
