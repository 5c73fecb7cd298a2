// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_PATCH_SCHEDULE_H
#define VCG_CCDM_PATCH_SCHEDULE_H

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/parallel.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>

namespace vcg {
namespace ccdm {

/// The edges between two triangles for which test(side) is true, each by its side of the lower number, in order.
template <class Test>
std::vector<Side> InnerEdgesWhere(const Triangulation &m, Workers &workers, const Test &test)
{
    const auto look = [&](int first, int last, std::vector<Side> &found) {
        m.VisitEdges(first, last, [&](Side s) {
            if (m.Mate(s) != NoSide && test(s))
                found.push_back(s);
        });
    };
    return Chunks::CollectList<Side>(workers, m.TriangleCount(), look);
}

/// Patches of a mesh that can be worked on at the same time. Vertices are numbered along a space-filling
/// curve, so a range of numbers is a patch of the surface.
template <int Vertices>
struct PatchesOf {
    static constexpr int Size = Vertices;
    static int Of(int v) { return v / Size; }
    static int Count(int vertices) { return (vertices + Size - 1) / Size; }
};
using Patches = PatchesOf<1024>;

/// Larger patches, for work that reaches several rings around.
using Regions = PatchesOf<32 * Patches::Size>;

/// The patch that holds all four vertices of an edge's two triangles; -1 if none does, or if the edge has
/// one triangle only.
inline int PatchOfHinge(const Remesh &r, Side s)
{
    const Side mate = r.mesh.Mate(s);
    if (mate == NoSide)
        return -1;
    const int patch = Patches::Of(r.mesh.Opposite(s));
    const bool inside = Patches::Of(r.mesh.Opposite(mate)) == patch && Patches::Of(r.mesh.Tail(s)) == patch &&
                        Patches::Of(r.mesh.Head(s)) == patch;
    return inside ? patch : -1;
}

/// A flip: edge pq has become edge ab.
struct Flipped {
    int p, q, a, b;
};

/// Runs work on the vertices and edges of a remesh, patch by patch on several threads, in an order that
/// does not depend on how many there are.
class PatchSchedule
{
public:
    PatchSchedule(const Remesh &remesh, Workers &workers) : _remesh(remesh), _workers(workers) {}

    /// The edges have changed since the last call of ForVertices.
    void Changed() { _valid = false; }

    /// They have changed by flips: these, and any that have all four vertices in one patch.
    void Changed(const std::vector<Flipped> &flips)
    {
        if (!_valid)
            return;
        bool other = false;
        for (const Flipped &f : flips) {
            other = Count(f.p, f.q, -2) || other;
            other = Count(f.a, f.b, 2) || other;
        }
        for (const Flipped &f : flips)
            for (const int v : {f.p, f.q, f.a, f.b})
                _border[v].store(AtBorder(v), std::memory_order_relaxed);
        if (other)
            Separate();
    }

    /// Calls work(vertex, worker) once for every vertex. It may read the star of the vertex and change the
    /// vertex. First come the vertices inside the patches, all patches at a time; then those at their
    /// borders, patches that touch each other at different times.
    template <class Work>
    void ForVertices(Work work)
    {
        FindBorders();
        const auto run = [&](int patch, std::uint8_t border, int worker) {
            const int end = std::min((patch + 1) * Patches::Size, _remesh.VertexCount());
            for (int v = patch * Patches::Size; v < end; ++v)
                if (_border[v].load(std::memory_order_relaxed) == border)
                    work(v, worker);
        };
        _workers.For(Patches::Count(_remesh.VertexCount()), [&](int patch, int worker) { run(patch, 0, worker); });
        for (const std::vector<int> &patches : _apart)
            _workers.For(static_cast<int>(patches.size()), [&](int i, int worker) { run(patches[i], 1, worker); });
    }

