// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_VERTEX_REMOVAL_H
#define VCG_CCDM_VERTEX_REMOVAL_H

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/parallel.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>

namespace vcg {
namespace ccdm {

/// Takes vertices out of a triangulation by half-edge collapses that keep its topology, its feature
/// curves and the side that its triangles show.
class VertexRemoval
{
public:
    /// All arrays are indexed by vertex; positions do not change. `region`: vertices well inside one region are removed
    /// at the same time as those of the others; empty: all lie in one.
    VertexRemoval(Triangulation &mesh, const std::vector<Point> &position, const std::vector<Place> &place,
                  std::vector<int> region, Workers &workers)
        : _mesh(mesh), _position(position), _place(place), _region(std::move(region)), _workers(workers), _hand(workers)
    {
    }

    /// Removes the vertices that are not in `kept`. Those that cannot go stay, and take the place of
    /// kept free vertices that can, until `wanted` are left or nothing more can go.
    /// False when `progress` (share of the work done) said stop.
    bool RemoveAll(const std::vector<char> &kept, int wanted, const std::function<bool(double)> &progress)
    {
        _stamp.assign(_position.size(), 0);
        _touched.assign(_position.size(), 0);
        std::vector<std::vector<int>> inside, rest(1);
        Divide(kept, inside, rest[0]);
        const std::size_t outside = rest[0].size(), all = Count(inside) + outside;
        const auto report = [&](std::size_t left) {
            return progress(1 - static_cast<double>(left) / static_cast<double>(std::max<std::size_t>(all, 1)));
        };
        if (!RemoveRounds(inside, false, [&](std::size_t left) { return report(left + outside); }))
            return false;
        for (const std::vector<int> &list : inside)
            rest[0].insert(rest[0].end(), list.begin(), list.end());
        std::sort(rest[0].begin(), rest[0].end());
        if (!RemoveRounds(rest, true, report))
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
    struct Candidate {
        double score;
        int target;
        Side side;
    };
    static constexpr Limits Levels[] = {{0.7, 0.05}, {0.3, 0.01}, {0.1, 1e-4}};

    // What a worker needs.
    struct Hand {
        Star star, scratch;
        std::vector<Candidate> candidate;
        int tick = 0;
    };

    Triangulation &_mesh;
    const std::vector<Point> &_position;
    const std::vector<Place> &_place;
    const std::vector<int> _region;
    Workers &_workers;
    PerWorker<Hand> _hand;
    std::vector<int> _stamp;
    std::vector<int> _touched; // in which round, last
    int _round = 0;

    // The vertices to remove: those well inside each region, and the rest. No triangle of the neighbours of the
    // former reaches into another region, and as long as none but the former are removed, none will: what their removal
    // reads and writes is their region's own.
    void Divide(const std::vector<char> &kept, std::vector<std::vector<int>> &inside, std::vector<int> &rest) const
    {
        const int regions = _region.empty() ? 1 : *std::max_element(_region.begin(), _region.end()) + 1;
        enum : char { Inside, NearBorder, AtBorder };
        std::vector<char> where(kept.size(), regions > 1 ? Inside : AtBorder);
        if (regions > 1) {
            for (const Triangle &T : _mesh.triangle)
                if (_region[T.v[0]] != _region[T.v[1]] || _region[T.v[1]] != _region[T.v[2]])
                    where[T.v[0]] = where[T.v[1]] = where[T.v[2]] = AtBorder;
            for (const Triangle &T : _mesh.triangle)
                if (where[T.v[0]] == AtBorder || where[T.v[1]] == AtBorder || where[T.v[2]] == AtBorder)
                    for (const int v : T.v)
                        where[v] = std::max<char>(where[v], NearBorder);
            inside.resize(regions);
        }
        for (std::size_t v = 0; v < kept.size(); ++v)
            if (!kept[v] && _mesh.incident[v] >= 0)
                (where[v] == Inside ? inside[_region[v]] : rest).push_back(static_cast<int>(v));
    }

    static std::size_t Count(const std::vector<std::vector<int>> &lists)
    {
        std::size_t count = 0;
        for (const std::vector<int> &list : lists)
            count += list.size();
        return count;
    }

    // Each round removes an independent set of each list, so that the triangulation thins out evenly; the limits are
    // relaxed when a round no longer gets ahead. What withstands the last limits is removed by ears, if those are
    // wanted, or left in its list. The lists are worked on at the same time.
    template <class Progress>
    bool RemoveRounds(std::vector<std::vector<int>> &doomed, bool byEars, const Progress &progress)
    {
        const std::size_t levels = std::size(Levels) + (byEars ? 1 : 0);
        std::size_t left = Count(doomed);
        for (std::size_t level = 0; left > 0 && level < levels;) {
            const bool ears = level == std::size(Levels);
            const Limits &limits = Levels[std::min(level, std::size(Levels) - 1)];
            ++_round;
            _workers.For(static_cast<int>(doomed.size()),
                         [&](int k, int worker) { RemoveOnce(doomed[k], limits, ears, _hand[worker]); });
            StampAnew();
            const std::size_t before = left;
            left = Count(doomed);
            if (!progress(left))
                return false;
            if (ears ? left == before : (before - left) * 10 < before)
                ++level;
        }
        return true;
    }

    // From now on no worker's stamp is one that another has set before.
    void StampAnew()
    {
        int last = 0;
        for (int k = 0; k < _workers.Count(); ++k)
            last = std::max(last, _hand[k].tick);
        for (int k = 0; k < _workers.Count(); ++k)
            _hand[k].tick = last;
    }

    // Goes through a list once; those that cannot be removed are left in it.
    void RemoveOnce(std::vector<int> &doomed, const Limits &limits, bool ears, Hand &hand)
    {
        std::size_t left = 0;
        for (const int v : doomed) {
            const bool open = _touched[v] != _round;
            if (!(open && (Remove(v, limits, hand) || (ears && RemoveByEars(v, limits, hand)))))
                doomed[left++] = v;
        }
        doomed.resize(left);
    }

    // Free vertices whose neighbourhood is most crowded go first.
    void RemoveOthers(int excess)
    {
        Hand &hand = _hand[0];
        std::vector<std::pair<double, int>> crowd;
        for (int v = 0; v < _mesh.VertexCount(); ++v) {
            if (_mesh.incident[v] < 0 || _place[v].kind != VertexKind::Free)
                continue;
            _mesh.GatherStar(v, hand.star);
            double length = 0;
            for (const int o : hand.star.outer)
                length += Norm(_position[o] - _position[v]);
            crowd.emplace_back(length / static_cast<double>(hand.star.outer.size()), v);
        }
        std::sort(crowd.begin(), crowd.end());
        const Limits limits = {0.3, 0.01};
        for (const auto &c : crowd)
            if (excess > 0 && Remove(c.second, limits, hand))
                --excess;
    }

    bool Remove(int v, const Limits &limits, Hand &hand)
    {
        const Place &place = _place[v];
        if (place.kind == VertexKind::Corner)
            return false;
        _mesh.GatherStar(v, hand.star);
        const int spokes = static_cast<int>(hand.star.outer.size());
        // Candidates in falling order of the worst triangle that they leave.
        hand.candidate.clear();
        for (int k = 0; k < spokes; ++k) {
            const Side s = SpokeSide(hand.star, k);
            if (place.kind == VertexKind::Curve && !_mesh.Constrained(s))
                continue;
            const double score = Score(v, hand.star, k, limits);
            if (score > 0)
                hand.candidate.push_back({score, hand.star.outer[k], s});
        }
        std::sort(hand.candidate.begin(), hand.candidate.end(), [](const Candidate &a, const Candidate &b) {
            return a.score != b.score ? a.score > b.score : a.target < b.target;
        });
        for (const Candidate &c : hand.candidate)
            if (_mesh.MayCollapse(v, c.target, c.side, _stamp, ++hand.tick)) {
                for (const int o : hand.star.outer)
                    _touched[o] = _round;
                _mesh.Collapse(v, c.target, c.side, hand.scratch);
                return true;
            }
        return false;
    }

    // A side of the edge from the centre of a star to its outer vertex k.
    Side SpokeSide(const Star &star, int k) const
    {
        const int n = star.Triangles();
        const Side corner = star.corner[k < n ? k : n - 1];
        const Triangle &T = _mesh.triangle[SideTriangle(corner)];
        const int other = k < n ? star.OuterAfter(k) : star.outer[n - 1];
        return MakeSide(SideTriangle(corner), T.IndexOf(other));
    }

    // Worst aspect ratio of the triangles left when v, the centre of a star, moves to its outer vertex k; 0 if one of
    // them breaks the limits.
    double Score(int v, const Star &star, int k, const Limits &limits) const
    {
        const Point &x = _position[v], &w = _position[star.outer[k]];
        double worst = 1;
        for (int j = 0; j < star.Triangles(); ++j) {
            const int a = star.outer[j], b = star.OuterAfter(j);
            if (a == star.outer[k] || b == star.outer[k])
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
    bool RemoveByEars(int v, const Limits &limits, Hand &hand)
    {
        if (_place[v].kind == VertexKind::Corner)
            return false;
        for (;;) {
            _mesh.GatherStar(v, hand.star);
            const int n = hand.star.Triangles();
            if (n <= 3)
                return false;
            double best = 0;
            Side flip = NoSide;
            for (int k = hand.star.closed ? 0 : 1; k < n; ++k) {
                const Side s = SpokeSide(hand.star, k);
                if (_mesh.Constrained(s) || _mesh.Mate(s) == NoSide)
                    continue;
                const int a = hand.star.outer[k == 0 ? n - 1 : k - 1], p = hand.star.outer[k],
                          b = hand.star.OuterAfter(k);
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
            if (Remove(v, limits, hand))
                return true;
        }
    }
};

} // namespace ccdm
} // namespace vcg

#endif
