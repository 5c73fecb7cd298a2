// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_MESH_QUALITY_SELF_INTERSECTIONS_H
#define VCG_MESH_QUALITY_SELF_INTERSECTIONS_H

#include <algorithm>
#include <array>
#include <vector>

#include <vcg/complex/algorithms/mesh_quality/exact_predicates.h>
#include <vcg/complex/algorithms/mesh_quality/surface_distance.h>
#include <vcg/complex/algorithms/mesh_quality/two_at_a_time.h>

namespace vcg {
namespace tri {

/// Whether two triangles have a point in common, exactly. Triangles are closed and have an area.
class TriangleContact
{
public:
    using Vector = TriangleSoup::Vector;
    using Corners = std::array<Vector, 3>;

    static bool Meet(const Corners &a, const Corners &b)
    {
        if (Apart(a, b) || Apart(b, a))
            return false;
        for (int k = 0; k < 3; ++k)
            if (Meets(a[k], a[(k + 1) % 3], b) || Meets(b[k], b[(k + 1) % 3], a))
                return true;
        return false;
    }

    /// A segment and a triangle.
    static bool Meets(const Vector &p, const Vector &q, const Corners &t)
    {
        const int atP = exact::Orientation(t[0], t[1], t[2], p), atQ = exact::Orientation(t[0], t[1], t[2], q);
        if (atP * atQ > 0)
            return false;
        if (atP == 0 && atQ == 0)
            return MeetsInPlane(p, q, t);
        bool left = false, right = false;
        for (int k = 0; k < 3; ++k) {
            const int side = exact::Orientation(p, q, t[k], t[(k + 1) % 3]);
            left = left || side > 0;
            right = right || side < 0;
        }
        return !(left && right);
    }

    /// Whether triangles on the edge a, b with the apexes p and q lie on each other.
    static bool Overlap(const Vector &a, const Vector &b, const Vector &p, const Vector &q)
    {
        if (exact::Orientation(a, b, p, q) != 0)
            return false;
        const auto [i, j] = PlaneOf({a, b, p});
        return exact::Orientation(a, b, p, i, j) * exact::Orientation(a, b, q, i, j) > 0;
    }

    static bool HasArea(const Corners &t)
    {
        const auto [i, j] = PlaneOf(t);
        return exact::Orientation(t[0], t[1], t[2], i, j) != 0;
    }

private:
    // Whether a lies on one side of the plane of b.
    static bool Apart(const Corners &a, const Corners &b)
    {
        const int side = exact::Orientation(b[0], b[1], b[2], a[0]);
        return side != 0 && side == exact::Orientation(b[0], b[1], b[2], a[1]) &&
               side == exact::Orientation(b[0], b[1], b[2], a[2]);
    }

    // Two coordinates in which the triangle is seen with an area, if there are such.
    static std::pair<int, int> PlaneOf(const Corners &t)
    {
        for (int i = 0; i < 2; ++i)
            if (exact::Orientation(t[0], t[1], t[2], i, i + 1) != 0)
                return {i, i + 1};
        return {2, 0};
    }

    static bool MeetsInPlane(const Vector &p, const Vector &q, const Corners &t)
    {
        const auto [i, j] = PlaneOf(t);
        const int around = exact::Orientation(t[0], t[1], t[2], i, j);
        bool inside = true;
        for (int k = 0; k < 3; ++k) {
            const Vector &a = t[k], &b = t[(k + 1) % 3];
            inside = inside && exact::Orientation(a, b, p, i, j) * around >= 0;
            if (Cross(p, q, a, b, i, j))
                return true;
        }
        return inside;
    }

    // Closed segments in a plane.
    static bool Cross(const Vector &p, const Vector &q, const Vector &a, const Vector &b, int i, int j)
    {
        const int pa = exact::Orientation(p, q, a, i, j), pb = exact::Orientation(p, q, b, i, j);
        const int ap = exact::Orientation(a, b, p, i, j), aq = exact::Orientation(a, b, q, i, j);
        if (pa * pb > 0 || ap * aq > 0)
            return false;
        if (pa != 0 || pb != 0)
            return true;
        // On one line.
        for (const int k : {i, j})
            if (std::max(p[k], q[k]) < std::min(a[k], b[k]) || std::max(a[k], b[k]) < std::min(p[k], q[k]))
                return false;
        return true;
    }
};

/// Where a surface meets itself elsewhere than in the vertices and edges that its faces share.
struct SelfIntersections {
    long long pairs = 0;   ///< of faces
    std::vector<int> face; ///< the faces in such pairs, in order

    /// Exact. Faces without area are left out. `parallel`: on two threads, to the same result.
    explicit SelfIntersections(const TriangleSoup &soup, bool parallel = false)
    {
        const TriangleTree tree(soup);
        const auto corners = [&](int t) {
            const TriangleSoup::Face &f = soup.face[t];
            return TriangleContact::Corners{soup.point[f[0]], soup.point[f[1]], soup.point[f[2]]};
        };
        std::vector<char> solid(soup.face.size());
        for (std::size_t t = 0; t < soup.face.size(); ++t) {
            const TriangleSoup::Face &f = soup.face[t];
            solid[t] =
                f[0] != f[1] && f[1] != f[2] && f[2] != f[0] && TriangleContact::HasArea(corners(static_cast<int>(t)));
        }
        // The pairs whose first face is in [from, to), and the faces in them.
        struct Found {
            long long pairs = 0;
            std::vector<char> hit;
        };
        const auto search = [&](int from, int to) {
            Found found = {0, std::vector<char>(soup.face.size(), 0)};
            for (int t = from; t < to; ++t) {
                if (!solid[t])
                    continue;
                const auto own = corners(t);
                tree.VisitOverlapping(own, [&](int other) {
                    if (other <= t || !solid[other] || !Meet(soup.face[t], own, soup.face[other], corners(other)))
                        return;
                    ++found.pairs;
                    found.hit[t] = found.hit[other] = 1;
                });
            }
            return found;
        };
        const int count = static_cast<int>(soup.face.size());
        Found lower, upper;
        TwoAtATime(
            parallel, [&] { lower = search(0, count / 2); }, [&] { upper = search(count / 2, count); });
        pairs = lower.pairs + upper.pairs;
        for (int t = 0; t < count; ++t)
            if (lower.hit[t] != 0 || upper.hit[t] != 0)
                face.push_back(t);
    }

private:
    static bool Meet(const TriangleSoup::Face &f, const TriangleContact::Corners &a, const TriangleSoup::Face &g,
                     const TriangleContact::Corners &b)
    {
        int shared = 0, free[2] = {0, 0},
            joint[2] = {0, 0}; // of f and of g: a corner that is theirs alone, one in common
        for (int i = 0; i < 3; ++i) {
            const bool mine = std::find(g.begin(), g.end(), f[i]) != g.end();
            shared += mine;
            (mine ? joint : free)[0] = i;
            (std::find(f.begin(), f.end(), g[i]) != f.end() ? joint : free)[1] = i;
        }
        const auto after = [](const TriangleContact::Corners &t, int k, int by) { return t[(k + by) % 3]; };
        switch (shared) {
        case 0:
            return TriangleContact::Meet(a, b);
        case 1:
            return TriangleContact::Meets(after(a, joint[0], 1), after(a, joint[0], 2), b) ||
                   TriangleContact::Meets(after(b, joint[1], 1), after(b, joint[1], 2), a);
        case 2:
            return TriangleContact::Overlap(after(a, free[0], 1), after(a, free[0], 2), a[free[0]], b[free[1]]);
        default:
            return true;
        }
    }
};

} // namespace tri
} // namespace vcg

#endif
