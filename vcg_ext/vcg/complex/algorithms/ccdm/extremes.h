// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_EXTREMES_H
#define VCG_CCDM_EXTREMES_H

#include <algorithm>
#include <cmath>
#include <vector>

#include <vcg/complex/algorithms/ccdm/remesh.h>

namespace vcg {
namespace ccdm {

/// Puts vertices of the remesh onto the tips of the input that the remesh cuts off. Relocation pays no
/// regard to the distance between the surfaces (paper, section 4, limitations), so the distance at a
/// few tips and ridges would otherwise be several times that of the rest.
class ExtremeCapture
{
public:
    ExtremeCapture(const Model &model, Remesh &remesh) : _model(model), _remesh(remesh) { PlaceProbes(); }

    /// Finds the probes furthest from the remesh, those beyond `outlier` times the root mean square
    /// distance, and moves the nearest free vertex onto each, if the star stays well shaped (no
    /// angle under `minAngle` degrees that was not there) and nothing else around gets further away.
    /// Returns the vertices that now sit on a tip.
    std::vector<int> Run(double outlier, double minAngle)
    {
        FindOwners();
        double squares = 0;
        for (const double d : _distance)
            squares += d * d;
        const double limit =
            outlier * std::sqrt(squares / static_cast<double>(std::max<std::size_t>(_distance.size(), 1)));
        std::vector<int> worst;
        for (std::size_t r = 0; r < _probe.size(); ++r)
            if (_distance[r] > limit)
                worst.push_back(static_cast<int>(r));
        std::sort(worst.begin(), worst.end(),
                  [&](int a, int b) { return _distance[a] != _distance[b] ? _distance[a] > _distance[b] : a < b; });
        std::vector<int> captured;
        std::vector<char> settled(_remesh.VertexCount(), 0);
        const std::size_t most = static_cast<std::size_t>(_remesh.VertexCount()) / 1000 + 1;
        for (const int r : worst)
            if (captured.size() < most) {
                const int v = Capture(r, minAngle * Pi / 180, settled);
                if (v >= 0)
                    captured.push_back(v);
            }
        return captured;
    }

private:
    // A point of the input, off the features, where the distance is watched.
    struct Probe {
        Point point;
        int face;
        int vertex; // an input vertex at or near it
    };

    const Model &_model;
    Remesh &_remesh;
    std::vector<Probe> _probe;
    std::vector<int> _owner;         // triangle of the remesh nearest to each probe
    std::vector<double> _distance;   // and how far it is
    std::vector<int> _first, _owned; // probes of each triangle
    Star _star;

    // The input's vertices, and points along edges that are long and sharp enough for the largest
    // distance to lie between their ends.
    void PlaceProbes()
    {
        const Triangulation &m = _model.surface.mesh;
        const std::vector<Point> &x = _model.surface.position;
        std::vector<char> onFeature(x.size(), 0);
        for (int t = 0; t < m.TriangleCount(); ++t)
            for (int e = 0; e < 3; ++e)
                if (m.triangle[t].Constrained(e))
                    onFeature[m.triangle[t].v[Next(e)]] = onFeature[m.triangle[t].v[Prev(e)]] = 1;
        for (std::size_t v = 0; v < x.size(); ++v)
            if (!onFeature[v] && m.incident[v] >= 0)
                _probe.push_back({x[v], m.incident[v], static_cast<int>(v)});
        for (int t = 0; t < m.TriangleCount(); ++t)
            for (int e = 0; e < 3; ++e) {
                const Side s = MakeSide(t, e), mate = m.Mate(s);
                if (mate < s || m.Constrained(s))
                    continue;
                const int a = m.Tail(s), b = m.Head(s);
                const double h = 0.5 * _model.density.spacing[a], length = Norm(x[b] - x[a]);
                if (length <= h || TurnAngle(x[a], x[b], x[m.Opposite(s)], x[m.Opposite(mate)]) < 0.3)
                    continue;
                const int parts = static_cast<int>(std::min(length / h, 1000.0)) + 1;
                for (int k = 1; k < parts; ++k)
                    _probe.push_back(
                        {x[a] + (x[b] - x[a]) * (static_cast<double>(k) / parts), t, 2 * k < parts ? a : b});
            }
    }

    Foot NearestOnRemesh(int t, const Point &p) const
    {
        const Triangle &T = _remesh.mesh.triangle[t];
        const Point &a = _remesh.position[T.v[0]];
        return NearestOnTriangle(a, _remesh.position[T.v[1]] - a, _remesh.position[T.v[2]] - a, p);
    }

    // Nearest triangle by descent from a vertex of the remesh that lies close by on the surface: first
    // from vertex to vertex, then among the triangles around the last.
    void Descend(int r, int v)
    {
        const Point &p = _probe[r].point;
        double best = SquaredNorm(_remesh.position[v] - p);
        for (bool moved = true; moved;) {
            moved = false;
            _remesh.mesh.VisitSpokes(v, [&](int o, Side) {
                const double d = SquaredNorm(_remesh.position[o] - p);
                if (d < best) {
                    best = d;
                    v = o;
                    moved = true;
                }
                return !moved;
            });
        }
        _distance[r] = 1e300;
        _remesh.mesh.VisitSpokes(v, [&](int, Side s) {
            const double d = NearestOnRemesh(SideTriangle(s), p).squaredDistance;
            if (d < _distance[r]) {
                _distance[r] = d;
                _owner[r] = SideTriangle(s);
            }
            return _distance[r] > 0;
        });
        _distance[r] = std::sqrt(_distance[r]);
    }

