// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_TRIAL_PATCH_H
#define VCG_CCDM_TRIAL_PATCH_H

#include <algorithm>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/centroid_rules.h>
#include <vcg/complex/algorithms/ccdm/delaunay.h>

namespace vcg {
namespace ccdm {

/// Cosine of the smallest angle of a triangle.
inline double LargestCosine(const Remesh &r, int t)
{
    const Triangle &T = r.mesh.triangle[t];
    return LargestCosine(r.position[T.v[0]], r.position[T.v[1]], r.position[T.v[2]]);
}

/// Cosine of the turn of an edge between the faces (a, b, p) and (b, a, q).
inline double TurnCosine(const Point &a, const Point &b, const Point &p, const Point &q)
{
    const Point e = b - a, n1 = Cross(e, p - a), n2 = Cross(q - a, e);
    const double scale = std::sqrt(SquaredNorm(n1) * SquaredNorm(n2));
    return scale > 0 ? Dot(n1, n2) / scale : -1;
}

/// 1 for features and boundaries, which may turn as they like.
inline double TurnCosine(const Remesh &r, Side s)
{
    const Triangulation &m = r.mesh;
    if (m.Mate(s) == NoSide || m.Constrained(s))
        return 1;
    return TurnCosine(r.position[m.Tail(s)], r.position[m.Head(s)], r.position[m.Opposite(s)],
                      r.position[m.Opposite(m.Mate(s))]);
}

/// Cosine of the sharpest turn at the edges of a triangle.
inline double SharpestTurnCosine(const Remesh &r, int t)
{
    return std::min({TurnCosine(r, MakeSide(t, 0)), TurnCosine(r, MakeSide(t, 1)), TurnCosine(r, MakeSide(t, 2))});
}

/// A few rings of a remesh around a triangle, for changes on trial: moves of its free vertices and flips of the
/// edges between them can all be taken back.
class TrialPatch
{
public:
    TrialPatch(const Model &model, Remesh &remesh) : _model(model), _remesh(remesh), _relocator(model, remesh) {}

    /// Takes the free vertices within `rings` rings of triangle t, and remembers how they are.
    void Take(int t, int rings)
    {
        _inside.resize(_remesh.VertexCount(), 0);
        Leave();
        GrowRings(t, rings, _vertex, [&](int v) { Enter(v); });
        Save();
    }

    /// Whether test(vertex) is true for all vertices, of features too, within `rings` rings of triangle t; the stars of
    /// those for which it is not are not looked at.
    template <class Test>
    bool AllWithin(int t, int rings, const Test &test)
    {
        _seen.resize(_remesh.VertexCount(), 0);
        std::vector<int> seen;
        bool all = true;
        GrowRings(t, rings, seen, [&](int v) {
            if (_seen[v] != 0)
                return;
            if (!test(v)) {
                all = false;
                return;
            }
            _seen[v] = 1;
            seen.push_back(v);
        });
        for (const int v : seen)
            _seen[v] = 0;
        return all;
    }

    const std::vector<int> &Vertices() const { return _vertex; }
    const std::vector<int> &Triangles() const { return _triangle; }
    bool Contains(int v) const { return _inside[v] != 0; }

    /// Makes everything as it was.
    void Restore()
    {
        for (std::size_t k = 0; k < _triangle.size(); ++k)
            _remesh.mesh.triangle[_triangle[k]] = _record[k];
        for (std::size_t k = 0; k < _vertex.size(); ++k) {
            const int v = _vertex[k];
            const State &s = _state[k];
            _remesh.mesh.incident[v] = s.incident;
            _remesh.mesh.ForgetRing(v);
            _remesh.position[v] = s.position;
            _remesh.place[v] = s.place;
            _remesh.rho[v] = s.rho;
        }
    }

    /// Moves every vertex by `displacement(star, vertex)`, in order.
    template <class Displacement>
    void Sweep(const Displacement &displacement)
    {
        for (const int v : _vertex)
            _relocator.Relocate(v, displacement);
    }

    /// Delaunay flips and relocations to the cell centroid in turn; the vertices for which fixed(v) is true stay.
    template <class Fixed>
    void Relax(int sweeps, const Fixed &fixed)
    {
        const CellCentroid rule{_remesh, _model.density.uniform};
        for (int i = 0; i < sweeps; ++i) {
            Flip();
            for (const int v : _vertex)
                if (!fixed(v))
                    _relocator.Relocate(v, rule);
        }
        Flip();
    }

