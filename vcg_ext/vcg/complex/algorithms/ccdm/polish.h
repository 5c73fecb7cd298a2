// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_POLISH_H
#define VCG_CCDM_POLISH_H

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <vcg/complex/algorithms/ccdm/trial_patch.h>

namespace vcg {
namespace ccdm {

/// Mends the worst places of a remesh: triangles under a wanted angle, and folds, get better by a flip
/// or by a small move of one of their vertices, until none can.
class Polish
{
public:
    Polish(const Model &model, Remesh &remesh, Workers &workers)
        : Polish(model, remesh, workers, 50 + remesh.VertexCount() / 50)
    {
    }
    /// `failures`: how many attempts at triangles may be in vain.
    Polish(const Model &model, Remesh &remesh, Workers &workers, int failures)
        : _model(model), _remesh(remesh), _workers(workers), _relocator(model, remesh), _patch(model, remesh),
          _failuresLeft(failures), _searchesLeft(2000 + 4LL * remesh.VertexCount())
    {
    }

    /// RaiseAngles leaves these vertices where they are until the next call of this, though edges at them may flip.
    void Pin(const std::vector<int> &vertices) { _pinned = {vertices.begin(), vertices.end()}; }

    /// Works on the triangles with an angle under `degrees`; at most `rounds` times through them. A
    /// change may take the mesh no further from the surface than it was, or than `stray` times an edge
    /// length. Attempts in vain are limited, all calls together. Returns the number of
    /// triangles that stay under the angle. Later calls for no larger angle look only at what the first one left and at
    /// what has changed since.
    int RaiseAngles(double degrees, double stray, int rounds)
    {
        _stray = stray * stray;
        const double cosine = std::cos(degrees * Pi / 180);
        const auto small = [&](int t) { return LargestCosine(t) > cosine; };
        if (_searched < degrees)
            _bad = Chunks::Where(_workers, _remesh.mesh.TriangleCount(), small);
        _searched = degrees;
        // A triangle that could not be helped twice is left alone; thin parts may have nothing else.
        std::unordered_map<int, int> failures;
        _gain = FairGain;
        bool improved = true; // in the last round
        for (int round = 0;; ++round) {
            _bad.erase(std::remove_if(_bad.begin(), _bad.end(), [&](int t) { return !small(t); }), _bad.end());
            if (!improved) {
                if (_gain == LeastGain)
                    break;
                _gain = LeastGain;
                failures.clear();
            }
            if (_bad.empty() || round == rounds)
                break;
            if (_bad.size() <= Few)
                _gain = LeastGain;
            improved = false;
            for (const int t : _bad)
                if (small(t) && _failuresLeft > 0 && failures[t] < 2) {
                    const bool helped = Improve(t);
                    failures[t] = helped ? 0 : failures[t] + 1;
                    // What fails for the pins is tried again without them.
                    _failuresLeft -= helped || Pinned(t) ? 0 : 1;
                    improved = improved || helped;
                }
            LookAroundChanged();
        }
        return static_cast<int>(_bad.size());
    }

    /// Shakes what RaiseAngles has left and no feature touches: the vertices around such a triangle are perturbed and
    /// optimised anew, a few times over, until the smallest angle there is larger than it was. Where two irregular
    /// vertices hold each other, no small move helps. At most `places` of them, as many `rings` around each; where all
    /// is bad the searches for positions are limited too, all calls together.
    void Shake(std::uint64_t seed, int places, int rings = 3)
    {
        const std::vector<int> left = _bad;
        std::unordered_set<int> vain; // triangles of patches that no shake has helped: theirs would be nearly the same
        Random random(seed);
        for (const int t : left) {
            const Triangle &T = _remesh.mesh.triangle[t];
            const bool free = std::all_of(std::begin(T.v), std::end(T.v),
                                          [&](int v) { return _remesh.place[v].kind == VertexKind::Free; });
            if (!free || vain.count(t) > 0 || !(LargestCosine(t) > std::cos(_searched * Pi / 180)))
                continue;
            if (places-- == 0 || _searchesLeft <= 0)
                break;
            if (!ShakeAround(t, rings, random))
                vain.insert(_patch.Triangles().begin(), _patch.Triangles().end());
        }
        LookAroundChanged();
    }

