// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_POLISH_H
#define VCG_CCDM_POLISH_H

#include <algorithm>
#include <cmath>
#include <vector>

#include <vcg/complex/algorithms/ccdm/delaunay.h>
#include <vcg/complex/algorithms/ccdm/relocation.h>

namespace vcg {
namespace ccdm {

/// Raises the smallest angles of a remesh: the triangles under a wanted angle get better by a flip or
/// by a small move of one of their vertices, until none can.
class AnglePolish
{
public:
    AnglePolish(const Model &model, Remesh &remesh) : _model(model), _remesh(remesh), _relocator(model, remesh) {}

    /// Works on the triangles with an angle under `degrees`; at most `rounds` times through them. A
    /// change may take the mesh no further from the surface than it was, or than `stray` times an edge
    /// length. Returns the number of triangles that stay under the angle.
    int Run(double degrees, double stray, int rounds)
    {
        _stray = stray * stray;
        const double cosine = std::cos(degrees * Pi / 180);
        std::vector<int> bad;
        for (int round = 0;; ++round) {
            bad.clear();
            for (int t = 0; t < _remesh.mesh.TriangleCount(); ++t)
                if (LargestCosine(t) > cosine)
                    bad.push_back(t);
            if (bad.empty() || round == rounds)
                break;
            bool improved = false;
            for (const int t : bad)
                if (LargestCosine(t) > cosine)
                    improved = Improve(t) || improved;
            if (!improved)
                break;
        }
        return static_cast<int>(bad.size());
    }

private:
    const Model &_model;
    Remesh &_remesh;
    Relocator _relocator;
    double _stray = 0;
    Star _star;

    static double LargestCosine(const Point &a, const Point &b, const Point &c)
    {
        // The smallest angle lies opposite the shortest side.
        const double la = SquaredNorm(c - b), lb = SquaredNorm(a - c), lc = SquaredNorm(b - a);
        const double shortest = std::min({la, lb, lc});
        const double product = la <= lb && la <= lc ? lb * lc : lb <= lc ? la * lc : la * lb;
        return product > 0 ? (la + lb + lc - 2 * shortest) / (2 * std::sqrt(product)) : 1;
    }
    // Cosine of the smallest angle of a triangle: less is better.
    double LargestCosine(int t) const
    {
        const Triangle &T = _remesh.mesh.triangle[t];
        return LargestCosine(_remesh.position[T.v[0]], _remesh.position[T.v[1]], _remesh.position[T.v[2]]);
    }

    bool Improve(int t)
    {
        for (int e = 0; e < 3; ++e)
            if (FlipHelps(MakeSide(t, e)))
                return true;
        const Triangle T = _remesh.mesh.triangle[t];
        bool improved = false;
        for (const int v : T.v)
            improved = Shift(v) || improved;
        return improved;
    }

    bool FlipHelps(Side s)
    {
        if (_remesh.mesh.Mate(s) == NoSide)
            return false;
        const Hinge h(_remesh, s);
        const double before = std::max(LargestCosine(h.a, h.p, h.q), LargestCosine(h.b, h.p, h.q));
        const double after = std::max(LargestCosine(h.a, h.p, h.b), LargestCosine(h.a, h.b, h.q));
        if (!(after < before - 1e-6) || !MayFlip(_remesh, s, h))
            return false;
        // The new edge strays from the surface no further than the old one, or than the limit.
        const double far = std::max(SquaredDistanceNear(_model, _remesh, _remesh.mesh.Tail(s), (h.p + h.q) / 2),
                                    _stray * SquaredNorm(h.a - h.b));
        if (SquaredDistanceNear(_model, _remesh, h.apexA, (h.a + h.b) / 2) > far)
            return false;
        _remesh.mesh.Flip(s);
        return true;
    }

    // Pattern search in six directions of the tangent plane.
    bool Shift(int v)
    {
        if (_remesh.place[v].kind == VertexKind::Corner)
            return false;
        _remesh.mesh.GatherStar(v, _star);
        const Point start = _remesh.position[v];
        const Place place = _remesh.place[v];
        const double rho = _remesh.rho[v];
        const double far = StarSquaredDistance(_model, _remesh, v, _star);
        const auto score = [](const LocalStar &s, const Point &q) {
            double worst = -1;
            for (int i = 0; i < s.triangles; ++i)
                worst = std::max(worst, LargestCosine(q, s.spoke[i], s.spoke[s.After(i)]));
            return -worst;
        };
        bool improved = false;
        for (double size = 0.2; size > 0.02; size *= 0.5)
            for (int k = 0; k < 6; ++k)
                for (int repeat = 0; repeat < 8 && _relocator.TryShift(v, size, k * Pi / 3, score); ++repeat)
                    improved = true;
        const double edge = SquaredNorm(_remesh.position[v] - _remesh.position[_star.outer[0]]);
        if (improved && StarSquaredDistance(_model, _remesh, v, _star) > std::max(far, _stray * edge)) {
            _remesh.position[v] = start;
            _remesh.place[v] = place;
            _remesh.rho[v] = rho;
            return false;
        }
        return improved;
    }
};

} // namespace ccdm
} // namespace vcg

#endif
