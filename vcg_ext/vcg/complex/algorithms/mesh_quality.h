// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_MESH_QUALITY_H
#define VCG_MESH_QUALITY_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <vcg/complex/complex.h>
#include <vcg/space/point3.h>

#include <vcg/complex/algorithms/mesh_quality/self_intersections.h>
#include <vcg/complex/algorithms/mesh_quality/surface_distance.h>
#include <vcg/complex/algorithms/mesh_quality/two_at_a_time.h>

namespace vcg {
namespace tri {

/// Counts and shape of a triangle mesh. Angles in degrees.
struct MeshQualityReport {
    int vertices = 0;            ///< all that are not deleted
    int unreferenced = 0;        ///< those of them that no face uses
    int faces = 0;               ///< but for those that name a vertex twice
    int edges = 0;               ///< each counted once, however many faces it has
    int euler = 0;               ///< Euler characteristic of the referenced part
    int components = 0;          ///< joined over edges
    int boundaryLoops = 0;       ///< closed chains of edges of one face
    int nonManifoldEdges = 0;    ///< of more than two faces
    int nonManifoldVertices = 0; ///< of more than one fan
    int degenerateFaces = 0;     ///< an index repeats, or height / longest edge <= 1e-10
    bool orientable = true;      ///< whether the faces can be turned so that neighbours agree
    bool manifold = true;        ///< no edge of three faces, no vertex of two fans, no repeated face or index
    /// Handles of an orientable surface, cross-caps of another, summed over the components; unset for a
    /// surface that is not manifold.
    std::optional<double> genus;

    double angleMinAvg = 0; ///< mean over the faces of their smallest angle
    double angleMin = 0;    ///< smallest of all angles
    double angleMax = 0;    ///< largest of all angles
    double pctLt30 = 0;     ///< percentage of all angles below 30 degrees
    double qFb99Avg = 0;    ///< 2 sqrt(3) area / (half perimeter * longest edge) [FB99]; 1: equilateral
    double qFb99Min = 0;    ///< smallest of the same
    double pctValence6 = 0; ///< of the vertices off the boundary
    int foldedEdges = 0;    ///< edges whose faces turn by more than 150 degrees
    double area = 0;        ///< of all faces, in the mesh's units
};

/// Distances between two surfaces, relative to the bounding-box diagonal of the first.
struct SurfaceDistance {
    double hausdorff = 0;         ///< larger of the two directions
    double rms = 0;               ///< larger of the two directions
    double hausdorffForward = 0;  ///< from the first to the second
    double hausdorffBackward = 0; ///< from the second to the first
};

/// Pairs of faces that meet elsewhere than in what they share.
struct SelfIntersectionCounts {
    long long before = 0; ///< of the original
    long long after = 0;  ///< of the result
    int newFaces = 0;     ///< of the result in such pairs, further than two edges from where the original has any
};

/// A result beside its original.
struct MeshComparison {
    MeshQualityReport before;                 ///< of the original
    MeshQualityReport after;                  ///< of the result
    SurfaceDistance distance;                 ///< between them
    SelfIntersectionCounts selfIntersections; ///< of both
};

/// Metrics of any triangle mesh, manifold or not; the paper's, and those of its peers.
template <class MeshType>
class MeshQuality
{
public:
    /// Points on each surface by which distances are measured.
    static constexpr int DefaultSamples = 100000;

    /// Linear in the size of the mesh but for a sort. Reads positions and faces only.
    static MeshQualityReport Measure(const MeshType &m) { return Survey(TriangleSoup::From(m)).report; }

    /// All of it, of a result beside its original. `sewn`: as in CountSelfIntersections; `parallel`: on two threads, to
    /// the same figures.
    template <class OtherMesh>
    static MeshComparison Compare(const MeshType &original, const OtherMesh &result, bool sewn, bool parallel)
    {
        MeshComparison c;
        TwoAtATime(
            parallel, [&] { c.before = Measure(original); },
            [&] { c.after = MeshQuality<OtherMesh>::Measure(result); });
        c.distance = Distance(original, result, DefaultSamples, parallel);
        c.selfIntersections = CountSelfIntersections(original, result, sewn, parallel);
        return c;
    }

