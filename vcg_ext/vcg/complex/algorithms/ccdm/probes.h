// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_PROBES_H
#define VCG_CCDM_PROBES_H

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/patch_schedule.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>

namespace vcg {
namespace ccdm {

/// Points of the input, off the features, that watch how far the remesh passes by: the input's vertices,
/// and points along edges that are long and sharp enough for the largest distance to lie between their
/// ends.
class Probes
{
public:
    struct Probe {
        Point point;
        int face;
        int vertex; ///< an input vertex at or near it
    };

    Probes(const Model &model, const Remesh &remesh, Workers &workers)
        : _model(model), _remesh(remesh), _workers(workers)
    {
        Lay();
    }

    int Count() const { return static_cast<int>(_probe.size()); }
    const Probe &operator[](int r) const { return _probe[r]; }
    /// Triangle of the remesh nearest to a probe, as of the last Find; -1: it lies on no sheet that was found.
    int Owner(int r) const { return _owner[r]; }
    /// Distance of a probe from its owner.
    double Distance(int r) const { return _distance[r]; }
    /// The largest distance, as of the last Find.
    double LargestDistance() const
    {
        return _distance.empty() ? 0 : *std::max_element(_distance.begin(), _distance.end());
    }
    /// Probes of a triangle as of the last Find: Owned(k) for k in [First(t), First(t + 1)).
    int First(int t) const { return _first[t]; }
    int Owned(int k) const { return _owned[k]; }

    Foot NearestOnRemesh(int t, const Point &p) const
    {
        const Triangle &T = _remesh.mesh.triangle[t];
        const Point &a = _remesh.position[T.v[0]];
        return NearestOnTriangle(a, _remesh.position[T.v[1]] - a, _remesh.position[T.v[2]] - a, p);
    }

    /// Nearest triangle of a probe and its squared distance, by descent from a vertex of the remesh that lies close
    /// by on the surface: first from vertex to vertex, then among the triangles around the last.
    std::pair<int, double> Locate(int r, int v) const
    {
        return Locate(r, v, [](int) { return true; });
    }
    /// The same over vertices for which open(vertex) is true.
    template <class Open>
    std::pair<int, double> Locate(int r, int v, const Open &open) const
    {
        const Point &p = _probe[r].point;
        double best = SquaredNorm(_remesh.position[v] - p);
        for (bool moved = true; moved;) {
            moved = false;
            _remesh.mesh.VisitSpokes(v, [&](int o, Side) {
                const double d = SquaredNorm(_remesh.position[o] - p);
                if (d < best && open(o)) {
                    best = d;
                    v = o;
                    moved = true;
                }
                return !moved;
            });
        }
        std::pair<int, double> nearest = {-1, 1e300};
        _remesh.mesh.VisitSpokes(v, [&](int, Side s) {
            const double d = NearestOnRemesh(SideTriangle(s), p).squaredDistance;
            if (d < nearest.second)
                nearest = {SideTriangle(s), d};
            return nearest.second > 0;
        });
        return nearest;
    }

    /// Finds every probe's nearest triangle on its sheet.
    void Find()
    {
        const std::vector<int> near = NearVertices();
        _owner.assign(_probe.size(), -1);
        _distance.assign(_probe.size(), 0);
        Chunks::For(_workers, Count(), [&](int first, int last, int) {
            for (int r = first; r < last; ++r)
                if (near[_probe[r].vertex] >= 0) {
                    const auto [owner, squared] = Locate(r, near[_probe[r].vertex]);
                    _owner[r] = owner;
                    _distance[r] = std::sqrt(squared);
                }
        });
        _first.assign(_remesh.mesh.TriangleCount() + 1, 0);
        for (const int t : _owner)
            if (t >= 0)
                ++_first[t + 1];
        for (std::size_t t = 1; t < _first.size(); ++t)
            _first[t] += _first[t - 1];
        _owned.resize(_first.back());
        std::vector<int> fill(_first.begin(), _first.end() - 1);
        for (int r = 0; r < Count(); ++r)
            if (_owner[r] >= 0)
                _owned[fill[_owner[r]]++] = r;
    }

private:
    const Model &_model;
    const Remesh &_remesh;
    Workers &_workers;
    std::vector<Probe> _probe;
    std::vector<int> _owner;
    std::vector<double> _distance;
    std::vector<int> _first, _owned;