    /// Calls flip(side) for the inner edges for which wanted(side) was true, both judged by the side in the
    /// triangle of the lower number. `flip` may read the stars of the four vertices around the edge, and
    /// change its two triangles.
    template <class Wanted, class Flip>
    void ForEdges(Wanted wanted, Flip flip)
    {
        const Triangulation &m = _remesh.mesh;
        _list.resize(Chunks::Count(m.TriangleCount()));
        Chunks::For(_workers, m.TriangleCount(), [&](int first, int last, int chunk) {
            std::vector<Side> &list = _list[chunk];
            list.clear();
            for (int t = first; t < last; ++t)
                for (int e = 0; e < 3; ++e) {
                    const Side s = MakeSide(t, e);
                    if (m.Mate(s) > s && wanted(s))
                        list.push_back(s);
                }
        });
        std::vector<std::vector<Side>> inside(Patches::Count(_remesh.VertexCount())), moved(inside.size());
        std::vector<Side> rest;
        for (const std::vector<Side> &list : _list)
            for (const Side s : list) {
                const int patch = PatchOfHinge(_remesh, s);
                (patch >= 0 ? inside[patch] : rest).push_back(s);
            }
        _workers.For(static_cast<int>(inside.size()), [&](int patch, int) {
            for (const Side s : inside[patch])
                if (PatchOfHinge(_remesh, s) == patch)
                    flip(s);
                else
                    moved[patch].push_back(s);
        });
        for (const std::vector<Side> &sides : moved)
            rest.insert(rest.end(), sides.begin(), sides.end());
        std::vector<Flipped> flipped;
        for (const Side s : rest) {
            if (m.Mate(s) == NoSide)
                continue;
            const Flipped edge = {m.Tail(s), m.Head(s), m.Opposite(s), m.Opposite(m.Mate(s))};
            flip(s);
            if (m.Head(s) != edge.q)
                flipped.push_back(edge);
        }
        Changed(flipped);
    }

private:
    const Remesh &_remesh;
    Workers &_workers;
    bool _valid = false;
    int _size = 0;
    std::unique_ptr<std::atomic<std::uint8_t>[]> _border; // 1: has a neighbour in another patch
    std::vector<std::vector<int>> _apart;                 // patches of each set have no edge between them
    std::vector<std::vector<Side>> _list;

    using Pair = std::pair<int, int>;
    std::map<Pair, int> _touching; // sides of triangles that run from one patch to the other

    void FindBorders()
    {
        if (_valid)
            return;
        const int count = _remesh.VertexCount();
        if (_size != count)
            _border = std::make_unique<std::atomic<std::uint8_t>[]>(static_cast<std::size_t>(count));
        _size = count;
        Chunks::For(_workers, count, [&](int first, int last, int) {
            for (int v = first; v < last; ++v)
                _border[v].store(0, std::memory_order_relaxed);
        });
        const std::vector<Triangle> &triangle = _remesh.mesh.triangle;
        const int triangles = _remesh.mesh.TriangleCount();
        const auto look = [&](int first, int last, std::vector<Pair> &pairs) {
            for (int t = first; t < last; ++t)
                for (int e = 0; e < 3; ++e) {
                    const int v = triangle[t].v[e], w = triangle[t].v[Next(e)];
                    const int p = Patches::Of(v), q = Patches::Of(w);
                    if (p == q)
                        continue;
                    _border[v].store(1, std::memory_order_relaxed);
                    _border[w].store(1, std::memory_order_relaxed);
                    pairs.emplace_back(std::min(p, q), std::max(p, q));
                }
        };
        _touching.clear();
        for (const Pair &pair : Chunks::CollectList<Pair>(_workers, triangles, look))
            ++_touching[pair];
        Separate();
        _valid = true;
    }

    // Counts an edge's sides between two patches. Whether patches have met or parted.
    bool Count(int v, int w, int sides)
    {
        const int p = Patches::Of(v), q = Patches::Of(w);
        if (p == q)
            return false;
        int &count = _touching[{std::min(p, q), std::max(p, q)}];
        const bool before = count > 0;
        count += sides;
        return before != (count > 0);
    }

    std::uint8_t AtBorder(int v) const
    {
        bool border = false;
        _remesh.mesh.VisitSpokes(v, [&](int o, Side) {
            border = Patches::Of(o) != Patches::Of(v);
            return !border;
        });
        return border ? 1 : 0;
    }

    // Colours the patches so that no two that touch have the same colour, each with the first that is free.
    void Separate()
    {
        const int patches = Patches::Count(_size);
        std::vector<std::vector<int>> below(patches);
        for (const auto &[pair, sides] : _touching)
            if (sides > 0)
                below[pair.second].push_back(pair.first);
        std::vector<int> colour(patches, 0);
        std::vector<char> taken;
        _apart.clear();
        for (int p = 0; p < patches; ++p) {
            taken.assign(_apart.size() + 1, 0);
            for (const int q : below[p])
                taken[colour[q]] = 1;
            colour[p] = static_cast<int>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
            if (colour[p] == static_cast<int>(_apart.size()))
                _apart.emplace_back();
            _apart[colour[p]].push_back(p);
        }
    }
};

} // namespace ccdm
} // namespace vcg

#endif