    void FindOwners()
    {
        const Triangulation &m = _model.surface.mesh;
        const int count = m.VertexCount();
        std::vector<int> near(count, -1), queue;
        for (int v = 0; v < _remesh.VertexCount(); ++v)
            for (const int r : m.triangle[_remesh.place[v].face].v) {
                const Point &p = _model.surface.position[r];
                if (near[r] < 0)
                    queue.push_back(r);
                if (near[r] < 0 || SquaredNorm(_remesh.position[v] - p) < SquaredNorm(_remesh.position[near[r]] - p))
                    near[r] = v;
            }
        for (std::size_t k = 0; k < queue.size(); ++k)
            m.VisitSpokes(queue[k], [&](int o, Side) {
                if (near[o] < 0) {
                    near[o] = near[queue[k]];
                    queue.push_back(o);
                }
                return true;
            });
        _owner.assign(_probe.size(), -1);
        _distance.assign(_probe.size(), 0);
        _first.assign(_remesh.mesh.TriangleCount() + 1, 0);
        for (std::size_t r = 0; r < _probe.size(); ++r) {
            const int v = near[_probe[r].vertex];
            if (v >= 0) {
                Descend(static_cast<int>(r), v);
                ++_first[_owner[r] + 1];
            }
        }
        for (std::size_t t = 1; t < _first.size(); ++t)
            _first[t] += _first[t - 1];
        _owned.resize(_first.back());
        std::vector<int> fill(_first.begin(), _first.end() - 1);
        for (std::size_t r = 0; r < _probe.size(); ++r)
            if (_owner[r] >= 0)
                _owned[fill[_owner[r]]++] = static_cast<int>(r);
    }

    struct Shape {
        double angle;    // smallest angle around the vertex
        double distance; // largest squared distance between the star and the probes that it owns
        double turn;     // sharpest turn at an edge in or around the star, in radians
    };

    Shape Look(int v) const
    {
        Shape s = {Pi, StarSquaredDistance(_model, _remesh, v, _star), SharpestTurn()};
        for (const Side c : _star.corner) {
            const Triangle &T = _remesh.mesh.triangle[SideTriangle(c)];
            for (int i = 0; i < 3; ++i) {
                const Point &x = _remesh.position[T.v[i]];
                const Point u = _remesh.position[T.v[Next(i)]] - x, w = _remesh.position[T.v[Prev(i)]] - x;
                s.angle = std::min(s.angle, std::atan2(Norm(Cross(u, w)), Dot(u, w)));
            }
            for (int k = _first[SideTriangle(c)]; k < _first[SideTriangle(c) + 1]; ++k) {
                double d = 1e300;
                for (const Side other : _star.corner)
                    d = std::min(d, NearestOnRemesh(SideTriangle(other), _probe[_owned[k]].point).squaredDistance);
                s.distance = std::max(s.distance, d);
            }
        }
        return s;
    }

    static constexpr double SharpTurn = 100 * Pi / 180;

    // Sharpest turn at the edges in and around the star of v, features apart.
    double SharpestTurn() const
    {
        const Triangulation &m = _remesh.mesh;
        const std::vector<Point> &x = _remesh.position;
        double turn = 0;
        for (const Side c : _star.corner)
            for (int e = 0; e < 3; ++e) {
                const Side s = MakeSide(SideTriangle(c), e);
                if (m.Mate(s) != NoSide && !m.Constrained(s))
                    turn = std::max(turn,
                                    TurnAngle(x[m.Tail(s)], x[m.Head(s)], x[m.Opposite(s)], x[m.Opposite(m.Mate(s))]));
            }
        return turn;
    }

    int Capture(int r, double minAngle, std::vector<char> &settled)
    {
        const Point target = _probe[r].point;
        const Triangle &T = _remesh.mesh.triangle[_owner[r]];
        int v = -1;
        for (const int c : T.v)
            if (_remesh.place[c].kind == VertexKind::Free && !settled[c] &&
                (v < 0 || SquaredNorm(_remesh.position[c] - target) < SquaredNorm(_remesh.position[v] - target)))
                v = c;
        if (v < 0)
            return -1;
        _remesh.mesh.GatherStar(v, _star);
        for (const int o : _star.outer)
            if (settled[o])
                return -1;
        const Point old = _remesh.position[v];
        const int oldFace = _remesh.place[v].face;
        // A tip behind a crease is not for this vertex.
        const Foot reached = _model.surface.Project(oldFace, old, target, 0).second;
        if (reached.squaredDistance > 1e-12 * SquaredNorm(target - old))
            return -1;
        const Shape before = Look(v);
        // All the way to the tip, or part of it.
        for (const double way : {1.0, 0.75, 0.5}) {
            _remesh.position[v] = target;
            _remesh.place[v].face = _probe[r].face;
            if (way < 1) {
                const auto [face, foot] = _model.surface.Project(_probe[r].face, target, old + (target - old) * way, 0);
                _remesh.position[v] = foot.point;
                _remesh.place[v].face = face;
            }
            const Shape after = Look(v);
            if (after.turn <= std::max(before.turn, SharpTurn) && after.angle >= std::min(before.angle, minAngle) &&
                after.distance < before.distance) {
                _remesh.rho[v] = _model.density.rho[_probe[r].vertex];
                settled[v] = 1;
                return v;
            }
        }
        _remesh.position[v] = old;
        _remesh.place[v].face = oldFace;
        return -1;
    }
};

} // namespace ccdm
} // namespace vcg

#endif