    void Lay()
    {
        const Triangulation &m = _model.surface.mesh;
        const std::vector<Point> &x = _model.surface.position;
        std::vector<char> onFeature(x.size(), 0);
        for (int t = 0; t < m.TriangleCount(); ++t)
            for (int e = 0; e < 3; ++e)
                if (m.triangle[t].Constrained(e))
                    onFeature[m.triangle[t].v[Next(e)]] = onFeature[m.triangle[t].v[Prev(e)]] = 1;
        const auto atVertices = [&](int first, int last, std::vector<Probe> &probes) {
            for (int v = first; v < last; ++v)
                if (!onFeature[v] && m.incident[v] >= 0)
                    probes.push_back({x[v], m.incident[v], v});
        };
        const auto onEdges = [&](int first, int last, std::vector<Probe> &probes) {
            m.VisitEdges(first, last, [&](Side s) { LayAlong(s, probes); });
        };
        _probe = Chunks::CollectList<Probe>(_workers, m.VertexCount(), atVertices);
        const std::vector<Probe> more = Chunks::CollectList<Probe>(_workers, m.TriangleCount(), onEdges);
        _probe.insert(_probe.end(), more.begin(), more.end());
    }

    void LayAlong(Side s, std::vector<Probe> &probes) const
    {
        const Triangulation &m = _model.surface.mesh;
        const std::vector<Point> &x = _model.surface.position;
        if (m.Mate(s) == NoSide || m.Constrained(s))
            return;
        const int a = m.Tail(s), b = m.Head(s);
        const double h = 0.5 * _model.density.spacing[a], length = Norm(x[b] - x[a]);
        if (length <= h || TurnAngle(x[a], x[b], x[m.Opposite(s)], x[m.Opposite(m.Mate(s))]) < 0.3)
            return;
        const int parts = static_cast<int>(std::min(length / h, 1000.0)) + 1;
        for (int k = 1; k < parts; ++k)
            probes.push_back(
                {x[a] + (x[b] - x[a]) * (static_cast<double>(k) / parts), SideTriangle(s), 2 * k < parts ? a : b});
    }

    // The bits of numbers that are not negative are in the order of the numbers.
    static std::uint32_t OrderedBits(float x)
    {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &x, sizeof bits);
        return bits;
    }

    static void Lower(std::atomic<std::uint64_t> &least, std::uint64_t x)
    {
        std::uint64_t seen = least.load(std::memory_order_relaxed);
        while (x < seen && !least.compare_exchange_weak(seen, x, std::memory_order_relaxed)) {
        }
    }

    // A vertex of the remesh close to each vertex of the input, spread along the input's edges.
    std::vector<int> NearVertices() const
    {
        const Triangulation &m = _model.surface.mesh;
        // Of each, the squared distance to the nearest vertex and its number: the least, in whatever order it is found.
        constexpr std::uint64_t none = ~std::uint64_t(0);
        std::vector<std::atomic<std::uint64_t>> least(m.VertexCount());
        for (std::atomic<std::uint64_t> &l : least)
            l.store(none, std::memory_order_relaxed);
        Chunks::For(_workers, _remesh.VertexCount(), [&](int first, int last, int) {
            for (int v = first; v < last; ++v)
                for (const int r : m.triangle[_remesh.place[v].face].v) {
                    const double squared = SquaredNorm(_remesh.position[v] - _model.surface.position[r]);
                    const std::uint64_t high = OrderedBits(static_cast<float>(squared));
                    Lower(least[r], high << 32 | static_cast<std::uint32_t>(v));
                }
        });
        std::vector<int> near(m.VertexCount(), -1), queue;
        for (int r = 0; r < m.VertexCount(); ++r) {
            const std::uint64_t found = least[r].load(std::memory_order_relaxed);
            if (found == none)
                continue;
            near[r] = static_cast<int>(static_cast<std::uint32_t>(found));
            queue.push_back(r);
        }
        for (std::size_t k = 0; k < queue.size(); ++k)
            m.VisitSpokes(queue[k], [&](int o, Side) {
                if (near[o] < 0) {
                    near[o] = near[queue[k]];
                    queue.push_back(o);
                }
                return true;
            });
        return near;
    }
};

} // namespace ccdm
} // namespace vcg

#endif
