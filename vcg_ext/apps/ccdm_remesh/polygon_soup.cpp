// SPDX-License-Identifier: GPL-3.0-or-later
#include "polygon_soup.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ccdm_remesh {
namespace {

using Point = vcg::Point3d;

// A polygon while ears are cut off it.
class EarClipper
{
public:
    explicit EarClipper(const std::vector<Point> &corner) : _corner(corner), _left(corner.size())
    {
        std::iota(_left.begin(), _left.end(), 0);
        // Newell: the sum over a fan, whichever way that folds.
        for (std::size_t k = 1; k + 1 < corner.size(); ++k) {
            _normal += (corner[k] - corner[0]) ^ (corner[k + 1] - corner[0]);
        }
    }

    std::vector<std::array<int, 3>> Run()
    {
        std::vector<std::array<int, 3>> triangles;
        LookAtAll();
        bool fresh = true;
        while (_left.size() > 3) {
            std::size_t best =
                static_cast<std::size_t>(std::max_element(_angle.begin(), _angle.end()) - _angle.begin());
            // A corner that was none may have become an ear since. Where there is none at all, as in a polygon that
            // crosses itself, any corner goes.
            if (_angle[best] < 0 && !fresh) {
                LookAtAll();
                fresh = true;
                continue;
            }
            fresh = false;
            triangles.push_back({At(best + Size() - 1), At(best), At(best + 1)});
            _left.erase(_left.begin() + static_cast<std::ptrdiff_t>(best));
            _angle.erase(_angle.begin() + static_cast<std::ptrdiff_t>(best));
            for (const std::size_t k : {(best + Size() - 1) % Size(), best % Size()})
                _angle[k] = Quality(k);
        }
        triangles.push_back({_left[0], _left[1], _left[2]});
        return triangles;
    }

private:
    const std::vector<Point> &_corner;
    std::vector<int> _left;
    std::vector<double> _angle; // of the triangles at what is left, as Quality() has them
    Point _normal = Point(0, 0, 0);

    std::size_t Size() const { return _left.size(); }
    int At(std::size_t k) const { return _left[k % Size()]; }

    // The smallest angle of an ear, -1 for what is none.
    double Quality(std::size_t k) const { return IsEar(k) ? SmallestAngle(k) : -1; }

    void LookAtAll()
    {
        _angle.resize(Size());
        for (std::size_t k = 0; k < Size(); ++k)
            _angle[k] = Quality(k);
    }

    bool TurnsLeft(const Point &a, const Point &b, const Point &c) const { return ((b - a) ^ (c - a)) * _normal > 0; }

    bool IsEar(std::size_t k) const
    {
        const Point &a = _corner[At(k + Size() - 1)], &b = _corner[At(k)], &c = _corner[At(k + 1)];
        if (!TurnsLeft(a, b, c))
            return false;
        for (std::size_t i = 2; i + 1 < Size(); ++i) {
            const Point &p = _corner[At(k + i)];
            if (p != a && p != c && !TurnsLeft(b, a, p) && !TurnsLeft(c, b, p) && !TurnsLeft(a, c, p))
                return false;
        }
        return true;
    }

    double SmallestAngle(std::size_t k) const
    {
        const Point &a = _corner[At(k + Size() - 1)], &b = _corner[At(k)], &c = _corner[At(k + 1)];
        const auto angle = [](const Point &p, const Point &q, const Point &r) {
            const Point u = q - p, v = r - p;
            return std::atan2((u ^ v).Norm(), u * v);
        };
        return std::min({angle(a, b, c), angle(b, c, a), angle(c, a, b)});
    }
};

} // namespace

std::string CheckIndices(const PolygonSoup &soup)
{
    for (std::size_t k = 0; k < soup.PolygonCount(); ++k) {
        if (soup.end[k] - soup.Begin(k) < 3)
            return "face " + std::to_string(k) + " has fewer than three corners";
        for (std::size_t i = soup.Begin(k); i < soup.end[k]; ++i)
            if (soup.corner[i] < 0 || static_cast<std::size_t>(soup.corner[i]) >= soup.point.size())
                return "face " + std::to_string(k) + " names a vertex that does not exist";
    }
    return "";
}

std::vector<std::array<int, 3>> SplitPolygon(const std::vector<vcg::Point3d> &corner)
{
    // Cutting ears takes quadratic time.
    constexpr std::size_t mostForEars = 20000;
    if (corner.size() <= mostForEars)
        return EarClipper(corner).Run();
    std::vector<std::array<int, 3>> fan;
    for (int k = 2; k < static_cast<int>(corner.size()); ++k)
        fan.push_back({0, k - 1, k});
    return fan;
}

} // namespace ccdm_remesh
