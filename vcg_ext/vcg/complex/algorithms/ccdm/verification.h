// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_VERIFICATION_H
#define VCG_CCDM_VERIFICATION_H

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include <vcg/complex/algorithms/ccdm/parallel.h>
#include <vcg/complex/algorithms/ccdm/triangulation.h>

namespace vcg {
namespace ccdm {

/// Proves a triangulation from its tables alone: live indices, symmetric gluing with equal ends, no
/// vertex twice in a triangle, no repeated edge, one fan a vertex; and counts its topology.
class Verification
{
public:
    TopologyCounts counts;
    std::string fault; ///< the first thing found wrong; empty when every check passed

    Verification(const Triangulation &mesh, Workers &workers) : _mesh(mesh), _workers(workers)
    {
        if (!CheckTriangles() || !CheckVertices())
            return;
        counts.euler = counts.vertices - counts.edges + counts.faces;
        CountComponents();
        if (_boundarySides > 0)
            CountBoundaryLoops();
    }

private:
    const Triangulation &_mesh;
    Workers &_workers;
    std::vector<std::atomic<int>> _corners; // triangles that name each vertex
    int _boundarySides = 0;

    // What a run of triangles or vertices comes to.
    struct Part {
        int live = 0, boundarySides = 0;
        const char *fault = nullptr;
        Star star;

        bool Fail(const char *what)
        {
            if (fault == nullptr)
                fault = what;
            return false;
        }
    };

    // Adds up the parts of `count` elements; check(element, part) returns false to skip the rest of its part.
    template <class Check>
    Part Sum(int count, const Check &check)
    {
        const auto look = [&](int first, int last, Part &part) {
            for (int k = first; k < last && check(k, part);)
                ++k;
        };
        Part sum;
        for (const Part &p : Chunks::Collect<Part>(_workers, count, look)) {
            sum.live += p.live;
            sum.boundarySides += p.boundarySides;
            if (p.fault != nullptr)
                sum.Fail(p.fault);
        }
        if (sum.fault != nullptr)
            fault = sum.fault;
        return sum;
    }

    bool CheckTriangles()
    {
        _corners = std::vector<std::atomic<int>>(_mesh.VertexCount());
        const Part sum =
            Sum(_mesh.TriangleCount(), [&](int t, Part &p) { return _mesh.triangle[t].dead || CheckTriangle(t, p); });
        counts.faces = sum.live;
        counts.edges = (3 * sum.live + sum.boundarySides) / 2;
        _boundarySides = sum.boundarySides;
        return fault.empty();
    }

    bool CheckTriangle(int t, Part &p)
    {
        const Triangle &T = _mesh.triangle[t];
        ++p.live;
        for (int e = 0; e < 3; ++e) {
            if (T.v[e] < 0 || T.v[e] >= _mesh.VertexCount() || _mesh.incident[T.v[e]] < 0)
                return p.Fail("a triangle names a vertex that does not exist");
            _corners[T.v[e]].fetch_add(1, std::memory_order_relaxed);
        }
        for (int e = 0; e < 3; ++e) {
            if (T.v[e] == T.v[Next(e)])
                p.Fail("a triangle names a vertex twice");
            const Side s = MakeSide(t, e), mate = T.n[e];
            if (mate == NoSide) {
                ++p.boundarySides;
                continue;
            }
            if (mate < 0 || SideTriangle(mate) >= _mesh.TriangleCount() || SideEdge(mate) > 2 ||
                _mesh.triangle[SideTriangle(mate)].dead)
                return p.Fail("a side is glued to nothing");
            if (_mesh.Mate(mate) != s)
                p.Fail("gluing is not symmetric");
            if (std::minmax(_mesh.Tail(s), _mesh.Head(s)) != std::minmax(_mesh.Tail(mate), _mesh.Head(mate)))
                p.Fail("glued sides have different ends");
            if (_mesh.Constrained(s) != _mesh.Constrained(mate))
                p.Fail("a feature is marked on one side only");
        }
        return true;
    }

