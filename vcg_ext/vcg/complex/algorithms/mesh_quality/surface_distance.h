// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_MESH_QUALITY_SURFACE_DISTANCE_H
#define VCG_MESH_QUALITY_SURFACE_DISTANCE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include <vcg/space/point3.h>

namespace vcg {
namespace tri {

/// The triangles of a mesh as plain tables, deleted elements left out.
struct TriangleSoup {
    using Vector = Point3<double>;
    using Face = std::array<int, 3>;
    std::vector<Vector> point;
    std::vector<Face> face;

    template <class MeshType>
    static TriangleSoup From(const MeshType &m)
    {
        TriangleSoup s;
        std::vector<int> index(m.vert.size(), -1);
        for (std::size_t i = 0; i < m.vert.size(); ++i)
            if (!m.vert[i].IsD()) {
                index[i] = static_cast<int>(s.point.size());
                const auto &p = m.vert[i].cP();
                s.point.push_back(Vector(p[0], p[1], p[2]));
            }
        for (const auto &f : m.face)
            if (!f.IsD())
                s.face.push_back(
                    {index[f.cV(0) - m.vert.data()], index[f.cV(1) - m.vert.data()], index[f.cV(2) - m.vert.data()]});
        return s;
    }

    std::vector<char> Referenced() const
    {
        std::vector<char> used(point.size(), 0);
        for (const Face &f : face)
            for (const int v : f)
                used[v] = 1;
        return used;
    }

    /// Bounding box of the vertices that faces use: its lowest and its highest corner.
    std::array<Vector, 2> Box() const
    {
        Vector low(0, 0, 0), high(0, 0, 0);
        bool first = true;
        const std::vector<char> used = Referenced();
        for (std::size_t v = 0; v < point.size(); ++v) {
            if (!used[v])
                continue;
            for (int k = 0; k < 3; ++k) {
                low[k] = first ? point[v][k] : std::min(low[k], point[v][k]);
                high[k] = first ? point[v][k] : std::max(high[k], point[v][k]);
            }
            first = false;
        }
        return {low, high};
    }

    double Diagonal() const
    {
        const auto [low, high] = Box();
        return (high - low).Norm();
    }
};

/// The frame in which surfaces are compared with an original: the middle of its bounding box at the origin, its
/// extent about 1. Single precision is then enough for boxes, wherever the original lies and however small it is.
class UnitFrame
{
public:
    explicit UnitFrame(const TriangleSoup &original)
    {
        const auto [low, high] = original.Box();
        _middle = low + (high - low) / 2.0;
        const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
        // A power of two scales without rounding; at the ends of the range it would not be one.
        if (extent > 0 && std::isfinite(extent))
            _factor = std::ldexp(1.0, -std::clamp(std::ilogb(extent), -1000, 1000));
    }

    TriangleSoup Place(TriangleSoup soup) const
    {
        for (TriangleSoup::Vector &p : soup.point)
            p = (p - _middle) * _factor;
        return soup;
    }

    /// The power of two that the extent is multiplied by.
    double Factor() const { return _factor; }

private:
    TriangleSoup::Vector _middle;
    double _factor = 1;
};

/// Bounding volume hierarchy over triangles for nearest-point queries; boxes in single precision,
/// rounded outwards, so that a node is 32 bytes. The soup is to lie in a UnitFrame.
class TriangleTree
{
public:
    using Vector = TriangleSoup::Vector;

    explicit TriangleTree(const TriangleSoup &soup)
    {
        const std::size_t n = soup.face.size();
        std::vector<Vector> centre(n, Vector(0, 0, 0));
        std::vector<int> order(n);
        std::iota(order.begin(), order.end(), 0);
        for (std::size_t t = 0; t < n; ++t)
            for (const int v : soup.face[t])
                centre[t] += soup.point[v] / 3.0;
        _node.reserve(n);
        if (n > 0)
            Split(soup, centre, order, 0, static_cast<int>(n));
        _corner.reserve(n);
        _plane.reserve(n);
        for (const int t : order) {
            const auto &f = soup.face[t];
            const Corners c = {soup.point[f[0]], soup.point[f[1]], soup.point[f[2]]};
            const Vector normal = (c[1] - c[0]) ^ (c[2] - c[0]);
            _corner.push_back(c);
            const double longest =
                std::max({(c[1] - c[0]).SquaredNorm(), (c[2] - c[1]).SquaredNorm(), (c[0] - c[2]).SquaredNorm()});
            const double squared = normal.SquaredNorm();
            _plane.push_back({normal, squared > NeedleSquared * longest * longest ? squared : 0});
        }
        _face = std::move(order);
    }

