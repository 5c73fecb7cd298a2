// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_VERTEX_REMOVAL_H
#define VCG_CCDM_VERTEX_REMOVAL_H

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <vcg/complex/algorithms/ccdm/remesh.h>

namespace vcg {
namespace ccdm {

/// Takes vertices out of a triangulation by half-edge collapses that keep its topology, its feature
/// curves and the side that its triangles show.
class VertexRemoval
{
public:
    /// All three arrays are indexed by vertex; positions do not change.
    VertexRemoval(Triangulation &mesh, const std::vector<Point> &position, const std::vector<Place> &place)
        : _mesh(mesh), _position(position), _place(place)
    {
    }

    /// Removes the vertices that are not in `kept`. Those that cannot go stay, and take the place of
    /// kept free vertices that can, until `wanted` are left or nothing more can go.
    /// False when `progress` (share of the work done) said stop.
    bool RemoveAll(const std::vector<char> &kept, int wanted, const std::function<bool(double)> &progress)
    {
        _stamp.assign(_position.size(), 0);
        _touched.assign(_position.size(), 0);
        std::vector<int> doomed;
        for (std::size_t v = 0; v < kept.size(); ++v)
            if (!kept[v] && _mesh.incident[v] >= 0)
                doomed.push_back(static_cast<int>(v));
        const double total = static_cast<double>(std::max<std::size_t>(doomed.size(), 1));
        auto report = [&](std::size_t left) { return progress(1 - static_cast<double>(left) / total); };
        if (!RemoveRounds(doomed, report))
            return false;
        // What is left is held by topology or by the shape; others may go in its stead.
        int alive = 0;
        for (const int t : _mesh.incident)
            alive += t >= 0;
        if (alive > wanted)
            RemoveOthers(alive - wanted);
        return true;
    }

private:
    struct Limits {
        double cosine;  ///< least cosine between a new triangle's normal and its own old one
        double quality; ///< least aspect ratio of a new triangle
    };

    Triangulation &_mesh;
    const std::vector<Point> &_position;
    const std::vector<Place> &_place;
    Star _star, _scratch;
    std::vector<int> _stamp, _touched;
    int _tick = 0;

    // Each round removes an independent set, so that the triangulation thins out evenly; the limits
    // are relaxed when a round no longer gets ahead.
    template <class Progress>
    bool RemoveRounds(std::vector<int> &doomed, const Progress &progress)
    {
        static const Limits levels[] = {{0.7, 0.05}, {0.3, 0.01}, {0.1, 1e-4}};
        std::size_t level = 0;
        std::vector<int> rest;
        for (int round = 1; !doomed.empty(); ++round) {
            const bool ears = level == std::size(levels);
            const Limits &limits = levels[std::min(level, std::size(levels) - 1)];
            rest.clear();
            for (const int v : doomed) {
                const bool open = _touched[v] != round;
                if (!(open && (Remove(v, limits, round) || (ears && RemoveByEars(v, limits, round)))))
                    rest.push_back(v);
            }
            if (!progress(rest.size()))
                return false;
            const std::size_t removed = doomed.size() - rest.size();
            doomed.swap(rest);
            if (ears && removed == 0)
                break;
            if (!ears && removed * 10 < doomed.size() + removed)
                ++level;
        }
        return true;
    }

    // Free vertices whose neighbourhood is most crowded go first.
    void RemoveOthers(int excess)
    {
        std::vector<std::pair<double, int>> crowd;
        for (int v = 0; v < _mesh.VertexCount(); ++v) {
            if (_mesh.incident[v] < 0 || _place[v].kind != VertexKind::Free)
                continue;
            _mesh.GatherStar(v, _star);
            double length = 0;
            for (const int o : _star.outer)
                length += Norm(_position[o] - _position[v]);
            crowd.emplace_back(length / static_cast<double>(_star.outer.size()), v);
        }
        std::sort(crowd.begin(), crowd.end());
        const Limits limits = {0.3, 0.01};
        for (const auto &c : crowd)
            if (excess > 0 && Remove(c.second, limits, 0))
                --excess;
    }

