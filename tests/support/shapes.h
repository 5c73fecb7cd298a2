// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_TESTS_SUPPORT_SHAPES_H
#define CCDM_TESTS_SUPPORT_SHAPES_H

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

/// Generated triangle meshes as plain tables: what the tests run on and what sample_meshes holds.
namespace shapes {

using P = std::array<double, 3>;
using F = std::array<int, 3>;

struct Shape {
    std::vector<P> points;
    std::vector<F> faces;

    int Add(double x, double y, double z)
    {
        points.push_back({x, y, z});
        return static_cast<int>(points.size()) - 1;
    }
    void Quad(int a, int b, int c, int d)
    {
        faces.push_back({a, b, c});
        faces.push_back({a, c, d});
    }
};

constexpr double Pi = 3.14159265358979323846;

inline Shape Tetrahedron()
{
    return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

inline Shape Icosahedron()
{
    const double g = (1 + std::sqrt(5.0)) / 2;
    Shape s;
    s.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    s.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
               {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
               {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    return s;
}

/// Every triangle into four, new points at the middles of the edges.
inline Shape Subdivide(const Shape &s)
{
    Shape r;
    r.points = s.points;
    std::map<std::pair<int, int>, int> middle;
    const auto mid = [&](int a, int b) {
        const auto key = std::minmax(a, b);
        const auto it = middle.find(key);
        if (it != middle.end())
            return it->second;
        const P &p = s.points[a], &q = s.points[b];
        return middle[key] = r.Add((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2);
    };
    for (const F &f : s.faces) {
        const int a = mid(f[1], f[2]), b = mid(f[2], f[0]), c = mid(f[0], f[1]);
        r.faces.push_back({f[0], c, b});
        r.faces.push_back({f[1], a, c});
        r.faces.push_back({f[2], b, a});
        r.faces.push_back({a, b, c});
    }
    return r;
}

inline Shape Sphere(int subdivisions)
{
    Shape s = Icosahedron();
    for (int i = 0; i < subdivisions; ++i)
        s = Subdivide(s);
    for (P &p : s.points) {
        const double l = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        for (double &x : p)
            x /= l;
    }
    return s;
}

/// A smooth organic body: a sphere with bumps of several wavelengths.
inline Shape Bumpy(int subdivisions)
{
    Shape s = Sphere(subdivisions);
    for (P &p : s.points) {
        const double r = 1 + 0.12 * std::sin(3 * p[0] + 1) * std::sin(4 * p[1]) + 0.1 * std::sin(5 * p[2] + p[0]) +
                         0.05 * std::sin(9 * p[1]) * std::sin(8 * p[0]);
        p = {1.4 * r * p[0], r * p[1], 0.9 * r * p[2]};
    }
    return s;
}

/// A grid that wraps around both ways, at(u, v) with u, v in [0, 1).
inline Shape Torus(int nu, int nv, const std::function<P(double, double)> &at)
{
    Shape s;
    for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j)
            s.points.push_back(at(static_cast<double>(i) / nu, static_cast<double>(j) / nv));
    const auto id = [&](int i, int j) { return (i % nu) * nv + j % nv; };
    for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j)
            s.Quad(id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
    return s;
}

inline Shape RoundTorus(int nu, int nv, double thickness = 0.4)
{
    return Torus(nu, nv, [=](double u, double v) {
        const double a = 2 * Pi * u, b = 2 * Pi * v, r = 1 + thickness * std::cos(b);
        return P{r * std::cos(a), r * std::sin(a), thickness * std::sin(b)};
    });
}

/// A ring of square section that turns once around itself: four closed creases, genus 1. `side`
/// segments a side of the square.
inline Shape TwistedBar(int nu, int side)
{
    return Torus(nu, 4 * side, [=](double u, double v) {
        const double t = 4 * v, along = t - std::floor(t);
        const int k = static_cast<int>(t) % 4;
        const double cx[5] = {1, -1, -1, 1, 1}, cy[5] = {1, 1, -1, -1, 1};
        const double x = 0.32 * (cx[k] + (cx[k + 1] - cx[k]) * along), y = 0.32 * (cy[k] + (cy[k + 1] - cy[k]) * along);
        const double a = 2 * Pi * u, c = std::cos(a), s = std::sin(a);
        const double r = 1.2 + x * c - y * s, z = x * s + y * c;
        return P{r * c, r * s, z};
    });
}

/// The figure-eight immersion of the Klein bottle: closed, one-sided, self-intersecting.
inline Shape KleinBottle(int nu, int nv)
{
    Shape s;
    for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j) {
            const double u = 2 * Pi * i / nu, v = 2 * Pi * j / nv;
            const double r = 2.2 + std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
            s.Add(r * std::cos(u), r * std::sin(u), std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v));
        }
    // After one turn v runs the other way.
    const auto id = [&](int i, int j) {
        if (i == nu)
            j = nv - j;
        return (i % nu) * nv + (j + nv) % nv;
    };
    for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j)
            s.Quad(id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
    return s;
}

inline Shape MoebiusStrip(int nu, int nv)
{
    Shape s;
    for (int i = 0; i < nu; ++i)
        for (int j = 0; j <= nv; ++j) {
            const double u = 2 * Pi * i / nu, w = 0.5 * (2.0 * j / nv - 1);
            s.Add((1 + w * std::cos(u / 2)) * std::cos(u), (1 + w * std::cos(u / 2)) * std::sin(u),
                  w * std::sin(u / 2));
        }
    const auto id = [&](int i, int j) { return i == nu ? nv - j : i * (nv + 1) + j; };
    for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j)
            s.Quad(id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
    return s;
}

/// The cells of an nx x ny grid for which solid(i, j), with points at(x, y), x and y in [0, 1].
inline Shape Grid(int nx, int ny, const std::function<bool(int, int)> &solid,
                  const std::function<P(double, double)> &at)
{
    Shape s;
    std::vector<int> id((static_cast<std::size_t>(nx) + 1) * (static_cast<std::size_t>(ny) + 1), -1);
    const auto corner = [&](int i, int j) {
        int &k = id[static_cast<std::size_t>(i) * (static_cast<std::size_t>(ny) + 1) + static_cast<std::size_t>(j)];
        if (k < 0) {
            s.points.push_back(at(static_cast<double>(i) / nx, static_cast<double>(j) / ny));
            k = static_cast<int>(s.points.size()) - 1;
        }
        return k;
    };
    for (int i = 0; i < nx; ++i)
        for (int j = 0; j < ny; ++j)
            if (solid(i, j))
                s.Quad(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
    return s;
}

inline Shape FlatGrid(int n)
{
    return Grid(
        n, n, [](int, int) { return true; },
        [](double x, double y) {
            return P{x, y, 0};
        });
}

/// A curved plate with three round holes: four boundary loops.
inline Shape Plate(int n)
{
    const auto hole = [=](int i, int j) {
        const double x = (i + 0.5) / n, y = (j + 0.5) / n;
        const double c[3][3] = {{0.25, 0.3, 0.1}, {0.7, 0.25, 0.13}, {0.5, 0.7, 0.16}};
        for (const auto &h : c)
            if (std::hypot(x - h[0], y - h[1]) < h[2])
                return true;
        return false;
    };
    return Grid(
        n, n, [=](int i, int j) { return !hole(i, j); },
        [](double x, double y) {
            return P{2 * x, 2 * y, 0.3 * std::sin(3 * x) * std::cos(4 * y)};
        });
}

/// Two copies of a flat sheet at z = 0 and z = height, joined by walls along their boundary.
inline Shape Extrude(const Shape &sheet, double height)
{
    Shape s = sheet;
    const int n = static_cast<int>(sheet.points.size());
    for (const P &p : sheet.points)
        s.Add(p[0], p[1], p[2] + height);
    std::map<std::pair<int, int>, int> directed;
    for (const F &f : sheet.faces)
        for (int k = 0; k < 3; ++k)
            ++directed[{f[k], f[(k + 1) % 3]}];
    for (F &f : s.faces)
        std::swap(f[1], f[2]);
    for (const F &f : sheet.faces)
        s.faces.push_back({f[0] + n, f[1] + n, f[2] + n});
    for (const auto &e : directed)
        if (directed.count({e.first.second, e.first.first}) == 0)
            s.Quad(e.first.first, e.first.second, e.first.second + n, e.first.first + n);
    return s;
}

/// A block with two round holes through it, after the paper's Joint: exact creases, genus 2, few
/// faces, walls and rims of needle triangles. `segments` around a hole: a multiple of 8.
inline Shape CadPart(int segments = 24)
{
    Shape s;
    std::map<std::pair<long long, long long>, int> known;
    const auto point = [&](double x, double y) {
        const auto key = std::make_pair(std::llround(x * 1e9), std::llround(y * 1e9));
        const auto it = known.find(key);
        return it != known.end() ? it->second : known[key] = s.Add(x, y, 0);
    };
    for (int square = 0; square < 2; ++square)
        for (int k = 0; k < segments; ++k) {
            const auto rim = [&](int i, bool outer) {
                const double a = 2 * Pi * i / segments, c = std::cos(a), d = std::sin(a);
                const double r = outer ? 1 / std::max(std::abs(c), std::abs(d)) : 0.45 + 0.2 * square;
                return point(2 * square + r * c, r * d);
            };
            s.Quad(rim(k, false), rim(k, true), rim(k + 1, true), rim(k + 1, false));
        }
    return Extrude(s, 1.2);
}

inline Shape Box(double x, double y, double z)
{
    Shape s = Grid(
        1, 1, [](int, int) { return true; },
        [=](double u, double v) {
            return P{x * u, y * v, 0};
        });
    return Extrude(s, z);
}

/// Each point towards the mean of its neighbours, `rounds` times.
inline void Smooth(Shape &s, int rounds)
{
    for (int r = 0; r < rounds; ++r) {
        std::vector<P> sum(s.points.size(), P{0, 0, 0});
        std::vector<int> count(s.points.size(), 0);
        for (const F &f : s.faces)
            for (int k = 0; k < 3; ++k) {
                for (int c = 0; c < 3; ++c)
                    sum[f[k]][c] += s.points[f[(k + 1) % 3]][c] + s.points[f[(k + 2) % 3]][c];
                count[f[k]] += 2;
            }
        for (std::size_t v = 0; v < s.points.size(); ++v)
            for (int c = 0; c < 3; ++c)
                s.points[v][c] = 0.5 * s.points[v][c] + 0.5 * sum[v][c] / count[v];
    }
}

/// A smooth slab with a 3 x 3 pattern of holes, bent: genus 9.
inline Shape HighGenus(int cell)
{
    const int n = 7 * cell;
    Shape s = Extrude(Grid(
                          n, n, [=](int i, int j) { return !((i / cell) % 2 == 1 && (j / cell) % 2 == 1); },
                          [](double x, double y) {
                              return P{2 * x, 2 * y, 0};
                          }),
                      0.3);
    s = Subdivide(s);
    Smooth(s, 12);
    for (P &p : s.points)
        p[2] += 0.25 * std::sin(2 * p[0]) * std::cos(1.5 * p[1]);
    return s;
}

/// Same sequence everywhere, in [-1, 1].
inline double Noise(std::uint64_t k)
{
    k = (k + 0x9e3779b97f4a7c15ULL) * 0xbf58476d1ce4e5b9ULL;
    k = (k ^ (k >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<double>((k ^ (k >> 31)) >> 11) * 0x1p-52 - 1;
}

/// Moves every coordinate by at most `size`.
inline void AddNoise(Shape &s, double size)
{
    for (std::size_t v = 0; v < s.points.size(); ++v)
        for (int c = 0; c < 3; ++c)
            s.points[v][c] += size * Noise(3 * v + static_cast<std::size_t>(c));
}

/// Keeps the faces for which keep(centroid), and the points that they use.
inline Shape Cut(const Shape &s, const std::function<bool(const P &)> &keep)
{
    Shape r;
    std::vector<int> id(s.points.size(), -1);
    for (const F &f : s.faces) {
        P c = {0, 0, 0};
        for (const int v : f)
            for (int k = 0; k < 3; ++k)
                c[k] += s.points[v][k] / 3;
        if (!keep(c))
            continue;
        F g;
        for (int k = 0; k < 3; ++k) {
            int &n = id[f[k]];
            if (n < 0) {
                r.points.push_back(s.points[f[k]]);
                n = static_cast<int>(r.points.size()) - 1;
            }
            g[k] = n;
        }
        r.faces.push_back(g);
    }
    return r;
}

/// A noisy head on a neck, open below: one boundary loop.
inline Shape Bust(int subdivisions, double noise)
{
    Shape s = Sphere(subdivisions);
    for (P &p : s.points) {
        const double z = p[2], neck = z < -0.55 ? 0.45 + 0.5 * (-0.55 - z) : 1.0;
        const double blend = 1 / (1 + std::exp(-14 * (z + 0.6)));
        const double width = neck + (1 - neck) * blend;
        const double nose = 0.25 * std::exp(-18 * (p[0] * p[0] + (z - 0.05) * (z - 0.05))) * (p[1] < 0 ? 1 : 0);
        p = {0.75 * width * p[0], 0.95 * width * p[1] - nose, 1.15 * z - (z < -0.6 ? 0.5 * (-0.6 - z) : 0)};
    }
    s = Cut(s, [](const P &c) { return c[2] > -1.15; });
    AddNoise(s, noise);
    return s;
}

/// Both shapes in one mesh, the second moved along x.
inline Shape Together(Shape a, const Shape &b, double offset)
{
    const int n = static_cast<int>(a.points.size());
    for (const P &p : b.points)
        a.Add(p[0] + offset, p[1], p[2]);
    for (const F &f : b.faces)
        a.faces.push_back({f[0] + n, f[1] + n, f[2] + n});
    return a;
}

inline Shape TwoComponents()
{
    return Together(Sphere(3), RoundTorus(40, 20), 2.8);
}

} // namespace shapes

#endif