    /// Opens the edges, features apart, whose faces turn by more than 150 degrees, by moving the vertices
    /// of their triangles; at most `rounds` times through them. Returns the number of edges left so.
    int Unfold(int rounds)
    {
        std::vector<Side> folded;
        for (int round = 0;; ++round) {
            folded = Folded();
            if (folded.empty() || round == rounds)
                break;
            bool improved = false;
            for (const Side s : folded)
                if (TurnCosine(_remesh, s) < FoldCosine) {
                    const Side mate = _remesh.mesh.Mate(s);
                    const int around[4] = {_remesh.mesh.Opposite(s), _remesh.mesh.Opposite(mate), _remesh.mesh.Tail(s),
                                           _remesh.mesh.Head(s)};
                    bool opened = false;
                    for (int e = 0; e < 3 && !opened; ++e)
                        opened = FlipOpens(MakeSide(SideTriangle(s), e)) || FlipOpens(MakeSide(SideTriangle(mate), e));
                    for (const int v : around)
                        opened = Open(v) || opened;
                    // Stuck: the vertices further out may make room.
                    if (!opened)
                        for (const int v : around) {
                            _remesh.mesh.GatherStar(v, _star);
                            const std::vector<int> outer = _star.outer;
                            for (std::size_t k = 0; k < std::min(outer.size(), MostTried); ++k)
                                opened = Open(outer[k]) || opened;
                        }
                    improved = improved || opened;
                }
            if (!improved)
                break;
        }
        return static_cast<int>(folded.size());
    }

private:
    static constexpr int Shakes = 12;
    /// Squared length of the other diagonal over that of an edge, from which on a flip is not tried while there is more
    /// than a few triangles to see to; in two equilateral triangles it is 3. Measured: of the flips that helped
    /// together with moves 3 % were beyond it, of the others 30 %; and 3 and 20 % began with less than half the angle.
    static constexpr double LongFlip = 4;
    static constexpr std::size_t Few = 30;
    /// What a step of a search gains at least, as a difference of cosines: the second in a call's first rounds,
    /// until none does or a few triangles are left. Measured: with less from the start, small angles between features
    /// that are close together are spread without end while others wait.
    static constexpr double LeastGain = 1e-6, FairGain = 1e-3;
    static constexpr std::size_t MostTried = 96; // of a star: at the tip of needles there can be many hundreds
    static constexpr double FoldCosine = -0.8660254037844387; // of 150 degrees

    const Model &_model;
    Remesh &_remesh;
    Workers &_workers;
    Relocator _relocator;
    TrialPatch _patch;
    int _failuresLeft;       // attempts at triangles, all calls together, that may be in vain
    long long _searchesLeft; // for positions in shaken patches, all calls together
    double _stray = 0;
    double _gain = LeastGain;  // of the steps of Shift
    double _searched = -1;     // the angle that all triangles have been searched for
    std::vector<int> _bad;     // triangles to look at
    std::vector<int> _changed; // vertices that have moved, or whose edges have changed
    std::unordered_set<int> _pinned;
    Star _star;

    bool Pinned(int t) const
    {
        const Triangle &T = _remesh.mesh.triangle[t];
        return std::any_of(std::begin(T.v), std::end(T.v), [&](int v) { return _pinned.count(v) > 0; });
    }

    // One side of each folded edge.
    std::vector<Side> Folded() const
    {
        return InnerEdgesWhere(_remesh.mesh, _workers, [&](Side s) { return TurnCosine(_remesh, s) < FoldCosine; });
    }

    double LargestCosine(int t) const { return ccdm::LargestCosine(_remesh, t); }

    // A flip that is taken back may have swapped the records of its triangles: that is a change too.
    void LookAroundChanged()
    {
        for (const int v : _changed)
            _remesh.mesh.VisitSpokes(v, [&](int, Side s) {
                _bad.push_back(SideTriangle(s));
                return true;
            });
        std::sort(_bad.begin(), _bad.end());
        _bad.erase(std::unique(_bad.begin(), _bad.end()), _bad.end());
        _changed.clear();
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
        // Stuck: the neighbours' apices may make room.
        for (int e = 0; e < 3 && !improved; ++e)
            if (T.n[e] != NoSide)
                improved = Shift(_remesh.mesh.Opposite(T.n[e]));
        for (int i = 0; i < 3 && !improved; ++i) {
            _remesh.mesh.GatherStar(T.v[i], _star);
            const std::vector<Side> around = _star.corner;
            for (std::size_t k = 0; k < std::min(around.size(), MostTried) && !improved; ++k)
                improved = FlipAndShift(MakeSide(SideTriangle(around[k]), Next(SideEdge(around[k]))));
        }
        return improved;
    }

