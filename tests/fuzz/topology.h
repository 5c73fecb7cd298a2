// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_TESTS_FUZZ_TOPOLOGY_H
#define CCDM_TESTS_FUZZ_TOPOLOGY_H

#include <array>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// The type of a surface, counted by maps of its edges: shares nothing with the remesher.
namespace fuzz {

struct Topology {
    int vertices = 0, edges = 0, faces = 0, euler = 0, components = 0, boundaryLoops = 0;
    bool orientable = true;
    std::string fault; ///< why it is no surface
};

namespace detail {

class Sets
{
public:
    explicit Sets(std::size_t n) : _parent(n) { std::iota(_parent.begin(), _parent.end(), 0); }
    int Of(int k)
    {
        while (_parent[k] != k)
            k = _parent[k];
        return k;
    }
    /// Whether they were two.
    bool Join(int a, int b)
    {
        a = Of(a);
        b = Of(b);
        _parent[a] = b;
        return a != b;
    }

private:
    std::vector<int> _parent;
};

} // namespace detail

inline Topology CountTopology(const std::vector<std::array<int, 3>> &faces, int vertexCount)
{
    Topology t;
    struct Use {
        int face;
        bool upwards;
    };
    std::map<std::pair<int, int>, std::vector<Use>> edges;
    std::set<int> used;
    for (std::size_t k = 0; k < faces.size(); ++k)
        for (int i = 0; i < 3; ++i) {
            const int a = faces[k][i], b = faces[k][(i + 1) % 3];
            if (a < 0 || a >= vertexCount || a == b) {
                t.fault = "a face names a wrong vertex, or one twice";
                return t;
            }
            used.insert(a);
            edges[std::minmax(a, b)].push_back({static_cast<int>(k), a < b});
        }
    detail::Sets component(faces.size()), corner(3 * faces.size()), loop(static_cast<std::size_t>(vertexCount));
    // Face k as it is, and turned over.
    detail::Sets side(2 * faces.size());
    const auto cornerAt = [&](int face, int v) {
        for (int i = 0; i < 3; ++i)
            if (faces[face][i] == v)
                return 3 * face + i;
        return -1;
    };
    std::map<int, int> boundaryEdgesAt;
    int loops = 0;
    for (const auto &[edge, uses] : edges) {
        if (uses.size() > 2) {
            t.fault = "an edge has more than two faces";
            return t;
        }
        if (uses.size() == 1) {
            ++boundaryEdgesAt[edge.first];
            ++boundaryEdgesAt[edge.second];
            // Each edge that closes a ring makes a loop, as every boundary vertex has two.
            loops += !loop.Join(edge.first, edge.second);
            continue;
        }
        const int f = uses[0].face, g = uses[1].face;
        const int same = uses[0].upwards == uses[1].upwards ? 1 : 0;
        component.Join(f, g);
        side.Join(2 * f, 2 * g + same);
        side.Join(2 * f + 1, 2 * g + 1 - same);
        corner.Join(cornerAt(f, edge.first), cornerAt(g, edge.first));
        corner.Join(cornerAt(f, edge.second), cornerAt(g, edge.second));
    }
    std::map<int, std::set<int>> fans;
    std::set<int> components;
    for (std::size_t k = 0; k < faces.size(); ++k) {
        components.insert(component.Of(static_cast<int>(k)));
        t.orientable = t.orientable && side.Of(static_cast<int>(2 * k)) != side.Of(static_cast<int>(2 * k + 1));
        for (int i = 0; i < 3; ++i)
            fans[faces[k][i]].insert(corner.Of(static_cast<int>(3 * k) + i));
    }
    for (const auto &fan : fans)
        if (fan.second.size() > 1)
            t.fault = "a vertex joins several fans";
    t.vertices = static_cast<int>(used.size());
    t.edges = static_cast<int>(edges.size());
    t.faces = static_cast<int>(faces.size());
    t.euler = t.vertices - t.edges + t.faces;
    t.components = static_cast<int>(components.size());
    t.boundaryLoops = loops;
    return t;
}

} // namespace fuzz

#endif
