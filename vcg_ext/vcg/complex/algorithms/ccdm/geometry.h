// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_GEOMETRY_H
#define VCG_CCDM_GEOMETRY_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <vcg/complex/algorithms/ccdm/parallel.h>
#include <vcg/complex/algorithms/ccdm/triangulation.h>

namespace vcg {
namespace ccdm {

/// Asks for the memory at an address, which will be read soon. Without effect where the compiler has no means.
inline void Prefetch([[maybe_unused]] const void *address)
{
#if defined(__GNUC__)
    __builtin_prefetch(address);
#endif
}

constexpr double Pi = 3.14159265358979323846;

inline double Dot(const Point &a, const Point &b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point Cross(const Point &a, const Point &b)
{
    return Point(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
inline double SquaredNorm(const Point &a)
{
    return Dot(a, a);
}
inline double Norm(const Point &a)
{
    return std::sqrt(SquaredNorm(a));
}
inline Point Normalized(const Point &a)
{
    const double l = Norm(a);
    return l > 0 ? a / l : a;
}

/// Squared distance of p from the segment from a to a + d.
inline double SegmentSquaredDistance(const Point &p, const Point &a, const Point &d)
{
    const Point w = p - a;
    const double dd = SquaredNorm(d);
    const double s = dd > 0 ? std::clamp(Dot(w, d) / dd, 0.0, 1.0) : 0.0;
    return SquaredNorm(w - d * s);
}

/// Angle in radians between the normals of two triangles (a, b, p) and (a, b, q) that share the edge
/// ab, 0 when they are flat; whatever their orientation. Zero if one has no area.
inline double TurnAngle(const Point &a, const Point &b, const Point &p, const Point &q)
{
    const Point e = b - a, n1 = Cross(e, p - a), n2 = Cross(q - a, e);
    return std::atan2(Norm(Cross(n1, n2)), Dot(n1, n2));
}

/// Cosine of the smallest angle of the triangle with these squared lengths of the sides: less is better; 1 for one
/// with a side of no length.
inline double LargestCosine(double la, double lb, double lc)
{
    // It lies opposite the shortest side. Sorted without branches, which nothing could foretell.
    const double low = std::min(la, lb), high = std::max(la, lb);
    const double shortest = std::min(low, lc), product = std::max(low, std::min(high, lc)) * std::max(high, lc);
    return product > 0 ? (la + lb + lc - 2 * shortest) / (2 * std::sqrt(product)) : 1;
}

inline double LargestCosine(const Point &a, const Point &b, const Point &c)
{
    return LargestCosine(SquaredNorm(c - b), SquaredNorm(a - c), SquaredNorm(b - a));
}

/// [FB99] aspect ratio of a triangle, 2 sqrt(3) area / (half perimeter * longest edge): 1 for an
/// equilateral one, 0 for a degenerate one.
inline double AspectRatio(const Point &a, const Point &b, const Point &c)
{
    const double ab = Norm(b - a), bc = Norm(c - b), ca = Norm(a - c);
    const double scale = (ab + bc + ca) * std::max({ab, bc, ca});
    return scale > 0 ? 2 * std::sqrt(3.0) * Norm(Cross(b - a, c - a)) / scale : 0;
}

/// A point of a triangle nearest to some other point.
struct Foot {
    Point point;
    double weight[3];
    double squaredDistance;
};

/// Point nearest to p of the triangle at `origin` with sides e1 and e2, found by the Voronoi region
/// that p lies in (Ericson 2005, "Real-time collision detection", section 5.1.5).
inline Foot NearestOnTriangle(const Point &origin, const Point &e1, const Point &e2, const Point &p)
{
    const auto ratio = [](double a, double b) { return b > 0 ? a / b : 0; };
    const Point ap = p - origin, bp = ap - e1, cp = ap - e2;
    const double d1 = Dot(e1, ap), d2 = Dot(e2, ap), d3 = Dot(e1, bp), d4 = Dot(e2, bp), d5 = Dot(e1, cp),
                 d6 = Dot(e2, cp);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4, sum = va + vb + vc;
    double w1 = sum > 0 ? vb / sum : 0, w2 = sum > 0 ? vc / sum : 0;
    const auto set = [&](double a, double b) {
        w1 = a;
        w2 = b;
    };
    // Most often the foot lies inside, and one test tells that instead of nine.
    if (!(std::min({va, vb, vc}) > 0)) {
        if (d1 <= 0 && d2 <= 0) {
            set(0, 0);
        } else if (d3 >= 0 && d4 <= d3) {
            set(1, 0);
        } else if (d6 >= 0 && d5 <= d6) {
            set(0, 1);
        } else if (vc <= 0 && d1 >= 0 && d3 <= 0) {
            set(ratio(d1, d1 - d3), 0);
        } else if (vb <= 0 && d2 >= 0 && d6 <= 0) {
            set(0, ratio(d2, d2 - d6));
        } else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
            const double s = ratio(d4 - d3, (d4 - d3) + (d5 - d6));
            set(1 - s, s);
        }
    }
    Foot r;
    r.point = origin + e1 * w1 + e2 * w2;
    r.weight[0] = 1 - w1 - w2;
    r.weight[1] = w1;
    r.weight[2] = w2;
    r.squaredDistance = SquaredNorm(p - r.point);
    return r;
}

/// Morton code of a point of the unit cube, 21 bits an axis.
inline std::uint64_t MortonCode(const Point &unit)
{
    auto spread = [](double x) {
        auto v = static_cast<std::uint64_t>(std::clamp(x, 0.0, 1.0) * 2097151.0);
        v = (v | v << 32) & 0x1f00000000ffffULL;
        v = (v | v << 16) & 0x1f0000ff0000ffULL;
        v = (v | v << 8) & 0x100f00f00f00f00fULL;
        v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
        return (v | v << 2) & 0x1249249249249249ULL;
    };
    return spread(unit[0]) | spread(unit[1]) << 1 | spread(unit[2]) << 2;
}

/// Axis-aligned box around points.
struct Bounds {
    Point low = Point(0, 0, 0), high = Point(0, 0, 0);
    bool empty = true;

    void Add(const Point &p)
    {
        for (int k = 0; k < 3; ++k) {
            low[k] = empty ? p[k] : std::min(low[k], p[k]);
            high[k] = empty ? p[k] : std::max(high[k], p[k]);
        }
        empty = false;
    }
    double Diagonal() const { return Norm(high - low); }
};

/// Indices of the points in the order of a space-filling curve through their common cube.
inline std::vector<int> SpatialOrder(const std::vector<Point> &points, Workers &workers)
{
    Bounds box;
    for (const Point &p : points)
        box.Add(p);
    const Point extent = box.high - box.low;
    const double size = std::max({extent[0], extent[1], extent[2], 1e-300});
    std::vector<std::pair<std::uint64_t, int>> keyed(points.size());
    Chunks::For(workers, static_cast<int>(points.size()), [&](int first, int last, int) {
        for (int i = first; i < last; ++i)
            keyed[i] = {MortonCode((points[i] - box.low) / size), i};
    });
    // Points in one cell go by their coordinates, so that the order does not depend on the numbering.
    SortInParts(workers, keyed, [&](const auto &a, const auto &b) {
        if (a.first != b.first)
            return a.first < b.first;
        const Point &p = points[a.second], &q = points[b.second];
        for (int k = 0; k < 3; ++k)
            if (p[k] != q[k])
                return p[k] < q[k];
        return a.second < b.second;
    });
    std::vector<int> order(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        order[i] = keyed[i].second;
    return order;
}

/// The only random generator of the remesher: 64-bit state, the same sequence on every platform.
/// (Steele, Lea, Flood 2014: "Fast splittable pseudorandom number generators".)
class Random
{
public:
    explicit Random(std::uint64_t seed) : _state(seed) {}
    std::uint64_t Bits()
    {
        std::uint64_t z = (_state += 0x9e3779b97f4a7c15ULL);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    /// Uniform in [0, 1).
    double Unit() { return static_cast<double>(Bits() >> 11) * 0x1p-53; }

private:
    std::uint64_t _state;
};

} // namespace ccdm
} // namespace vcg

#endif
