// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_DISJOINT_SETS_H
#define VCG_CCDM_DISJOINT_SETS_H

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace vcg {
namespace ccdm {

/// Sets of the numbers from 0 to below a count, each alone at first (Galler, Fischer 1964).
class DisjointSets
{
public:
    explicit DisjointSets(std::size_t count) : _parent(count) { std::iota(_parent.begin(), _parent.end(), 0); }

    /// The smallest number of the set that holds k.
    int SetOf(int k)
    {
        const auto parent = [&](int i) -> int & { return _parent[static_cast<std::size_t>(i)]; };
        while (parent(k) != k)
            k = parent(k) = parent(parent(k));
        return k;
    }

    void Join(int a, int b)
    {
        a = SetOf(a);
        b = SetOf(b);
        _parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }

private:
    std::vector<int> _parent; // a set's smallest number is its own
};

} // namespace ccdm
} // namespace vcg

#endif