    /// Squared distance of p from the triangles; `hint` is the number of a triangle likely to be near
    /// (-1: none) and becomes that of the nearest.
    double SquaredDistance(const Vector &p, int &hint) const
    {
        double best = hint >= 0 ? SquaredDistanceFrom(hint, p) : Unbounded;
        struct Open {
            int node;
            double away;
        };
        Open stack[64];
        int top = 0;
        stack[top++] = {0, Away(_node[0], p)};
        while (top > 0) {
            const Open open = stack[--top];
            if (open.away >= best)
                continue;
            const Node &n = _node[open.node];
            if (n.count > 0) {
                for (int k = n.first; k < n.first + n.count; ++k) {
                    const double d = SquaredDistance(p, _plane[k], _corner[k], best);
                    if (d < best) {
                        best = d;
                        hint = k;
                    }
                }
                continue;
            }
            const Open left = {open.node + 1, Away(_node[open.node + 1], p)},
                       right = {n.first, Away(_node[n.first], p)};
            const bool leftFirst = left.away <= right.away;
            stack[top++] = leftFirst ? right : left;
            stack[top++] = leftFirst ? left : right;
        }
        return best;
    }

    /// Squared distance of p from the triangle of that number, as `hint` above.
    double SquaredDistanceFrom(int number, const Vector &p) const
    {
        return SquaredDistance(p, _plane[number], _corner[number], Unbounded);
    }

    /// Calls visit(face) for the faces whose boxes may overlap that of a triangle.
    template <class Visit>
    void VisitOverlapping(const std::array<Vector, 3> &triangle, const Visit &visit) const
    {
        std::array<double, 3> low, high;
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min({triangle[0][k], triangle[1][k], triangle[2][k]});
            high[k] = std::max({triangle[0][k], triangle[1][k], triangle[2][k]});
        }
        const auto overlaps = [&](const auto &lowOf, const auto &highOf) {
            for (int k = 0; k < 3; ++k)
                if (highOf(k) < low[k] || lowOf(k) > high[k])
                    return false;
            return true;
        };
        int stack[64], top = 0;
        if (!_node.empty())
            stack[top++] = 0;
        while (top > 0) {
            const Node &n = _node[stack[--top]];
            if (!overlaps([&](int k) { return n.low[k]; }, [&](int k) { return n.high[k]; }))
                continue;
            if (n.count == 0) {
                stack[top++] = static_cast<int>(&n - _node.data()) + 1;
                stack[top++] = n.first;
                continue;
            }
            for (int i = n.first; i < n.first + n.count; ++i) {
                const Corners &c = _corner[i];
                if (overlaps(
                        [&](int k) {
                            return std::min({c[0][k], c[1][k], c[2][k]});
                        },
                        [&](int k) {
                            return std::max({c[0][k], c[1][k], c[2][k]});
                        }))
                    visit(_face[i]);
            }
        }
    }

private:
    struct Node {
        float low[3], high[3];
        int first = 0; // leaf: first triangle; else the right child (the left one follows its parent)
        int count = 0; // leaf: number of triangles; else 0
    };
    using Corners = std::array<Vector, 3>;
    struct Plane {
        Vector normal;      // twice the area long
        double squared = 0; // that of its length; 0 for needles, whose normal is mostly rounding
    };
    static constexpr double Unbounded = std::numeric_limits<double>::max();
    static constexpr double NeedleSquared = 1e-24; // (twice the area over the squared longest side), squared
    std::vector<Node> _node;
    std::vector<Corners> _corner;
    std::vector<Plane> _plane; // of the triangles of those corners
    std::vector<int> _face;    // of the soup, for each of those

    static double Away(const Node &n, const Vector &p)
    {
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
            const double d = std::max({n.low[k] - p[k], 0.0, p[k] - n.high[k]});
            sum += d * d;
        }
        return sum;
    }