    /// Distances by `samples` points spread over each surface by area; the maximum also over all vertices
    /// and over the faces where it is nearly reached. Deterministic; `parallel`: the two directions at a time.
    template <class OtherMesh>
    static SurfaceDistance Distance(const MeshType &original, const OtherMesh &result, int samples = DefaultSamples,
                                    bool parallel = false)
    {
        TriangleSoup a = Solid(TriangleSoup::From(original));
        const UnitFrame frame(a);
        a = frame.Place(std::move(a));
        const TriangleSoup b = frame.Place(Solid(TriangleSoup::From(result)));
        const double diagonal = a.Diagonal();
        SurfaceDistance d;
        if (!(diagonal > 0) || a.face.empty() || b.face.empty())
            return d;
        Deviation forward, backward;
        TwoAtATime(
            parallel, [&] { forward = DeviationMeter(a, TriangleTree(b)).Measure(samples); },
            [&] { backward = DeviationMeter(b, TriangleTree(a)).Measure(samples); });
        d.hausdorffForward = forward.max / diagonal;
        d.hausdorffBackward = backward.max / diagonal;
        d.hausdorff = std::max(d.hausdorffForward, d.hausdorffBackward);
        d.rms = std::max(forward.rms, backward.rms) / diagonal;
        return d;
    }

    /// Exact, but for what is near in `newFaces`. `sewn`: vertices of the original at one position are one;
    /// `parallel`: on two threads.
    template <class OtherMesh>
    static SelfIntersectionCounts CountSelfIntersections(const MeshType &original, const OtherMesh &result,
                                                         bool sewn = false, bool parallel = false)
    {
        TriangleSoup a = TriangleSoup::From(original), b = TriangleSoup::From(result);
        if (sewn)
            Sew(a);
        const double scale = UnitFrame(a).Factor();
        a = Scaled(std::move(a), scale);
        b = Scaled(std::move(b), scale);
        const SelfIntersections before(a, parallel), after(b, parallel);
        SelfIntersectionCounts counts;
        counts.before = before.pairs;
        counts.after = after.pairs;
        counts.newFaces = static_cast<int>(after.face.size());
        if (before.face.empty() || after.face.empty())
            return counts;
        const UnitFrame frame(a);
        std::vector<TriangleSoup::Face> crossed;
        for (const int t : before.face)
            crossed.push_back(a.face[t]);
        a.face = crossed;
        a = frame.Place(std::move(a));
        b = frame.Place(std::move(b));
        const TriangleTree tree(a);
        int hint = -1;
        for (const int t : after.face) {
            const auto &[i, j, k] = b.face[t];
            const Vector &p = b.point[i], &q = b.point[j], &r = b.point[k];
            const double edge = std::max({(p - q).SquaredNorm(), (q - r).SquaredNorm(), (r - p).SquaredNorm()});
            counts.newFaces -= tree.SquaredDistance((p + q + r) / 3.0, hint) <= 4 * edge;
        }
        return counts;
    }

private:
    using Vector = TriangleSoup::Vector;
    using Face = TriangleSoup::Face;

    static bool Repeats(const Face &f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; }

    // Without the faces that name a vertex twice, which are no part of a surface.
    static TriangleSoup Solid(TriangleSoup s)
    {
        s.face.erase(std::remove_if(s.face.begin(), s.face.end(), Repeats), s.face.end());
        return s;
    }

    static void Sew(TriangleSoup &s)
    {
        std::vector<int> order(s.point.size()), first(s.point.size());
        std::iota(order.begin(), order.end(), 0);
        std::sort(order.begin(), order.end(),
                  [&](int x, int y) { return s.point[x] != s.point[y] ? s.point[x] < s.point[y] : x < y; });
        for (std::size_t k = 0; k < order.size(); ++k)
            first[order[k]] = k > 0 && s.point[order[k]] == s.point[order[k - 1]] ? first[order[k - 1]] : order[k];
        for (Face &f : s.face)
            for (int &v : f)
                v = first[v];
    }

    // By a power of two: squares of the mesh's own lengths might be out of range.
    static TriangleSoup Scaled(TriangleSoup s, double factor)
    {
        for (Vector &p : s.point)
            p *= factor;
        return s;
    }

    // Sets joined step by step; each member knows its orientation relative to its parent.
    class DisjointSets
    {
    public:
        explicit DisjointSets(std::size_t n) : _parent(n), _turned(n, 0)
        {
            std::iota(_parent.begin(), _parent.end(), 0);
        }
        int Find(int a, bool *turned = nullptr)
        {
            bool t = false;
            while (_parent[a] != a) {
                const int up = _parent[a];
                // Path halving keeps the chains short.
                _turned[a] = static_cast<char>(_turned[a] ^ _turned[up]);
                _parent[a] = _parent[up];
                t ^= _turned[a] != 0;
                a = _parent[a];
            }
            if (turned != nullptr)
                *turned = t;
            return a;
        }
        /// False when they are joined already with the other relative orientation.
        bool Join(int a, int b, bool turned = false)
        {
            bool ta = false, tb = false;
            const int ra = Find(a, &ta), rb = Find(b, &tb);
            if (ra == rb)
                return (ta ^ tb) == turned;
            _parent[ra] = rb;
            _turned[ra] = static_cast<char>(ta ^ tb ^ turned);
            return true;
        }