    // Largest squared distance of a centroid of the patch from the surface, in squared edges.
    double StrayOfPatch() const
    {
        double stray = 0;
        for (const int t : _patch.Triangles()) {
            const Triangle &T = _remesh.mesh.triangle[t];
            const Point &a = _remesh.position[T.v[0]], &b = _remesh.position[T.v[1]], &c = _remesh.position[T.v[2]];
            const int *home = std::find_if(std::begin(T.v), std::end(T.v),
                                           [&](int v) { return _remesh.place[v].kind == VertexKind::Free; });
            if (home != std::end(T.v))
                stray =
                    std::max(stray, SquaredDistanceNear(_model, _remesh, *home, (a + b + c) / 3) / SquaredNorm(b - a));
        }
        return stray;
    }

    // Whether that helped.
    bool ShakeAround(int t, int rings, Random &random)
    {
        _patch.Take(t, rings);
        const std::vector<int> &region = _patch.Vertices();
        _changed.insert(_changed.end(), region.begin(), region.end());
        const double cosine = _patch.WorstCosine(), turn = std::min(_patch.WorstTurnCosine(), 0.0);
        const double stray = std::max(StrayOfPatch(), _stray);
        for (int attempt = 0; attempt < Shakes; ++attempt) {
            _patch.Sweep(Perturbation{0.2 + 0.05 * attempt, random.Bits()});
            _patch.Relax(8, [](int) { return false; });
            for (int round = 0; round < 4 && ShiftAllOfPatch(); ++round)
                ;
            if (_patch.WorstCosine() < cosine - 1e-3 && _patch.WorstTurnCosine() >= turn && StrayOfPatch() <= stray)
                return true;
            _patch.Restore();
        }
        return false;
    }

    // Whether any vertex has moved.
    bool ShiftAllOfPatch()
    {
        const double wanted = std::cos(_searched * Pi / 180);
        bool moved = false;
        for (const int t : _patch.Triangles())
            if (LargestCosine(t) > wanted)
                for (const int v : _remesh.mesh.triangle[t].v)
                    if (_patch.Contains(v) && _searchesLeft-- > 0)
                        moved = Shift(v) || moved;
        return moved;
    }

    double LargestCosineAround(const int (&vertex)[4])
    {
        double worst = -1;
        for (const int v : vertex)
            _remesh.mesh.VisitSpokes(v, [&](int, Side s) {
                worst = std::max(worst, LargestCosine(SideTriangle(s)));
                return true;
            });
        return worst;
    }

    // A flip that does not help by itself, but does once its four vertices have moved.
    bool FlipAndShift(Side s)
    {
        const Side mate = _remesh.mesh.Mate(s);
        if (mate == NoSide)
            return false;
        const Hinge h(_remesh, s);
        const bool thorough = _bad.size() <= Few;
        if ((!thorough && SquaredNorm(h.a - h.b) > LongFlip * SquaredNorm(h.p - h.q)) || !MayFlip(_remesh, s, h))
            return false;
        const int vertex[4] = {h.apexA, h.apexB, _remesh.mesh.Tail(s), _remesh.mesh.Head(s)};
        Point position[4];
        Place place[4];
        double rho[4];
        for (int i = 0; i < 4; ++i) {
            position[i] = _remesh.position[vertex[i]];
            place[i] = _remesh.place[vertex[i]];
            rho[i] = _remesh.rho[vertex[i]];
        }
        const double before = LargestCosineAround(vertex);
        const double far =
            std::max(SquaredDistanceNear(_model, _remesh, vertex[2], (h.p + h.q) / 2), _stray * SquaredNorm(h.a - h.b));
        if (SquaredDistanceNear(_model, _remesh, h.apexA, (h.a + h.b) / 2) > far)
            return false;
        const Side flipped = _remesh.mesh.Flip(s);
        _changed.insert(_changed.end(), std::begin(vertex), std::end(vertex));
        // Half the smallest angle of before is too little to begin with.
        if (thorough || LargestCosineAround(vertex) < std::sqrt((1 + before) / 2)) {
            for (const int v : vertex)
                Shift(v);
            if (LargestCosineAround(vertex) < before - LeastGain)
                return true;
        }
        for (int i = 0; i < 4; ++i)
            SetVertex(vertex[i], position[i], place[i], rho[i]);
        _remesh.mesh.Flip(flipped);
        return false;
    }