    int Split(const TriangleSoup &soup, const std::vector<Vector> &centre, std::vector<int> &order, int from, int to)
    {
        const int id = static_cast<int>(_node.size());
        _node.emplace_back();
        Node n;
        Vector low = centre[order[from]], high = low;
        for (int k = 0; k < 3; ++k) {
            double a = std::numeric_limits<double>::max(), b = -a;
            for (int i = from; i < to; ++i) {
                for (const int v : soup.face[order[i]]) {
                    a = std::min(a, soup.point[v][k]);
                    b = std::max(b, soup.point[v][k]);
                }
                low[k] = std::min(low[k], centre[order[i]][k]);
                high[k] = std::max(high[k], centre[order[i]][k]);
            }
            constexpr float infinity = std::numeric_limits<float>::infinity();
            n.low[k] = std::nextafter(static_cast<float>(a), -infinity);
            n.high[k] = std::nextafter(static_cast<float>(b), infinity);
        }
        if (to - from <= 4) {
            n.first = from;
            n.count = to - from;
        } else {
            const Vector size = high - low;
            const int axis = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
            const int middle = (from + to) / 2;
            std::nth_element(order.begin() + from, order.begin() + middle, order.begin() + to,
                             [&](int x, int y) { return centre[x][axis] < centre[y][axis]; });
            Split(soup, centre, order, from, middle);
            n.first = Split(soup, centre, order, middle, to);
        }
        _node[id] = n;
        return id;
    }

    static double SquaredDistance(const Vector &p, const Vector &a, const Vector &b)
    {
        const Vector d = b - a, w = p - a;
        const double l = d.SquaredNorm();
        const double t = l > 0 ? std::clamp((w * d) / l, 0.0, 1.0) : 0;
        return (w - d * t).SquaredNorm();
    }

    // From the plane inside the prism over the triangle, else from its sides; or something that is not below `bound` if
    // that is not.
    static double SquaredDistance(const Vector &p, const Plane &plane, const Corners &c, double bound)
    {
        const Vector &n = plane.normal;
        const Vector w = p - c[0];
        const double h = w * n;
        bool inside = plane.squared > 0;
        if (inside && h * h >= bound * plane.squared)
            return bound;
        for (int k = 0; k < 3 && inside; ++k)
            inside = ((c[(k + 1) % 3] - c[k]) ^ (p - c[k])) * n >= 0;
        if (inside)
            return h * h / plane.squared;
        return std::min(
            {SquaredDistance(p, c[0], c[1]), SquaredDistance(p, c[1], c[2]), SquaredDistance(p, c[2], c[0])});
    }
};

/// One-sided distance of a surface.
struct Deviation {
    double max = 0;
    double rms = 0;
};

/// One-sided distances from a surface to the triangles of a tree, by sampling. Both lie in one UnitFrame.
class DeviationMeter
{
public:
    DeviationMeter(const TriangleSoup &surface, const TriangleTree &tree) : _surface(surface), _tree(tree) {}

    /// Root mean square over `samples` points in equal strides of the area, placed in their triangles by a
    /// low-discrepancy sequence; maximum over these, over the vertices, and over the triangles where
    /// either comes near it, which are searched to 0.1 percent of it as far as 20 queries a sample, and 200,000, go.
    Deviation Measure(int samples)
    {
        const double squares = Sample(samples);
        _queriesLeft = std::min(MostQueries, QueriesPerSample * samples);
        Refine();
        return {std::sqrt(_largest), samples > 0 ? std::sqrt(squares / samples) : 0};
    }

private:
    using Vector = TriangleSoup::Vector;
    const TriangleSoup &_surface;
    const TriangleTree &_tree;
    std::vector<float> _faceMax; // largest squared distance seen in each face
    double _largest = 0;
    int _hint = -1;
    long long _queriesLeft = 0; // of the search

    /// A part of a face that may hold a larger distance than the largest so far.
    struct Part {
        double distance; // of its middle
        double most;     // no point of it has a larger one
        long long left;  // queries, when it was looked at: among equals the earlier ones come first
        Vector a, b, c;

        // Those further away come first, then those that leave most open: a plateau is searched evenly.
        bool operator<(const Part &other) const
        {
            return std::tie(distance, most, left) < std::tie(other.distance, other.most, other.left);
        }
    };
    std::priority_queue<Part> _open;

    static constexpr double Tolerance = 1.001;
    static constexpr long long MostQueries = 200000, QueriesPerSample = 20;