    private:
        std::vector<int> _parent;
        std::vector<char> _turned;
    };

    // One use of an edge by a face: `apex` is the face's corner opposite to it.
    struct EdgeUse {
        int low, high, face, apex;
        bool forward;
        bool operator<(const EdgeUse &o) const
        {
            return std::tie(low, high, face, apex) < std::tie(o.low, o.high, o.face, o.apex);
        }
    };

    struct Survey {
        const double scale;
        const TriangleSoup soup;
        MeshQualityReport report;
        std::vector<EdgeUse> use;

        explicit Survey(TriangleSoup s) : scale(UnitFrame(s).Factor()), soup(Scaled(std::move(s), scale))
        {
            report.vertices = static_cast<int>(soup.point.size());
            CollectEdges();
            CountTopology();
            MeasureFaces();
        }

        // Height over longest edge.
        static double Flatness(const Vector &a, const Vector &b, const Vector &c)
        {
            const double l = std::max({(b - a).SquaredNorm(), (c - b).SquaredNorm(), (a - c).SquaredNorm()});
            return l > 0 ? ((b - a) ^ (c - a)).Norm() / l : 0;
        }
        double Flatness(const Face &f) const { return Flatness(soup.point[f[0]], soup.point[f[1]], soup.point[f[2]]); }
        int CornerOf(int face, int vertex) const
        {
            const Face &f = soup.face[face];
            return 3 * face + (f[0] == vertex ? 0 : f[1] == vertex ? 1 : 2);
        }

        void CollectEdges()
        {
            for (std::size_t t = 0; t < soup.face.size(); ++t) {
                const Face &f = soup.face[t];
                if (Repeats(f)) {
                    ++report.degenerateFaces;
                    report.manifold = false;
                    continue;
                }
                ++report.faces;
                report.degenerateFaces += Flatness(f) <= 1e-10;
                for (int k = 0; k < 3; ++k) {
                    const int a = f[(k + 1) % 3], b = f[(k + 2) % 3];
                    use.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), k, a < b});
                }
            }
            std::sort(use.begin(), use.end());
        }

        void CountTopology()
        {
            const std::size_t corners = 3 * soup.face.size();
            // `fans` joins corners over any shared edge, `sheets` over edges of exactly two faces.
            DisjointSets faces(soup.face.size()), fans(corners), sheets(corners), turns(soup.face.size());
            std::vector<int> valence(soup.point.size(), 0);
            std::vector<char> boundary(soup.point.size(), 0);
            std::vector<std::pair<int, int>> open; // corners at the ends of boundary edges
            int sixes = 0, inner = 0;
            for (std::size_t i = 0; i < use.size();) {
                std::size_t j = i;
                while (j < use.size() && use[j].low == use[i].low && use[j].high == use[i].high)
                    ++j;
                ++report.edges;
                const EdgeUse &e = use[i];
                ++valence[e.low];
                ++valence[e.high];
                report.nonManifoldEdges += j - i > 2;
                if (j - i == 1) {
                    boundary[e.low] = boundary[e.high] = 1;
                    open.emplace_back(CornerOf(e.face, e.low), CornerOf(e.face, e.high));
                }
                for (std::size_t k = i + 1; k < j; ++k) {
                    faces.Join(e.face, use[k].face);
                    for (const int v : {e.low, e.high})
                        fans.Join(CornerOf(e.face, v), CornerOf(use[k].face, v));
                }
                if (j - i == 2) {
                    const EdgeUse &o = use[i + 1];
                    if (!turns.Join(e.face, o.face, e.forward == o.forward))
                        report.orientable = false;
                    for (const int v : {e.low, e.high})
                        sheets.Join(CornerOf(e.face, v), CornerOf(o.face, v));
                    report.foldedEdges += Folded(e, o);
                }
                i = j;
            }
            std::vector<int> fan(soup.point.size(), -1);
            std::vector<char> torn(soup.point.size(), 0);
            for (std::size_t t = 0; t < soup.face.size(); ++t) {
                if (Repeats(soup.face[t]))
                    continue;
                report.components += faces.Find(static_cast<int>(t)) == static_cast<int>(t);
                for (int k = 0; k < 3; ++k) {
                    const int v = soup.face[t][k], f = fans.Find(static_cast<int>(3 * t + k));
                    if (fan[v] >= 0 && fan[v] != f)
                        torn[v] = 1;
                    fan[v] = f;
                }
            }
            report.nonManifoldVertices = static_cast<int>(std::count(torn.begin(), torn.end(), char(1)));
            // A boundary loop runs from fan to fan, so that a bow-tie vertex does not join two loops.
            DisjointSets loops(corners);
            std::vector<char> onLoop(corners, 0);
            for (const auto &o : open) {
                const int a = sheets.Find(o.first), b = sheets.Find(o.second);
                onLoop[a] = onLoop[b] = 1;
                loops.Join(a, b);
            }
            for (std::size_t c = 0; c < corners; ++c)
                report.boundaryLoops += onLoop[c] && loops.Find(static_cast<int>(c)) == static_cast<int>(c);
            for (std::size_t v = 0; v < soup.point.size(); ++v) {
                report.unreferenced += fan[v] < 0;
                if (fan[v] >= 0 && !boundary[v]) {
                    ++inner;
                    sixes += valence[v] == 6;
                }
            }
            report.pctValence6 = inner > 0 ? 100.0 * sixes / inner : 0;
            report.euler = report.vertices - report.unreferenced - report.edges + report.faces;
            report.manifold =
                report.manifold && report.nonManifoldEdges == 0 && report.nonManifoldVertices == 0 && !HasDuplicates();
            const int handles = 2 * report.components - report.euler - report.boundaryLoops;
            if (report.manifold)
                report.genus = report.orientable ? handles / 2.0 : handles;
        }