    bool FlipHelps(Side s)
    {
        if (_remesh.mesh.Mate(s) == NoSide)
            return false;
        const Hinge h(_remesh, s);
        const double before = std::max(ccdm::LargestCosine(h.a, h.p, h.q), ccdm::LargestCosine(h.b, h.p, h.q));
        const double after = std::max(ccdm::LargestCosine(h.a, h.p, h.b), ccdm::LargestCosine(h.a, h.b, h.q));
        if (!(after < before - LeastGain) || !MayFlip(_remesh, s, h))
            return false;
        // The new edge strays from the surface no further than the old one, or than the limit.
        const double far = std::max(SquaredDistanceNear(_model, _remesh, _remesh.mesh.Tail(s), (h.p + h.q) / 2),
                                    _stray * SquaredNorm(h.a - h.b));
        if (SquaredDistanceNear(_model, _remesh, h.apexA, (h.a + h.b) / 2) > far)
            return false;
        _changed.insert(_changed.end(), {h.apexA, h.apexB, _remesh.mesh.Tail(s), _remesh.mesh.Head(s)});
        _remesh.mesh.Flip(s);
        return true;
    }

    // Flips an edge if the sharpest turn at its two triangles gets less by that.
    bool FlipOpens(Side s)
    {
        Triangulation &m = _remesh.mesh;
        const Side mate = m.Mate(s);
        if (mate == NoSide || m.Constrained(s) || m.FindEdge(m.Opposite(s), m.Opposite(mate)) != NoSide)
            return false;
        const int t = SideTriangle(s), u = SideTriangle(mate);
        const double before = std::min(SharpestTurnCosine(_remesh, t), SharpestTurnCosine(_remesh, u));
        const Side flipped = m.Flip(s);
        if (std::min(SharpestTurnCosine(_remesh, t), SharpestTurnCosine(_remesh, u)) > before + 1e-3)
            return true;
        m.Flip(flipped);
        return false;
    }

    // Pattern search for the position of v at which the sharpest turn in and around its star is least.
    bool Open(int v)
    {
        if (_remesh.place[v].kind == VertexKind::Corner)
            return false;
        _remesh.mesh.GatherStar(v, _star);
        Point &x = _remesh.position[v];
        return _relocator.Search(v, 0.5, 0.02, 4, LeastGain, [&](const LocalStar &, const Point &q, double wanted) {
            const Point stay = x;
            x += q;
            double worst = 1;
            for (std::size_t k = 0; k < _star.corner.size() && worst > wanted; ++k)
                worst = std::min(worst, SharpestTurnCosine(_remesh, SideTriangle(_star.corner[k])));
            x = stay;
            return worst;
        });
    }

    // Pattern search in six directions of the tangent plane.
    bool Shift(int v)
    {
        if (_remesh.place[v].kind == VertexKind::Corner || _pinned.count(v) > 0)
            return false;
        const Point start = _remesh.position[v];
        const Place place = _remesh.place[v];
        const double rho = _remesh.rho[v];
        const auto score = [](const LocalStar &s, const Point &q, double wanted) {
            double least = 1;
            for (int i = 0; i < s.triangles && least > wanted; ++i)
                least = std::min(least, -ccdm::LargestCosine(q, s.spoke[i], s.spoke[i + 1]));
            return least;
        };
        if (!_relocator.Search(v, 0.2, 0.02, 8, _gain, score))
            return false;
        _changed.push_back(v);
        _remesh.mesh.GatherStar(v, _star);
        const double edge = SquaredNorm(_remesh.position[v] - _remesh.position[_star.outer[0]]);
        const double distance = StarSquaredDistance(_model, _remesh, v, _star);
        if (distance <= _stray * edge)
            return true;
        const Point end = _remesh.position[v];
        const Place endPlace = _remesh.place[v];
        const double endRho = _remesh.rho[v];
        SetVertex(v, start, place, rho);
        if (distance > StarSquaredDistance(_model, _remesh, v, _star))
            return false;
        SetVertex(v, end, endPlace, endRho);
        return true;
    }

    void SetVertex(int v, const Point &position, const Place &place, double rho)
    {
        _remesh.position[v] = position;
        _remesh.place[v] = place;
        _remesh.rho[v] = rho;
    }
};

} // namespace ccdm
} // namespace vcg

#endif