    static double Fraction(double x) { return x - std::floor(x); }

    double Query(const Vector &p)
    {
        const double d = _tree.SquaredDistance(p, _hint);
        _largest = std::max(_largest, d);
        return d;
    }
    void See(std::size_t face, double d) { _faceMax[face] = std::max(_faceMax[face], static_cast<float>(d)); }

    // Returns the sum of the squared distances.
    double Sample(int samples)
    {
        const TriangleSoup &a = _surface;
        _faceMax.assign(a.face.size(), 0);
        std::vector<double> area(a.face.size());
        double total = 0;
        for (std::size_t t = 0; t < a.face.size(); ++t) {
            const auto &f = a.face[t];
            total += ((a.point[f[1]] - a.point[f[0]]) ^ (a.point[f[2]] - a.point[f[0]])).Norm() / 2;
            area[t] = total;
        }
        double squares = 0;
        std::size_t t = 0;
        for (int i = 0; i < samples && total > 0; ++i) {
            const double want = total * (i + 0.5) / samples;
            while (t + 1 < area.size() && area[t] < want)
                ++t;
            // The plastic number's fractions fill the unit square evenly (Roberts 2018).
            double u = Fraction(0.5 + 0.7548776662466927 * (i + 1)), w = Fraction(0.5 + 0.5698402909980532 * (i + 1));
            if (u + w > 1) {
                u = 1 - u;
                w = 1 - w;
            }
            const auto &f = a.face[t];
            const double d =
                Query(a.point[f[0]] + (a.point[f[1]] - a.point[f[0]]) * u + (a.point[f[2]] - a.point[f[0]]) * w);
            See(t, d);
            squares += d;
        }
        std::vector<double> atVertex(a.point.size(), -1);
        for (t = 0; t < a.face.size(); ++t)
            for (const int v : a.face[t]) {
                if (atVertex[v] < 0)
                    atVertex[v] = Query(a.point[v]);
                See(t, atVertex[v]);
            }
        return squares;
    }

    void Refine()
    {
        std::vector<std::pair<float, int>> near;
        for (std::size_t t = 0; t < _faceMax.size(); ++t)
            if (_faceMax[t] > 0.25 * _largest)
                near.emplace_back(_faceMax[t], static_cast<int>(t));
        std::sort(near.begin(), near.end(), [](const auto &x, const auto &y) {
            return x.first != y.first ? x.first > y.first : x.second < y.second;
        });
        auto face = near.begin();
        while (_queriesLeft > 0 && (face != near.end() || !_open.empty())) {
            if (face != near.end() && (_open.empty() || std::sqrt(face->first) >= _open.top().distance)) {
                const auto &f = _surface.face[(face++)->second];
                Search(_surface.point[f[0]], _surface.point[f[1]], _surface.point[f[2]]);
                continue;
            }
            const Part part = _open.top();
            _open.pop();
            if (!MayHoldMore(part))
                continue;
            const Vector ab = (part.a + part.b) / 2.0, bc = (part.b + part.c) / 2.0, ca = (part.c + part.a) / 2.0;
            Search(part.a, ab, ca);
            Search(part.b, bc, ab);
            Search(part.c, ca, bc);
            Search(ab, bc, ca);
        }
    }

    bool MayHoldMore(const Part &part) const { return part.most > Tolerance * std::sqrt(_largest); }

    void Search(const Vector &a, const Vector &b, const Vector &c)
    {
        const Vector middle = (a + b + c) / 3.0;
        const double radius =
            std::sqrt(std::max({(a - middle).SquaredNorm(), (b - middle).SquaredNorm(), (c - middle).SquaredNorm()}));
        Part part = {std::sqrt(Query(middle)), 0, _queriesLeft--, a, b, c};
        // The distance changes by no more than the way. That from one triangle is convex, so it is largest in a corner;
        // the middle's nearest triangle is taken.
        part.most =
            std::min(part.distance + radius,
                     std::sqrt(std::max({_tree.SquaredDistanceFrom(_hint, a), _tree.SquaredDistanceFrom(_hint, b),
                                         _tree.SquaredDistanceFrom(_hint, c)})));
        if (MayHoldMore(part))
            _open.push(part);
    }
};

} // namespace tri
} // namespace vcg

#endif
