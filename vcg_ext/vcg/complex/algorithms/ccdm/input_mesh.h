// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_INPUT_MESH_H
#define VCG_CCDM_INPUT_MESH_H

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <vcg/complex/algorithms/ccdm/feature_graph.h>
#include <vcg/complex/algorithms/ccdm/geometry.h>
#include <vcg/complex/algorithms/ccdm/parameters.h>
#include <vcg/complex/algorithms/ccdm/patch_schedule.h>
#include <vcg/complex/algorithms/ccdm/verification.h>

namespace vcg {
namespace ccdm {

/// A triangle mesh as plain tables: what the remesher takes and gives back.
struct MeshTables {
    std::vector<Point> position;
    std::vector<std::array<int, 3>> face; ///< vertex indices
    SideMarks marked;                     ///< features: one bit a side, opposite corner 0, 1, 2; empty: none
    SideMarks locked;                     ///< the same: boundary sides that stay as they are, undivided
    std::vector<double> field;            ///< wanted density at each vertex; empty: none
    std::vector<int> vertexName;          ///< what messages call each vertex; empty: its index
};

/// Whether a face names a vertex twice.
inline bool RepeatsVertex(const std::array<int, 3> &f)
{
    return f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
}

/// A number with its noun.
inline std::string Counted(int n, const char *one, const char *many)
{
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// The first few of a list of places in words, such as ": vertices 3, 7 and 2 more".
template <class Place, class Words>
std::string Listed(const char *one, const char *many, const std::vector<Place> &places, int count, const Words &words)
{
    constexpr std::size_t most = 5;
    std::string list = std::string(": ") + (count == 1 ? one : many);
    const std::size_t shown = std::min(most, places.size());
    for (std::size_t k = 0; k < shown; ++k)
        list += (k == 0 ? " " : ", ") + words(places[k]);
    const int left = count - static_cast<int>(shown);
    return left > 0 ? list + " and " + std::to_string(left) + " more" : list;
}

/// The input made ready: unreferenced vertices and faces that repeat a vertex dropped, scaled to about
/// unit size, coherently oriented as far as that goes, and numbered along a space-filling curve, so
/// that the result does not depend on the numbering of the input.
class InputMesh
{
public:
    MeshTables mesh;
    Triangulation tables;          ///< of the mesh, glued; empty if the input is refused before
    std::vector<int> original;     ///< vertex of the caller's mesh for each vertex
    std::vector<int> originalFace; ///< face of the caller's mesh for each face
    InputDefects defects;
    TopologyCounts topology;
    bool edgesWithoutLength = false;
    std::string refusal; ///< why the input cannot be remeshed; empty if it can

    InputMesh(const MeshTables &input, Workers &workers)
    {
        if (Select(input, workers) && CheckEdges(workers) && CheckVertices(workers)) {
            mesh.marked = Renumbered(input, input.marked);
            mesh.locked = Renumbered(input, input.locked);
            CheckArea();
        }
    }
    explicit InputMesh(const MeshTables &input) : InputMesh(input, *std::make_unique<Workers>(1)) {}

    /// Back from unit size to the caller's coordinates.
    Point Restore(const Point &p) const { return p * _scale + _center; }
    /// The caller's length of one unit.
    double Scale() const { return _scale; }

private:
    Point _center = Point(0, 0, 0);
    double _scale = 1;
    std::vector<int> _name; // of the input's vertices, if they have any

    // Without squares that are out of range where the lengths are not.
    static double Diagonal(const Bounds &box)
    {
        const Point size = box.high - box.low;
        const double extent = std::max({size[0], size[1], size[2]});
        return extent > 0 && std::isfinite(extent) ? extent * Norm(size / extent) : extent;
    }

    // What the caller calls a vertex of the input.
    int Name(int v) const { return _name.empty() ? v : _name[v]; }

    // The first of the refused vertices, as the caller calls them, and a list in words.
    std::string ListVertices(std::vector<int> refused)
    {
        for (int &v : refused)
            v = Name(v);
        std::sort(refused.begin(), refused.end());
        const int count = static_cast<int>(refused.size());
        refused.resize(std::min(refused.size(), InputDefects::MostPlaces));
        defects.refusedVertices = refused;
        return Listed("vertex", "vertices", refused, count, [](int v) { return std::to_string(v); });
    }

    bool Refuse(const std::string &why)
    {
        refusal = why;
        return false;
    }

    bool Select(const MeshTables &input, Workers &workers)
    {
        _name = input.vertexName;
        if (input.face.empty())
            return Refuse(input.position.empty() ? "the mesh is empty" : "the mesh has no faces");
        std::vector<char> used(input.position.size(), 0);
        std::vector<int> faces;
        for (std::size_t t = 0; t < input.face.size(); ++t) {
            const auto &f = input.face[t];
            if (RepeatsVertex(f)) {
                ++defects.repeatedIndexFaces;
                continue;
            }
            faces.push_back(static_cast<int>(t));
            for (const int v : f)
                used[v] = 1;
        }
        if (faces.empty())
            return Refuse("every face names a vertex twice");
        Bounds box;
        std::vector<int> kept, nonFinite, badDensity;
        for (std::size_t v = 0; v < used.size(); ++v) {
            const Point &p = input.position[v];
            if (!used[v]) {
                ++defects.unreferencedVertices;
                continue;
            }
            kept.push_back(static_cast<int>(v));
            if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
                nonFinite.push_back(static_cast<int>(v));
            else
                box.Add(p);
            if (!input.field.empty() && !(std::isfinite(input.field[v]) && input.field[v] >= 0))
                badDensity.push_back(static_cast<int>(v));
        }
        defects.nonFiniteVertices = static_cast<int>(nonFinite.size());
        defects.badDensityVertices = static_cast<int>(badDensity.size());
        if (defects.nonFiniteVertices > 0)
            return Refuse(Counted(defects.nonFiniteVertices, "vertex has", "vertices have") +
                          " coordinates that are not finite" + ListVertices(nonFinite));
        if (defects.badDensityVertices > 0)
            return Refuse(Counted(defects.badDensityVertices, "vertex has", "vertices have") +
                          " a density that is negative or not finite" + ListVertices(badDensity));
        // A power of two scales without rounding.
        const double diagonal = Diagonal(box);
        if (!(diagonal > 0) || !std::isfinite(diagonal))
            return Refuse(diagonal > 0 ? "the mesh is too large for its coordinates" : "all vertices lie at one point");
        _center = (box.low + box.high) * 0.5;
        _scale = std::exp2(std::ceil(std::log2(diagonal)));
        Number(input, kept, faces, workers);
        return true;
    }

    void Number(const MeshTables &input, const std::vector<int> &kept, const std::vector<int> &faces, Workers &workers)
    {
        std::vector<Point> unit;
        unit.reserve(kept.size());
        for (const int v : kept)
            unit.push_back((input.position[v] - _center) / _scale);
        std::vector<int> newIndex(input.position.size(), -1);
        for (const int k : SpatialOrder(unit, workers)) {
            newIndex[kept[k]] = static_cast<int>(original.size());
            original.push_back(kept[k]);
            mesh.position.push_back(unit[k]);
            if (!input.field.empty())
                mesh.field.push_back(input.field[kept[k]]);
        }
        // Faces start at their first vertex and follow one another by vertices.
        std::vector<int> start(original.size() + 1, 0);
        auto smallest = [&](int t) {
            const auto &f = input.face[t];
            return std::min({newIndex[f[0]], newIndex[f[1]], newIndex[f[2]]});
        };
        for (const int t : faces)
            ++start[smallest(t) + 1];
        for (std::size_t v = 0; v < original.size(); ++v)
            start[v + 1] += start[v];
        std::vector<int> order(faces.size());
        std::vector<int> fill(start.begin(), start.end() - 1);
        for (const int t : faces)
            order[fill[smallest(t)]++] = t;
        mesh.face.resize(faces.size());
        for (std::size_t k = 0; k < order.size(); ++k) {
            const auto &f = input.face[order[k]];
            int first = 0;
            while (newIndex[f[first]] != smallest(order[k]))
                ++first;
            for (int i = 0; i < 3; ++i)
                mesh.face[k][i] = newIndex[f[(first + i) % 3]];
        }
        // Within the run of one first vertex, by the other two.
        std::vector<int> run;
        std::vector<std::array<int, 3>> sortedFace(faces.size());
        originalFace.resize(faces.size());
        for (std::size_t v = 0; v < original.size(); ++v) {
            run.resize(start[v + 1] - start[v]);
            std::iota(run.begin(), run.end(), start[v]);
            std::sort(run.begin(), run.end(), [&](int a, int b) { return mesh.face[a] < mesh.face[b]; });
            for (std::size_t k = 0; k < run.size(); ++k) {
                sortedFace[start[v] + k] = mesh.face[run[k]];
                originalFace[start[v] + k] = order[run[k]];
            }
        }
        mesh.face.swap(sortedFace);
    }

    // Marks of the caller's sides on the faces as they are numbered now.
    SideMarks Renumbered(const MeshTables &input, const SideMarks &marks) const
    {
        SideMarks own(marks.empty() ? 0 : mesh.face.size(), 0);
        for (std::size_t t = 0; t < own.size(); ++t) {
            const int from = originalFace[t];
            for (int i = 0; i < 3; ++i)
                for (int k = 0; k < 3; ++k)
                    if (input.face[from][k] == original[mesh.face[t][i]] && ((marks[from] >> k) & 1))
                        own[t] = static_cast<std::uint8_t>(own[t] | (1U << i));
        }
        return own;
    }

    // The faces are in the order of their first vertices, which are their lowest.
    bool CheckEdges(Workers &workers)
    {
        const std::size_t vertices = mesh.position.size();
        std::vector<int> startFace(vertices + 1, 0), start(vertices + 1, 0);
        for (const auto &f : mesh.face) {
            ++startFace[f[0] + 1];
            start[f[0] + 1] += 2;
            ++start[std::min(f[1], f[2]) + 1];
        }
        for (std::size_t v = 0; v < vertices; ++v) {
            startFace[v + 1] += startFace[v];
            start[v + 1] += start[v];
        }
        std::vector<int> other(start.back());
        std::vector<int> fill(start.begin(), start.end() - 1);
        for (const auto &f : mesh.face) {
            const auto [low, high] = std::minmax(f[1], f[2]);
            other[fill[f[0]]++] = low;
            other[fill[f[0]]++] = high;
            other[fill[low]++] = high;
        }
        struct Found {
            int duplicates = 0, edges = 0;
        };
        const auto look = [&](int first, int last, Found &found) {
            std::vector<std::pair<int, int>> opposite;
            for (int v = first; v < last; ++v) {
                found.duplicates += CountRepeatedFaces(startFace[v], startFace[v + 1], opposite);
                std::sort(other.begin() + start[v], other.begin() + start[v + 1]);
                found.edges += CountRunsOverTwo(other, start[v], start[v + 1]);
            }
        };
        for (const Found &found : Chunks::Collect<Found>(workers, static_cast<int>(vertices), look)) {
            defects.duplicateFaces += found.duplicates;
            defects.nonManifoldEdges += found.edges;
        }
        if (defects.nonManifoldEdges > 0)
            return Refuse(Counted(defects.nonManifoldEdges, "edge has", "edges have") + " more than two faces" +
                          ListCrowdedEdges(other, start));
        if (defects.duplicateFaces > 0)
            return Refuse(Counted(defects.duplicateFaces, "face repeats", "faces repeat") +
                          " the three vertices of another" + ListRepeatedFaces());
        return true;
    }

    // From the larger ends of all sides, sorted for each smaller one.
    std::string ListCrowdedEdges(const std::vector<int> &other, const std::vector<int> &start)
    {
        std::vector<std::array<int, 2>> edges;
        for (std::size_t v = 0; v + 1 < start.size(); ++v)
            for (int k = start[v]; k + 2 < start[v + 1]; ++k)
                if (other[k] == other[k + 2] && (k == start[v] || other[k] != other[k - 1])) {
                    const auto [a, b] = std::minmax({Name(original[v]), Name(original[other[k]])});
                    edges.push_back({a, b});
                }
        std::sort(edges.begin(), edges.end());
        edges.resize(std::min(edges.size(), InputDefects::MostPlaces));
        defects.refusedEdges = edges;
        return Listed("vertices", "vertices", edges, defects.nonManifoldEdges,
                      [](const auto &e) { return std::to_string(e[0]) + "-" + std::to_string(e[1]); });
    }

    // By their vertices.
    std::string ListRepeatedFaces()
    {
        std::vector<std::array<int, 3>> faces;
        for (const auto &f : mesh.face) {
            faces.push_back({Name(original[f[0]]), Name(original[f[1]]), Name(original[f[2]])});
            std::sort(faces.back().begin(), faces.back().end());
        }
        std::sort(faces.begin(), faces.end());
        std::vector<std::array<int, 3>> repeated;
        for (std::size_t k = 1; k < faces.size(); ++k)
            if (faces[k] == faces[k - 1])
                repeated.push_back(faces[k]);
        return Listed("vertices", "vertices", repeated, defects.duplicateFaces, [](const auto &f) {
            return std::to_string(f[0]) + "-" + std::to_string(f[1]) + "-" + std::to_string(f[2]);
        });
    }

    // Of faces [first, last), which share their lowest vertex; `opposite` is scratch.
    int CountRepeatedFaces(int first, int last, std::vector<std::pair<int, int>> &opposite) const
    {
        opposite.clear();
        for (int t = first; t < last; ++t)
            opposite.push_back(std::minmax(mesh.face[t][1], mesh.face[t][2]));
        std::sort(opposite.begin(), opposite.end());
        int count = 0;
        for (std::size_t k = 1; k < opposite.size(); ++k)
            count += opposite[k] == opposite[k - 1];
        return count;
    }

    // Runs of more than two equal numbers in sorted[first, last).
    static int CountRunsOverTwo(const std::vector<int> &sorted, int first, int last)
    {
        int count = 0;
        for (int k = first; k < last;) {
            int end = k;
            while (end < last && sorted[end] == sorted[k])
                ++end;
            count += end - k > 2;
            k = end;
        }
        return count;
    }

    bool CheckVertices(Workers &workers)
    {
        const int vertices = static_cast<int>(mesh.position.size());
        tables.Build(vertices, mesh.face);
        std::vector<int> corners(mesh.position.size(), 0);
        for (const auto &f : mesh.face)
            for (const int v : f)
                ++corners[v];
        const auto joints =
            Chunks::CollectList<int>(workers, vertices, [&](int first, int last, std::vector<int> &found) {
                Star star;
                for (int v = first; v < last; ++v) {
                    tables.GatherStar(v, star);
                    if (star.Triangles() != corners[v])
                        found.push_back(original[v]);
                }
            });
        defects.nonManifoldVertices = static_cast<int>(joints.size());
        if (!joints.empty())
            return Refuse(Counted(defects.nonManifoldVertices, "vertex joins", "vertices join") +
                          " several sheets (the faces there form more than one fan)" + ListVertices(joints));
        if (Orient())
            tables.Build(vertices, mesh.face);
        const Verification proof(tables, workers);
        topology = proof.counts;
        return proof.fault.empty() || Refuse(proof.fault);
    }

    // Turns faces so that each component is coherent and most of its faces stay as they are; across the seams of a
    // one-sided surface neighbours stay as they are. Whether any face was turned.
    bool Orient()
    {
        std::vector<signed char> turn(mesh.face.size(), 0);
        std::vector<int> queue;
        for (std::size_t t0 = 0; t0 < mesh.face.size(); ++t0) {
            if (turn[t0] != 0)
                continue;
            turn[t0] = 1;
            queue.assign(1, static_cast<int>(t0));
            std::size_t against = 0;
            for (std::size_t k = 0; k < queue.size(); ++k)
                for (int e = 0; e < 3; ++e) {
                    const Side s = MakeSide(queue[k], e), mate = tables.Mate(s);
                    if (mate == NoSide || turn[SideTriangle(mate)] != 0)
                        continue;
                    const bool turned = (turn[queue[k]] < 0) == tables.Coherent(s);
                    turn[SideTriangle(mate)] = turned ? -1 : 1;
                    against += turned;
                    queue.push_back(SideTriangle(mate));
                }
            if (2 * against > queue.size())
                for (const int t : queue)
                    turn[t] = static_cast<signed char>(-turn[t]);
        }
        for (std::size_t t = 0; t < mesh.face.size(); ++t) {
            if (turn[t] > 0)
                continue;
            ++defects.turnedFaces;
            std::swap(mesh.face[t][1], mesh.face[t][2]);
        }
        return defects.turnedFaces > 0;
    }

    void CheckArea()
    {
        double total = 0;
        for (const auto &f : mesh.face) {
            const Point a = mesh.position[f[1]] - mesh.position[f[0]], b = mesh.position[f[2]] - mesh.position[f[0]];
            const double area = Norm(Cross(a, b)) / 2;
            const double longest = std::max({SquaredNorm(a), SquaredNorm(b), SquaredNorm(b - a)});
            defects.zeroAreaFaces += !(area > 5e-13 * longest);
            edgesWithoutLength =
                edgesWithoutLength || SquaredNorm(a) == 0 || SquaredNorm(b) == 0 || SquaredNorm(b - a) == 0;
            total += area;
        }
        if (!(total > 1e-12))
            Refuse("the surface has no area");
    }
};

} // namespace ccdm
} // namespace vcg

#endif
