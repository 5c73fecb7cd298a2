// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_REFERENCE_SURFACE_H
#define VCG_CCDM_REFERENCE_SURFACE_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <unordered_set>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/geometry.h>

namespace vcg {
namespace ccdm {

/// A point of the reference surface: a face and barycentric weights of its three vertices.
struct SurfacePoint {
    int face = -1;                ///< index of the face; -1: none
    double weight[3] = {1, 0, 0}; ///< of the face's vertices in their order, each from 0 to 1, 1 in sum
};

/// The input, frozen: what every vertex of the remesh lies on. Constant once its features are set.
class ReferenceSurface
{
public:
    std::vector<Point> position;
    Triangulation mesh; ///< constrained sides are the features, boundaries included

    ReferenceSurface() = default;
    ReferenceSurface(std::vector<Point> points, const std::vector<std::array<int, 3>> &faces)
        : position(std::move(points))
    {
        mesh.Build(static_cast<int>(position.size()), faces);
    }

    int FaceCount() const { return mesh.TriangleCount(); }
    double EdgeLength(Side s) const { return Norm(position[mesh.Tail(s)] - position[mesh.Head(s)]); }
    Point AreaVector(int face) const
    {
        const Point &a = Corner(face, 0);
        return Cross(Corner(face, 1) - a, Corner(face, 2) - a) * 0.5;
    }
    Point At(const SurfacePoint &p) const
    {
        const Point &a = Corner(p.face, 0);
        return a + (Corner(p.face, 1) - a) * p.weight[1] + (Corner(p.face, 2) - a) * p.weight[2];
    }
    /// Linear interpolation of a per-vertex field.
    double Interpolate(const SurfacePoint &p, const std::vector<double> &field) const
    {
        const Triangle &T = mesh.triangle[p.face];
        return p.weight[0] * field[T.v[0]] + p.weight[1] * field[T.v[1]] + p.weight[2] * field[T.v[2]];
    }

    /// Moves a point of the surface towards `target`: the point nearest to `target` in the part of
    /// {y on the surface: |y - target| <= |x - target|} that is connected to x without crossing a
    /// feature, so it cannot jump to another sheet. The search stops early once it stands within
    /// `slack` times the step from the target.
    /// `from` is x's face, `x` its position. Returns the foot and its face.
    std::pair<int, Foot> Project(int from, const Point &x, const Point &target, double slack = 0.1) const
    {
        const double reach = SquaredNorm(x - target);
        const double good = reach * slack * slack;
        int bestFace = from;
        Foot best = NearestOn(from, target);
        if (best.squaredDistance <= good)
            return {bestFace, best};

        // Nearest side first, so that the search runs straight towards the target.
        std::array<double, MaxGates> distance;
        std::array<Side, MaxGates> gate;
        int gates = 0;
        Visited visited;
        visited.Add(from);
        int face = from;
        for (;;) {
            const Triangle &T = mesh.triangle[face];
            for (int e = 0; e < 3; ++e) {
                const Side link = T.n[e];
                if (link == NoSide || T.Constrained(e) || gates == MaxGates || visited.Has(SideTriangle(link)))
                    continue;
                const Point &tail = position[T.v[Next(e)]];
                const double d = SegmentSquaredDistance(target, tail, position[T.v[Prev(e)]] - tail);
                if (d <= std::min(reach, 4 * best.squaredDistance)) {
                    distance[gates] = d;
                    gate[gates++] = link;
                }
            }
            bool moved = false;
            while (gates > 0 && !moved) {
                const auto nearest = std::min_element(distance.begin(), distance.begin() + gates) - distance.begin();
                if (distance[nearest] > 4 * best.squaredDistance) {
                    gates = 0;
                    break;
                }
                face = SideTriangle(gate[nearest]);
                distance[nearest] = distance[--gates];
                gate[nearest] = gate[gates];
                moved = !visited.Has(face);
            }
            if (!moved || visited.Full())
                break;
            visited.Add(face);
            const Foot foot = NearestOn(face, target);
            if (foot.squaredDistance < best.squaredDistance) {
                best = foot;
                bestFace = face;
                if (best.squaredDistance <= good)
                    break;
            }
        }
        return {bestFace, best};
    }

    /// Have a face brought into the cache: its record first, some time later its corners.
    void PrefetchRecord(int face) const { Prefetch(&mesh.triangle[face]); }
    void PrefetchCorners(int face) const
    {
        for (const int v : mesh.triangle[face].v)
            Prefetch(&position[v]);
    }

    /// Whether two faces are joined by faces that come within `radius` of p, without crossing a feature; after
    /// `most` faces the answer is no.
    bool Joined(int from, int to, const Point &p, double radius, std::size_t most) const
    {
        std::vector<int> visited(1, from);
        std::unordered_set<int> known(visited.begin(), visited.end());
        for (std::size_t k = 0; k < visited.size() && visited.size() < most; ++k) {
            if (visited[k] == to)
                return true;
            const Triangle &T = mesh.triangle[visited[k]];
            for (int e = 0; e < 3; ++e) {
                if (T.n[e] == NoSide || T.Constrained(e))
                    continue;
                const Point &tail = position[T.v[Next(e)]];
                const int next = SideTriangle(T.n[e]);
                if (SegmentSquaredDistance(p, tail, position[T.v[Prev(e)]] - tail) < radius * radius &&
                    known.insert(next).second)
                    visited.push_back(next);
            }
        }
        return false;
    }

    /// Nearest point of one face.
    Foot NearestOn(int face, const Point &p) const
    {
        const Point &a = Corner(face, 0);
        return NearestOnTriangle(a, Corner(face, 1) - a, Corner(face, 2) - a, p);
    }

private:
    static constexpr int MaxGates = 256;

    /// The faces of one search. Most searches see a few; where hundreds of faces meet in a place, a filter spares
    /// looking through them.
    class Visited
    {
    public:
        bool Full() const { return _count == Most; }
        void Add(int face)
        {
            _face[_count++] = face;
            if (_count > Few)
                Filter(face);
        }
        bool Has(int face) const
        {
            if (_count > Few && (_filter[Slot(face)] & Bit(face)) == 0)
                return false;
            int k = _count - 1;
            while (k >= 0 && _face[k] != face)
                --k;
            return k >= 0;
        }

    private:
        static constexpr int Most = 192, Words = 16, Few = 6;
        std::array<std::uint64_t, Words> _filter; // once there are more than a few
        std::array<int, Most> _face;
        int _count = 0;

        void Filter(int face)
        {
            if (_count == Few + 1) {
                _filter.fill(0);
                for (int k = 0; k < Few; ++k)
                    _filter[Slot(_face[k])] |= Bit(_face[k]);
            }
            _filter[Slot(face)] |= Bit(face);
        }

        static unsigned Slot(int face) { return static_cast<unsigned>(face) / 64 % Words; }
        static std::uint64_t Bit(int face) { return std::uint64_t(1) << (static_cast<unsigned>(face) % 64); }
    };

    const Point &Corner(int face, int i) const { return position[mesh.triangle[face].v[i]]; }
};

} // namespace ccdm
} // namespace vcg

#endif