        bool HasDuplicates() const
        {
            std::vector<Face> sorted;
            for (Face f : soup.face) {
                std::sort(f.begin(), f.end());
                sorted.push_back(f);
            }
            std::sort(sorted.begin(), sorted.end());
            return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
        }

        // Whether the faces turn by more than 150 degrees, whatever their orientation in the file.
        bool Folded(const EdgeUse &x, const EdgeUse &y) const
        {
            const Vector &a = soup.point[x.low], &b = soup.point[x.high];
            const Vector &p = soup.point[soup.face[x.face][x.apex]], &q = soup.point[soup.face[y.face][y.apex]];
            if (Flatness(a, b, p) <= 1e-10 || Flatness(a, b, q) <= 1e-10)
                return false;
            const Vector n1 = (b - a) ^ (p - a), n2 = (q - a) ^ (b - a);
            return std::atan2((n1 ^ n2).Norm(), n1 * n2) > 150 * M_PI / 180;
        }

        void MeasureFaces()
        {
            double sumMin = 0, sumQ = 0, low = 180, high = 0, lowQ = 1;
            std::int64_t below = 0;
            for (const Face &f : soup.face) {
                if (Repeats(f))
                    continue;
                double smallest = 180, perimeter = 0, longest = 0;
                for (int k = 0; k < 3; ++k) {
                    const Vector u = soup.point[f[(k + 1) % 3]] - soup.point[f[k]];
                    const Vector w = soup.point[f[(k + 2) % 3]] - soup.point[f[k]];
                    const double angle = std::atan2((u ^ w).Norm(), u * w) * 180 / M_PI;
                    smallest = std::min(smallest, angle);
                    high = std::max(high, angle);
                    below += angle < 30;
                    perimeter += u.Norm();
                    longest = std::max(longest, u.Norm());
                }
                const Vector &a = soup.point[f[0]];
                const double area = ((soup.point[f[1]] - a) ^ (soup.point[f[2]] - a)).Norm() / 2;
                const double q = longest > 0 ? 4 * std::sqrt(3.0) * area / (perimeter * longest) : 0;
                report.area += area / (scale * scale);
                sumMin += smallest;
                sumQ += q;
                low = std::min(low, smallest);
                lowQ = std::min(lowQ, q);
            }
            if (report.faces == 0)
                return;
            report.angleMinAvg = sumMin / report.faces;
            report.angleMin = low;
            report.angleMax = high;
            report.pctLt30 = 100.0 * static_cast<double>(below) / (3.0 * report.faces);
            report.qFb99Avg = sumQ / report.faces;
            report.qFb99Min = lowQ;
        }
    };
};

} // namespace tri
} // namespace vcg

#endif
