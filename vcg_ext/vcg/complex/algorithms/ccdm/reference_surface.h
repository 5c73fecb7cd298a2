// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_REFERENCE_SURFACE_H
#define VCG_CCDM_REFERENCE_SURFACE_H

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/geometry.h>

namespace vcg {
namespace ccdm {

/// A point of the reference surface: a face and barycentric weights of its three vertices.
struct SurfacePoint {
    int face = -1;
    double weight[3] = {1, 0, 0};
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
        _facet.resize(faces.size());
        for (std::size_t t = 0; t < faces.size(); ++t) {
            Facet &f = _facet[t];
            f.origin = position[faces[t][0]];
            f.e1 = position[faces[t][1]] - f.origin;
            f.e2 = position[faces[t][2]] - f.origin;
        }
        CopyLinks();
    }

    /// Takes over the feature marks of `mesh`, which projection does not cross.
    void CopyLinks()
    {
        for (std::size_t t = 0; t < _facet.size(); ++t) {
            const Triangle &T = mesh.triangle[t];
            for (int e = 0; e < 3; ++e)
                _facet[t].link[e] = T.Constrained(e) ? NoSide : T.n[e];
        }
    }

    int FaceCount() const { return static_cast<int>(_facet.size()); }
    Point AreaVector(int face) const { return Cross(_facet[face].e1, _facet[face].e2) * 0.5; }
    Point At(const SurfacePoint &p) const
    {
        const Facet &f = _facet[p.face];
        return f.origin + f.e1 * p.weight[1] + f.e2 * p.weight[2];
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
        struct Gate {
            double distance;
            Side side;
        };
        std::array<Gate, MaxGates> gate;
        std::array<int, MaxVisited> visited;
        int gates = 0, count = 0;
        visited[count++] = from;
        int face = from;
        for (;;) {
            const Facet &f = _facet[face];
            const Point e12 = f.e2 - f.e1, corner1 = f.origin + f.e1;
            for (int e = 0; e < 3; ++e) {
                const Side link = f.link[e];
                if (link == NoSide || gates == MaxGates)
                    continue;
                bool known = false;
                for (int k = count - 1; k >= 0 && !known; --k)
                    known = visited[k] == SideTriangle(link);
                if (known)
                    continue;
                const double d = e == 0   ? SegmentSquaredDistance(target, corner1, e12)
                                 : e == 1 ? SegmentSquaredDistance(target, f.origin, f.e2)
                                          : SegmentSquaredDistance(target, f.origin, f.e1);
                if (d <= reach)
                    gate[gates++] = {d, link};
            }
            bool moved = false;
            while (gates > 0 && !moved) {
                int nearest = 0;
                for (int k = 1; k < gates; ++k)
                    if (gate[k].distance < gate[nearest].distance)
                        nearest = k;
                face = SideTriangle(gate[nearest].side);
                gate[nearest] = gate[--gates];
                moved = true;
                for (int k = count - 1; k >= 0 && moved; --k)
                    moved = visited[k] != face;
            }
            if (!moved || count == MaxVisited)
                break;
            visited[count++] = face;
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

    /// Nearest point of one face.
    Foot NearestOn(int face, const Point &p) const
    {
        const Facet &f = _facet[face];
        return NearestOnTriangle(f.origin, f.e1, f.e2, p);
    }

private:
    static constexpr int MaxVisited = 192;
    static constexpr int MaxGates = 256;

    // What a projection reads of a face, side by side in memory.
    struct Facet {
        Point origin, e1, e2;
        Side link[3]; // over features: none
    };
    std::vector<Facet> _facet;
};

} // namespace ccdm
} // namespace vcg

#endif