    /// Cosine of the smallest angle of the patch.
    double WorstCosine() const
    {
        double worst = -1;
        for (const int t : _triangle)
            worst = std::max(worst, LargestCosine(_remesh, t));
        return worst;
    }

    /// Cosine of the sharpest turn at its edges.
    double WorstTurnCosine() const
    {
        double worst = 1;
        for (const int t : _triangle)
            worst = std::min(worst, SharpestTurnCosine(_remesh, t));
        return worst;
    }

    /// Whether no smallest angle of the patch has a larger cosine, and no edge turns by a smaller one.
    bool Keeps(double cosine, double turn) const
    {
        return std::all_of(_triangle.begin(), _triangle.end(),
                           [&](int t) { return LargestCosine(_remesh, t) <= cosine; }) &&
               std::all_of(_triangle.begin(), _triangle.end(),
                           [&](int t) { return SharpestTurnCosine(_remesh, t) >= turn; });
    }

    /// The same for the triangles of one vertex.
    bool KeepsAt(int v, double cosine, double turn) const
    {
        bool keeps = true;
        _remesh.mesh.VisitSpokes(v, [&](int, Side s) {
            keeps = LargestCosine(_remesh, SideTriangle(s)) <= cosine &&
                    SharpestTurnCosine(_remesh, SideTriangle(s)) >= turn;
            return keeps;
        });
        return keeps;
    }

private:
    struct State {
        int incident;
        Point position;
        Place place;
        double rho;
    };

    const Model &_model;
    Remesh &_remesh;
    Relocator _relocator;
    std::vector<int> _vertex, _triangle; // the triangles are those that touch the vertices
    std::vector<State> _state;
    std::vector<Triangle> _record;
    std::vector<char> _inside, _seen;

    // Calls enter(vertex) for the vertices of triangle t and then, ring by ring, for the neighbours of those that it
    // has appended to `grown`.
    template <class EnterVertex>
    void GrowRings(int t, int rings, const std::vector<int> &grown, const EnterVertex &enter) const
    {
        for (const int v : _remesh.mesh.triangle[t].v)
            enter(v);
        for (std::size_t begin = 0; rings > 0; --rings) {
            const std::size_t end = grown.size();
            for (; begin < end; ++begin)
                _remesh.mesh.VisitSpokes(grown[begin], [&](int o, Side) {
                    enter(o);
                    return true;
                });
        }
    }

    void Enter(int v)
    {
        if (_inside[v] != 0 || _remesh.place[v].kind != VertexKind::Free)
            return;
        _inside[v] = 1;
        _vertex.push_back(v);
    }

    void Leave()
    {
        for (const int v : _vertex)
            _inside[v] = 0;
        _vertex.clear();
    }

    void Save()
    {
        _triangle.clear();
        _state.clear();
        _record.clear();
        for (const int v : _vertex) {
            _state.push_back({_remesh.mesh.incident[v], _remesh.position[v], _remesh.place[v], _remesh.rho[v]});
            _remesh.mesh.VisitSpokes(v, [&](int, Side s) {
                _triangle.push_back(SideTriangle(s));
                return true;
            });
        }
        std::sort(_triangle.begin(), _triangle.end());
        _triangle.erase(std::unique(_triangle.begin(), _triangle.end()), _triangle.end());
        for (const int t : _triangle)
            _record.push_back(_remesh.mesh.triangle[t]);
    }

    // Only edges with all four vertices inside: no record outside the patch changes.
    void Flip()
    {
        for (int round = 0; round < 4; ++round) {
            bool flipped = false;
            for (const int t : _triangle)
                for (int e = 0; e < 3; ++e) {
                    const Side s = MakeSide(t, e);
                    if (_remesh.mesh.Mate(s) <= s)
                        continue;
                    const Hinge h(_remesh, s);
                    if (h.Excess() > 0 && Contains(h.apexA) && Contains(h.apexB) && Contains(_remesh.mesh.Tail(s)) &&
                        Contains(_remesh.mesh.Head(s)) && MayFlip(_remesh, s, h)) {
                        _remesh.mesh.Flip(s);
                        flipped = true;
                    }
                }
            if (!flipped)
                return;
        }
    }
};

} // namespace ccdm
} // namespace vcg

#endif
