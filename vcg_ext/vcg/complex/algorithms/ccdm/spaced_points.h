// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_SPACED_POINTS_H
#define VCG_CCDM_SPACED_POINTS_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <vcg/complex/algorithms/ccdm/geometry.h>

namespace vcg {
namespace ccdm {

/// Points in cubic cells that are as wide as each point's own spacing, to the next power of two.
class SpacedPoints
{
public:
    /// Number `i` is at point[i] and has spacing[i] > 0.
    SpacedPoints(const std::vector<Point> &point, const std::vector<double> &spacing)
    {
        // Neighbours in the list are often neighbours in space: what is sorted is runs in one cell.
        std::vector<Run> runs;
        for (std::size_t i = 0; i < point.size(); ++i) {
            const int level = LevelOf(spacing[i]);
            const double size = std::ldexp(1.0, level);
            const Point &p = point[i];
            const std::uint64_t key = Key(level, Cell(p[0], size), Cell(p[1], size), Cell(p[2], size));
            if (runs.empty() || runs.back().key != key)
                runs.push_back({key, static_cast<int>(i), 0});
            ++runs.back().count;
            if (std::find(_level.begin(), _level.end(), level) == _level.end())
                _level.push_back(level);
        }
        std::sort(_level.begin(), _level.end());
        std::sort(runs.begin(), runs.end(),
                  [](const Run &a, const Run &b) { return a.key != b.key ? a.key < b.key : a.first < b.first; });
        _item.reserve(point.size());
        std::vector<Run> cells;
        for (const Run &r : runs) {
            if (cells.empty() || cells.back().key != r.key)
                cells.push_back({r.key, static_cast<int>(_item.size()), 0});
            cells.back().count += r.count;
            for (int i = r.first; i < r.first + r.count; ++i)
                _item.push_back(i);
        }
        std::size_t places = 16;
        while (places < 2 * cells.size())
            places *= 2;
        _slot.assign(places, {0, -1, 0});
        for (const Run &c : cells)
            _slot[Slot(c.key)] = c;
    }

    /// Cells that hold points are numbered from 0 to below this, with gaps.
    int CellCount() const { return static_cast<int>(_slot.size()); }
    /// Calls visit(i) for the points of a cell.
    template <class Visit>
    void VisitCell(int cell, const Visit &visit) const
    {
        for (int k = _slot[cell].first; k < _slot[cell].first + _slot[cell].count; ++k)
            visit(_item[k]);
    }

    /// Calls visit(cell) for the cells of points that may lie within `reach` of p, of spacings from about `reach`
    /// upwards.
    template <class Visit>
    void VisitCellsNear(const Point &p, double reach, const Visit &visit) const
    {
        for (const int level : _level) {
            const double size = std::ldexp(1.0, level);
            if (size < reach)
                continue;
            std::int64_t low[3], high[3];
            for (int k = 0; k < 3; ++k) {
                low[k] = Cell(p[k] - reach, size);
                high[k] = Cell(p[k] + reach, size);
            }
            for (std::int64_t x = low[0]; x <= high[0]; ++x)
                for (std::int64_t y = low[1]; y <= high[1]; ++y)
                    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                        const std::size_t at = Slot(Key(level, x, y, z));
                        if (_slot[at].count > 0)
                            visit(static_cast<int>(at));
                    }
        }
    }

    /// Calls visit(i) for those points.
    template <class Visit>
    void VisitNear(const Point &p, double reach, const Visit &visit) const
    {
        VisitCellsNear(p, reach, [&](int cell) { VisitCell(cell, visit); });
    }

private:
    struct Run {
        std::uint64_t key;
        int first; // -1: free
        int count;
    };
    std::vector<int> _level;
    std::vector<int> _item; // by cell
    std::vector<Run> _slot; // cells, hashed

    static int LevelOf(double spacing) { return static_cast<int>(std::ceil(std::log2(std::max(spacing, 1e-12)))); }
    static std::int64_t Cell(double x, double size) { return static_cast<std::int64_t>(std::floor(x / size)); }
    // Two cells of one key do no harm: callers look at distances.
    static std::uint64_t Key(int level, std::int64_t x, std::int64_t y, std::int64_t z)
    {
        std::uint64_t h = static_cast<std::uint64_t>(level + 64) * 0x9e3779b97f4a7c15ULL;
        for (const std::int64_t c : {x, y, z}) {
            h = (h ^ static_cast<std::uint64_t>(c)) * 0xbf58476d1ce4e5b9ULL;
            h ^= h >> 29;
        }
        return h;
    }
    // Where a cell is, or would be.
    std::size_t Slot(std::uint64_t key) const
    {
        std::size_t k = key & (_slot.size() - 1);
        while (_slot[k].first >= 0 && _slot[k].key != key)
            k = (k + 1) & (_slot.size() - 1);
        return k;
    }
};

} // namespace ccdm
} // namespace vcg

#endif