    // One fan a vertex: the star found by walking holds every triangle that names the vertex; then no edge is
    // repeated exactly when the outer vertices of each star differ.
    bool CheckVertices()
    {
        const Part sum = Sum(_mesh.VertexCount(), [&](int v, Part &p) {
            const int corners = _corners[v].load(std::memory_order_relaxed);
            if (_mesh.incident[v] < 0)
                return corners == 0 || p.Fail("a dead vertex is in use");
            ++p.live;
            return CheckStar(v, corners, p);
        });
        counts.vertices = sum.live;
        return fault.empty();
    }

    bool CheckStar(int v, int corners, Part &p) const
    {
        if (_mesh.incident[v] >= _mesh.TriangleCount())
            return p.Fail("a vertex names a triangle that does not exist");
        const Triangle &T = _mesh.triangle[_mesh.incident[v]];
        if (T.dead || T.v[T.IndexOf(v)] != v)
            return p.Fail("a vertex names a triangle that is not its own");
        _mesh.GatherStar(v, p.star);
        if (p.star.Triangles() != corners)
            p.Fail("a vertex has more than one fan");
        std::vector<int> &outer = p.star.outer;
        std::sort(outer.begin(), outer.end());
        if (std::adjacent_find(outer.begin(), outer.end()) != outer.end())
            p.Fail("an edge is repeated");
        return true;
    }

    // Components and orientability by walking over the triangles.
    void CountComponents()
    {
        std::vector<signed char> turn(_mesh.triangle.size(), 0);
        std::vector<int> stack;
        for (int t0 = 0; t0 < _mesh.TriangleCount(); ++t0) {
            if (_mesh.triangle[t0].dead || turn[t0] != 0)
                continue;
            ++counts.components;
            turn[t0] = 1;
            stack.assign(1, t0);
            while (!stack.empty()) {
                const int t = stack.back();
                stack.pop_back();
                for (int e = 0; e < 3; ++e) {
                    const Side mate = _mesh.triangle[t].n[e];
                    if (mate == NoSide)
                        continue;
                    const int u = SideTriangle(mate);
                    const auto want = static_cast<signed char>(_mesh.Coherent(MakeSide(t, e)) ? turn[t] : -turn[t]);
                    if (turn[u] == 0) {
                        turn[u] = want;
                        stack.push_back(u);
                    } else if (turn[u] != want) {
                        counts.orientable = false;
                    }
                }
            }
        }
    }

    void CountBoundaryLoops()
    {
        std::vector<char> seen(3 * _mesh.triangle.size(), 0);
        const auto at = [&](Side s) -> char & {
            return seen[3 * static_cast<std::size_t>(SideTriangle(s)) + SideEdge(s)];
        };
        for (int t = 0; t < _mesh.TriangleCount(); ++t)
            for (int e = 0; e < 3; ++e) {
                Side s = MakeSide(t, e);
                if (_mesh.triangle[t].dead || _mesh.triangle[t].n[e] != NoSide || at(s) != 0)
                    continue;
                ++counts.boundaryLoops;
                int pivot = _mesh.Head(s);
                while (at(s) == 0) {
                    at(s) = 1;
                    // Turn around the pivot to the other boundary edge of its fan.
                    int u = SideTriangle(s), i = _mesh.triangle[u].IndexOf(pivot), j = 3 - i - SideEdge(s);
                    while (_mesh.triangle[u].n[j] != NoSide) {
                        const Side x = _mesh.triangle[u].n[j];
                        u = SideTriangle(x);
                        i = _mesh.triangle[u].IndexOf(pivot);
                        j = 3 - i - SideEdge(x);
                    }
                    s = MakeSide(u, j);
                    pivot = _mesh.triangle[u].v[3 - i - j];
                }
            }
    }
};

inline Verification VerifyTriangulation(const Triangulation &mesh)
{
    Workers alone(1);
    return Verification(mesh, alone);
}

} // namespace ccdm
} // namespace vcg

#endif
