// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_EXTREMES_H
#define VCG_CCDM_EXTREMES_H

#include <algorithm>
#include <cmath>
#include <vector>

#include <vcg/complex/algorithms/ccdm/probes.h>

namespace vcg {
namespace ccdm {

/// Puts vertices of the remesh onto the tips of the input that the remesh cuts off. Relocation pays no
/// regard to the distance between the surfaces (paper, section 4, limitations), so the distance at a
/// few tips and ridges would otherwise be several times that of the rest.
class ExtremeCapture
{
public:
    ExtremeCapture(const Model &model, Remesh &remesh, Probes &probes) : _model(model), _remesh(remesh), _probe(probes)
    {
    }

    /// Finds the probes furthest from the remesh, those beyond `outlier` times the root mean square
    /// distance, and moves the nearest free vertex onto each, if the star stays well shaped (no
    /// angle under `minAngle` degrees that was not there) and nothing else around gets further away.
    /// Returns the vertices that now sit on a tip.
    std::vector<int> Run(double outlier, double minAngle)
    {
        _probe.Find();
        double squares = 0;
        for (int r = 0; r < _probe.Count(); ++r)
            squares += _probe.Distance(r) * _probe.Distance(r);
        const double limit = outlier * std::sqrt(squares / std::max(_probe.Count(), 1));
        std::vector<int> worst;
        for (int r = 0; r < _probe.Count(); ++r)
            if (_probe.Distance(r) > limit)
                worst.push_back(r);
        std::stable_sort(worst.begin(), worst.end(),
                         [&](int a, int b) { return _probe.Distance(a) > _probe.Distance(b); });
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
    const Model &_model;
    Remesh &_remesh;
    Probes &_probe;
    Star _star;

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
            for (int k = _probe.First(SideTriangle(c)); k < _probe.First(SideTriangle(c) + 1); ++k) {
                double d = 1e300;
                for (const Side other : _star.corner)
                    d = std::min(
                        d, _probe.NearestOnRemesh(SideTriangle(other), _probe[_probe.Owned(k)].point).squaredDistance);
                s.distance = std::max(s.distance, d);
            }
        }
        return s;
    }

    // A part that is cut off by more than so many spacings may get the sharper turn. Measured: the milder one leaves
    // such parts cut off, the sharper one is no gain where less is missing.
    static constexpr double CutOff = 0.45;
    static constexpr double SharpTurn = 100 * Pi / 180, SharperTurn = 120 * Pi / 180;

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
        const Triangle &T = _remesh.mesh.triangle[_probe.Owner(r)];
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
        const bool cutOff = _probe.Distance(r) > CutOff * _model.density.spacing[_probe[r].vertex];
        const double turn = std::max(before.turn, cutOff ? SharperTurn : SharpTurn);
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
            if (after.turn <= turn && after.angle >= std::min(before.angle, minAngle) &&
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