    bool Remove(int v, const Limits &limits, int round)
    {
        const Place &place = _place[v];
        if (place.kind == VertexKind::Corner)
            return false;
        _mesh.GatherStar(v, _star);
        const int n = _star.Triangles();
        const int spokes = static_cast<int>(_star.outer.size());
        // Candidates in falling order of the worst triangle that they leave.
        _candidate.clear();
        for (int k = 0; k < spokes; ++k) {
            const Side s = SpokeSide(k);
            if (place.kind == VertexKind::Curve && !_mesh.Constrained(s))
                continue;
            const double score = Score(v, k, n, limits);
            if (score > 0)
                _candidate.push_back({score, _star.outer[k], s});
        }
        std::sort(_candidate.begin(), _candidate.end(), [](const Candidate &a, const Candidate &b) {
            return a.score != b.score ? a.score > b.score : a.target < b.target;
        });
        for (const Candidate &c : _candidate)
            if (_mesh.MayCollapse(v, c.target, c.side, _stamp, ++_tick)) {
                if (round > 0)
                    for (const int o : _star.outer)
                        _touched[o] = round;
                _mesh.Collapse(v, c.target, c.side, _scratch);
                return true;
            }
        return false;
    }

    // A side of the edge from the centre of _star to its outer vertex k.
    Side SpokeSide(int k) const
    {
        const int n = _star.Triangles();
        const Side corner = _star.corner[k < n ? k : n - 1];
        const Triangle &T = _mesh.triangle[SideTriangle(corner)];
        const int other = k < n ? _star.OuterAfter(k) : _star.outer[n - 1];
        return MakeSide(SideTriangle(corner), T.IndexOf(other));
    }

    // Worst aspect ratio of the triangles left when v moves to its outer vertex k; 0 if one of them
    // breaks the limits.
    double Score(int v, int k, int n, const Limits &limits) const
    {
        const Point &x = _position[v], &w = _position[_star.outer[k]];
        double worst = 1;
        for (int j = 0; j < n; ++j) {
            const int a = _star.outer[j], b = _star.OuterAfter(j);
            if (a == _star.outer[k] || b == _star.outer[k])
                continue;
            const Point &pa = _position[a], &pb = _position[b];
            const Point before = Cross(pa - x, pb - x), after = Cross(pa - w, pb - w);
            const double area = Norm(after);
            const double longest = std::max({SquaredNorm(pa - w), SquaredNorm(pb - w), SquaredNorm(pb - pa)});
            if (!(area > 0.5 * limits.quality * longest))
                return 0;
            if (Dot(before, after) < limits.cosine * Norm(before) * area)
                return 0;
            worst = std::min(worst, area / longest);
        }
        return worst;
    }

    // Flips edges away from v, the ear with the best new triangle first, until a collapse is legal.
    bool RemoveByEars(int v, const Limits &limits, int round)
    {
        if (_place[v].kind == VertexKind::Corner)
            return false;
        for (;;) {
            _mesh.GatherStar(v, _star);
            const int n = _star.Triangles();
            if (n <= 3)
                return false;
            double best = 0;
            Side flip = NoSide;
            for (int k = _star.closed ? 0 : 1; k < n; ++k) {
                const Side s = SpokeSide(k);
                if (_mesh.Constrained(s) || _mesh.Mate(s) == NoSide)
                    continue;
                const int a = _star.outer[k == 0 ? n - 1 : k - 1], p = _star.outer[k], b = _star.OuterAfter(k);
                const Point &x = _position[v];
                const Point &pa = _position[a], &pp = _position[p], &pb = _position[b];
                const Point old = Cross(pa - x, pp - x) + Cross(pp - x, pb - x);
                const Point ear = Cross(pp - pa, pb - pa), rest = Cross(pa - x, pb - x);
                const double cosine = limits.cosine * Norm(old);
                if (Dot(ear, old) < cosine * Norm(ear) || Dot(rest, old) < cosine * Norm(rest))
                    continue;
                const double quality = std::min(AspectRatio(pa, pp, pb), 4 * AspectRatio(x, pa, pb));
                if (quality > std::max(best, limits.quality) && _mesh.FindEdge(a, b) == NoSide) {
                    best = quality;
                    flip = s;
                }
            }
            if (flip == NoSide)
                return false;
            _mesh.Flip(flip);
            if (Remove(v, limits, round))
                return true;
        }
    }

    struct Candidate {
        double score;
        int target;
        Side side;
    };
    std::vector<Candidate> _candidate;
};

} // namespace ccdm
} // namespace vcg

#endif
