// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_MESH_QUALITY_EXACT_PREDICATES_H
#define VCG_MESH_QUALITY_EXACT_PREDICATES_H

#include <array>
#include <cmath>

#include <vcg/space/point3.h>

namespace vcg {
namespace tri {

/// Signs of determinants of double coordinates, exact but for over- and underflow: in floating point with a bound on
/// the error, and where that does not tell, by sums of doubles without rounding (Shewchuk 1997).
namespace exact {

using Vector = Point3<double>;

/// A number as the sum of doubles that do not overlap, the smallest first.
class Expansion
{
public:
    Expansion() = default;

    /// a - b.
    static Expansion Difference(double a, double b)
    {
        Expansion e;
        e.Add(a);
        e.Add(-b);
        return e;
    }

    void Add(double x)
    {
        int kept = 0;
        for (int k = 0; k < _count; ++k) {
            const double term = _term[k], sum = x + term, part = sum - x;
            const double rest = (x - (sum - part)) + (term - part);
            if (rest != 0)
                _term[kept++] = rest;
            x = sum;
        }
        if (x != 0)
            _term[kept++] = x;
        _count = kept;
    }

    void AddProduct(const Expansion &a, const Expansion &b)
    {
        for (int i = 0; i < a._count; ++i)
            for (int j = 0; j < b._count; ++j) {
                const double product = a._term[i] * b._term[j];
                Add(std::fma(a._term[i], b._term[j], -product));
                Add(product);
            }
    }

    void Negate()
    {
        for (int k = 0; k < _count; ++k)
            _term[k] = -_term[k];
    }

    int Sign() const { return _count == 0 ? 0 : _term[_count - 1] > 0 ? 1 : -1; }

private:
    static constexpr int Most = 200; // a determinant of three by three has 3 * 2 * 16 * 2 at most
    int _count = 0;
    std::array<double, Most> _term;
};

constexpr double Epsilon = 1.0 / (1ULL << 53);

inline int SignOf(double x)
{
    return (x > 0) - (x < 0);
}

/// Of the triangle a, b, c in the plane of the coordinates i and j: 1 counterclockwise, -1 clockwise, 0 on a line.
inline int Orientation(const Vector &a, const Vector &b, const Vector &c, int i, int j)
{
    const double left = (a[i] - c[i]) * (b[j] - c[j]), right = (a[j] - c[j]) * (b[i] - c[i]);
    const double determinant = left - right;
    if (std::abs(determinant) > (3 + 16 * Epsilon) * Epsilon * (std::abs(left) + std::abs(right)))
        return SignOf(determinant);
    const auto difference = Expansion::Difference;
    Expansion sum;
    sum.AddProduct(difference(a[j], c[j]), difference(b[i], c[i]));
    sum.Negate();
    sum.AddProduct(difference(a[i], c[i]), difference(b[j], c[j]));
    return sum.Sign();
}

/// Of the tetrahedron: the sign of (a - d) * ((b - d) x (c - d)); 0 if the four lie in a plane.
inline int Orientation(const Vector &a, const Vector &b, const Vector &c, const Vector &d)
{
    const Vector u = a - d, v = b - d, w = c - d;
    const double vw = v[0] * w[1], wv = w[0] * v[1], wu = w[0] * u[1], uw = u[0] * w[1], uv = u[0] * v[1],
                 vu = v[0] * u[1];
    const double determinant = u[2] * (vw - wv) + v[2] * (wu - uw) + w[2] * (uv - vu);
    const double permanent = (std::abs(vw) + std::abs(wv)) * std::abs(u[2]) +
                             (std::abs(wu) + std::abs(uw)) * std::abs(v[2]) +
                             (std::abs(uv) + std::abs(vu)) * std::abs(w[2]);
    if (std::abs(determinant) > (7 + 56 * Epsilon) * Epsilon * permanent)
        return SignOf(determinant);
    Expansion m[3][3];
    for (int k = 0; k < 3; ++k) {
        // All in one plane of the coordinates.
        if (a[k] == d[k] && b[k] == d[k] && c[k] == d[k])
            return 0;
        m[0][k] = Expansion::Difference(a[k], d[k]);
        m[1][k] = Expansion::Difference(b[k], d[k]);
        m[2][k] = Expansion::Difference(c[k], d[k]);
    }
    Expansion sum;
    for (int k = 0; k < 3; ++k) {
        const Expansion *x = m[(k + 1) % 3], *y = m[(k + 2) % 3];
        Expansion minor;
        minor.AddProduct(y[0], x[1]);
        minor.Negate();
        minor.AddProduct(x[0], y[1]);
        sum.AddProduct(m[k][2], minor);
    }
    return sum.Sign();
}

} // namespace exact
} // namespace tri
} // namespace vcg

#endif
