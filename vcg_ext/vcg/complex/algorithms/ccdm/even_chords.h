// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_EVEN_CHORDS_H
#define VCG_CCDM_EVEN_CHORDS_H

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/angle_polish.h>
#include <vcg/complex/algorithms/ccdm/relocation.h>
#include <vcg/complex/algorithms/ccdm/trial_patch.h>

namespace vcg {
namespace ccdm {

/// Slides vertices along their curves so that no chord stands off its curve by much more than the others: on parts
/// with round creases these few make the largest distance between the surfaces.
class EvenChords
{
public:
    EvenChords(const Model &model, Remesh &remesh) : _model(model), _remesh(remesh), _relocator(model, remesh) {}

    /// `rounds` times through the chords with the largest gaps, those above `floor`. No angle under `minAngle` degrees
    /// comes about that was not there.
    void Run(double minAngle, int rounds, double floor)
    {
        _mostCosine = std::cos(minAngle * Pi / 180);
        Collect();
        std::vector<Chord> chords;
        for (int round = 0; round < rounds; ++round) {
            chords.clear();
            for (const std::vector<int> &chain : _chain)
                AddChords(chain, chords);
            double most = 0;
            for (const Chord &c : chords)
                most = std::max(most, c.gap);
            bool moved = false;
            for (const Chord &c : chords)
                if (c.gap > std::max(Share * most, floor))
                    moved = Shorten(c) || moved;
            if (!moved)
                return;
        }
    }

private:
    /// Chords with more than this share of the largest gap are shortened.
    static constexpr double Share = 0.8;
    /// Of its length, by which an end moves.
    static constexpr double Step = 0.04;
    /// Loss of the sum of the smallest angles around a vertex that a step may cost, in radians.
    static constexpr double MostLoss = 0.15;

    struct Chord {
        int a, b;   // vertices; -1: a corner
        double gap; // between the middle of the chord and that of the curve
    };

    const Model &_model;
    Remesh &_remesh;
    Relocator _relocator;
    double _mostCosine = 1;
    std::vector<std::vector<int>> _chain; // the vertices of each curve, in order

    void Collect()
    {
        _chain.assign(_model.features.curve.size(), {});
        for (int v = 0; v < _remesh.VertexCount(); ++v)
            if (_remesh.place[v].kind == VertexKind::Curve)
                _chain[_remesh.place[v].curve].push_back(v);
        for (std::vector<int> &chain : _chain)
            std::sort(chain.begin(), chain.end(), [&](int a, int b) {
                return std::pair(_remesh.place[a].s, a) < std::pair(_remesh.place[b].s, b);
            });
    }

    // Where a chord ends: a vertex, or with -1 a corner.
    struct End {
        int v;
        double s;
        Point p;
    };

    void AddChords(const std::vector<int> &chain, std::vector<Chord> &chords) const
    {
        if (chain.empty())
            return;
        const std::vector<Point> &reference = _model.surface.position;
        const FeatureCurve &c = _model.features.curve[_remesh.place[chain.front()].curve];
        std::vector<End> ends;
        if (!c.closed)
            ends.push_back({-1, 0, reference[c.vertex.front()]});
        for (const int v : chain)
            ends.push_back({v, _remesh.place[v].s, _remesh.position[v]});
        ends.push_back(c.closed ? ends.front() : End{-1, c.Length(), reference[c.vertex.back()]});
        for (std::size_t k = 1; k < ends.size(); ++k) {
            const End &a = ends[k - 1], &b = ends[k];
            // A vertex that slid across the start of a closed curve has its place in the order all the same.
            const double way = b.s - a.s + (b.s < a.s ? c.Length() : 0);
            const int hint = a.v < 0 ? 0 : _remesh.place[a.v].segment;
            chords.push_back({a.v, b.v, Norm(c.At(reference, a.s + way / 2, hint) - (a.p + b.p) / 2)});
        }
    }

    struct Angles {
        double cosine = -1; // of the smallest
        double sum = 0;     // of the smallest ones of the triangles
    };

    Angles AnglesAround(int v) const
    {
        Angles a;
        _remesh.mesh.VisitSpokes(v, [&](int, Side s) {
            const Triangle &T = _remesh.mesh.triangle[SideTriangle(s)];
            a.cosine = std::max(a.cosine, LargestCosine(_remesh, SideTriangle(s)));
            a.sum += SmallestAngle(_remesh.position[T.v[0]], _remesh.position[T.v[1]], _remesh.position[T.v[2]]);
            return true;
        });
        return a;
    }

    bool Shorten(const Chord &c)
    {
        const bool a = c.a >= 0 && MoveTowards(c.a, c.b, c), b = c.b >= 0 && MoveTowards(c.b, c.a, c);
        return a || b;
    }

    // `to` is the other end of the chord.
    bool MoveTowards(int v, int to, const Chord &c)
    {
        const Point x = _remesh.position[v];
        const Place place = _remesh.place[v];
        const double rho = _remesh.rho[v];
        const FeatureCurve &curve = _model.features.curve[place.curve];
        const Point target = to >= 0    ? _remesh.position[to]
                             : v == c.b ? _model.surface.position[curve.vertex.front()]
                                        : _model.surface.position[curve.vertex.back()];
        const Angles before = AnglesAround(v);
        if (!_relocator.Relocate(v, [&](const LocalStar &, int) { return Point((target - x) * Step); }))
            return false;
        const Angles after = AnglesAround(v);
        if (after.cosine <= std::max(before.cosine, _mostCosine) && after.sum >= before.sum - MostLoss)
            return true;
        _remesh.position[v] = x;
        _remesh.place[v] = place;
        _remesh.rho[v] = rho;
        return false;
    }
};

} // namespace ccdm
} // namespace vcg

#endif
