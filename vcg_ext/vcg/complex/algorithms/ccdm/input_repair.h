// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_INPUT_REPAIR_H
#define VCG_CCDM_INPUT_REPAIR_H

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/disjoint_sets.h>
#include <vcg/complex/algorithms/ccdm/input_mesh.h>

namespace vcg {
namespace ccdm {

/// A mesh with its defects mended. Vertices and faces keep their numbers: a face that is dropped names one vertex
/// three times, a vertex that is merged into another is used no more, and new vertices come last.
class InputRepair
{
public:
    MeshTables mesh;
    std::vector<int> copied; ///< the caller's vertex that each new one is a copy of
    int droppedFaces = 0;    ///< that repeated another
    int mergedVertices = 0;
    int cutEdges = 0;
    int cutVertices = 0;

    enum class Step {
        Sew,      ///< pairs of boundaries at equal positions
        CutApart, ///< edges of more than two faces, and vertices of more than one fan
        Contract  ///< edges without length
    };

    /// Faces that repeat another are dropped first.
    InputRepair(const MeshTables &input, Step step) : mesh(input)
    {
        DropRepeatedFaces();
        switch (step) {
        case Step::Sew:
            Sew();
            break;
        case Step::CutApart:
            CutApart();
            break;
        case Step::Contract:
            Contract();
            break;
        }
    }

    bool Changed() const { return droppedFaces + mergedVertices + cutVertices > 0; }

private:
    struct Use {
        int a, b;         // ends, a < b
        int face, corner; // the corner is opposite
        bool operator<(const Use &o) const
        {
            return std::tie(a, b, face, corner) < std::tie(o.a, o.b, o.face, o.corner);
        }
    };

    // The sides of all faces by their ends.
    std::vector<Use> Sides() const
    {
        std::vector<Use> use;
        for (std::size_t t = 0; t < mesh.face.size(); ++t)
            for (int k = 0; k < 3 && !RepeatsVertex(mesh.face[t]); ++k) {
                const auto [a, b] = std::minmax(mesh.face[t][Next(k)], mesh.face[t][Prev(k)]);
                use.push_back({a, b, static_cast<int>(t), k});
            }
        std::sort(use.begin(), use.end());
        return use;
    }

    // Calls visit(first, last) for each run of sides with the same ends.
    template <class Visit>
    static void VisitEdges(const std::vector<Use> &use, const Visit &visit)
    {
        for (auto first = use.begin(); first != use.end();) {
            auto last = first;
            while (last != use.end() && last->a == first->a && last->b == first->b)
                ++last;
            visit(first, last);
            first = last;
        }
    }

    // All but the first of the faces on three vertices, but for a pair that is a closed surface by itself.
    void DropRepeatedFaces()
    {
        std::vector<std::array<int, 4>> sorted; // vertices in order, face
        std::vector<char> crowded(mesh.face.size(), 0);
        for (std::size_t t = 0; t < mesh.face.size(); ++t) {
            std::array<int, 3> v = mesh.face[t];
            std::sort(v.begin(), v.end());
            sorted.push_back({v[0], v[1], v[2], static_cast<int>(t)});
        }
        std::sort(sorted.begin(), sorted.end());
        const auto same = [](const auto &x, const auto &y) { return std::equal(x.begin(), x.begin() + 3, y.begin()); };
        if (std::adjacent_find(sorted.begin(), sorted.end(), same) == sorted.end())
            return;
        VisitEdges(Sides(), [&](auto first, auto last) {
            for (auto use = first; use != last && last - first > 2; ++use)
                crowded[use->face] = 1;
        });
        for (std::size_t k = 1; k < sorted.size(); ++k) {
            const int t = sorted[k][3];
            if (!same(sorted[k], sorted[k - 1]) || crowded[t] == 0)
                continue;
            mesh.face[t].fill(mesh.face[t][0]);
            ++droppedFaces;
        }
    }

    // Joins pairs of boundary sides whose ends lie at the same two positions, where there are just two, and the
    // surface goes on from one to the other: a sheet that is folded onto itself stays one.
    void Sew()
    {
        std::vector<Use> open;
        VisitEdges(Sides(), [&](auto first, auto last) {
            if (last - first == 1)
                open.push_back(*first);
        });
        std::vector<int> rim; // vertices of those sides, by position
        for (const Use &u : open)
            rim.insert(rim.end(), {u.a, u.b});
        const auto before = [&](int a, int b) {
            const Point &p = mesh.position[a], &q = mesh.position[b];
            return std::tie(p[0], p[1], p[2], a) < std::tie(q[0], q[1], q[2], b);
        };
        const auto finite = [&](int v) {
            const Point &p = mesh.position[v];
            return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
        };
        rim.erase(std::remove_if(rim.begin(), rim.end(), [&](int v) { return !finite(v); }), rim.end());
        std::sort(rim.begin(), rim.end(), before);
        rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
        std::vector<int> place(mesh.position.size());
        std::iota(place.begin(), place.end(), 0);
        for (std::size_t k = 1; k < rim.size(); ++k)
            if (mesh.position[rim[k]] == mesh.position[rim[k - 1]])
                place[rim[k]] = place[rim[k - 1]];
        for (Use &u : open) {
            const auto [a, b] = std::minmax(place[u.a], place[u.b]);
            u.a = a;
            u.b = b;
        }
        std::sort(open.begin(), open.end());
        DisjointSets merged(mesh.position.size());
        VisitEdges(open, [&](auto first, auto last) {
            if (last - first != 2 || first->a == first->b || FoldsBack(*first, *(first + 1)))
                return;
            for (const int i : {1, 2})
                for (const int k : {1, 2}) {
                    const int v = mesh.face[first->face][(first->corner + i) % 3];
                    const int w = mesh.face[(first + 1)->face][((first + 1)->corner + k) % 3];
                    if (place[v] == place[w])
                        merged.Join(v, w);
                }
        });
        Merge(merged);
    }

    // Makes one vertex of those that edges without length join; the faces at these edges vanish.
    void Contract()
    {
        DisjointSets merged(mesh.position.size());
        for (const auto &f : mesh.face)
            for (int k = 0; k < 3; ++k)
                if (mesh.position[f[k]] == mesh.position[f[Next(k)]])
                    merged.Join(f[k], f[Next(k)]);
        Merge(merged);
    }

    void Merge(DisjointSets &merged)
    {
        for (int v = 0; v < static_cast<int>(mesh.position.size()); ++v)
            mergedVertices += merged.SetOf(v) != v;
        for (auto &f : mesh.face)
            for (int &v : f)
                v = merged.SetOf(v);
    }

    // Whether two faces on one edge lie on each other, to a degree.
    bool FoldsBack(const Use &one, const Use &other) const
    {
        const auto at = [&](const Use &u, int k) { return mesh.position[mesh.face[u.face][(u.corner + k) % 3]]; };
        const Point p = at(one, 1), edge = at(one, 2) - p;
        const double length = SquaredNorm(edge);
        const auto away = [&](const Use &u) {
            const Point w = at(u, 0) - p;
            return length > 0 ? Point(w - edge * (Dot(w, edge) / length)) : w;
        };
        const Point a = away(one), b = away(other);
        constexpr double cosine = 0.9998476951563913; // of 1 degree
        return Dot(a, b) > cosine * std::sqrt(SquaredNorm(a) * SquaredNorm(b));
    }

    // Gives each fan of a vertex, where the edges of more than two faces end one, a vertex of its own. That always
    // does: a fan has two ends, so not more than two faces still share an edge.
    void CutApart()
    {
        DisjointSets corner(3 * mesh.face.size());
        const auto cornerAt = [&](int t, int v) {
            const auto &f = mesh.face[t];
            return 3 * t + static_cast<int>(std::find(f.begin(), f.end(), v) - f.begin());
        };
        VisitEdges(Sides(), [&](auto first, auto last) {
            cutEdges += last - first > 2;
            if (last - first != 2)
                return;
            for (const int v : {first->a, first->b})
                corner.Join(cornerAt(first->face, v), cornerAt((first + 1)->face, v));
        });
        const std::size_t vertices = mesh.position.size();
        std::vector<int> fanOf(vertices, -1); // the first fan keeps the vertex
        std::vector<char> cut(vertices, 0);
        std::vector<int> newIndex(3 * mesh.face.size()); // for each other fan, by its first corner
        for (std::size_t t = 0; t < mesh.face.size(); ++t)
            for (int k = 0; k < 3 && !RepeatsVertex(mesh.face[t]); ++k) {
                const int c = 3 * static_cast<int>(t) + k, v = mesh.face[t][k], fan = corner.SetOf(c);
                if (fanOf[v] < 0)
                    fanOf[v] = fan;
                if (fan == c) {
                    newIndex[c] = fan == fanOf[v] ? v : static_cast<int>(vertices + copied.size());
                    if (fan != fanOf[v]) {
                        Copy(v);
                        cut[v] = 1;
                    }
                }
            }
        cutVertices = static_cast<int>(std::count(cut.begin(), cut.end(), 1));
        for (std::size_t t = 0; t < mesh.face.size(); ++t)
            if (!RepeatsVertex(mesh.face[t])) {
                std::array<int, 3> f;
                for (int k = 0; k < 3; ++k)
                    f[k] = newIndex[corner.SetOf(3 * static_cast<int>(t) + k)];
                mesh.face[t] = f;
            }
    }

    void Copy(int v)
    {
        copied.push_back(v);
        mesh.position.push_back(Point(mesh.position[v]));
        if (!mesh.field.empty())
            mesh.field.push_back(mesh.field[v]);
        if (!mesh.vertexName.empty())
            mesh.vertexName.push_back(mesh.vertexName[v]);
    }
};

/// The input as the remesher takes it: as it is if it is a surface, else mended if that makes it one.
class SoundInput
{
public:
    SoundInput(const MeshTables &input, RepairKind kind, Workers &workers)
        : _input(input), _maySplit(kind != RepairKind::Split && input.locked.empty()),
          _prepared(std::make_unique<InputMesh>(input, workers))
    {
        // What must stay is part of a larger mesh, which is not taken in hand.
        if (!input.locked.empty())
            return;
        if (!_prepared->refusal.empty() || (_prepared->topology.boundaryLoops > 0 && MayBeSewn()))
            Try(InputRepair::Step::Sew, workers);
        if (!_prepared->refusal.empty() && kind == RepairKind::Split)
            Try(InputRepair::Step::CutApart, workers);
        if (_prepared->refusal.empty() && _prepared->edgesWithoutLength)
            Try(InputRepair::Step::Contract, workers);
    }

    InputMesh &Prepared() { return *_prepared; }

    /// To end a refusal with: the repair that would take what was refused; empty if none would.
    std::string Hint() const
    {
        const InputDefects &d = _prepared->defects;
        const bool helps = _maySplit && d.duplicateFaces == 0 && (d.nonManifoldEdges > 0 || d.nonManifoldVertices > 0);
        return helps ? "; the repair 'split' cuts it apart there" : "";
    }

    /// What Prepared() was made of. The caller's numbers hold, but for vertices that were added at the end.
    const MeshTables &Tables() const { return _repaired ? _repaired->mesh : _input; }

    /// The caller's vertex of one of Tables().
    int CallersVertex(int v) const
    {
        const int own = static_cast<int>(_input.position.size());
        return v < own ? v : _copied[static_cast<std::size_t>(v - own)];
    }

private:
    const MeshTables &_input;
    const bool _maySplit; // that kind of repair was not asked for
    std::unique_ptr<InputMesh> _prepared;
    std::unique_ptr<InputRepair> _repaired;
    std::vector<int> _copied; // by all steps

    // Whether two vertices of the boundary lie at one position.
    bool MayBeSewn() const
    {
        std::vector<char> open(_prepared->mesh.position.size(), 0);
        for (int t = 0; t < _prepared->tables.TriangleCount(); ++t)
            for (int k = 0; k < 3; ++k)
                if (_prepared->tables.Mate(MakeSide(t, k)) == NoSide)
                    for (const int e : {Next(k), Prev(k)})
                        open[_prepared->mesh.face[t][e]] = 1;
        std::vector<Point> rim;
        for (std::size_t v = 0; v < open.size(); ++v)
            if (open[v] != 0)
                rim.push_back(_prepared->mesh.position[v]);
        std::sort(rim.begin(), rim.end());
        return std::adjacent_find(rim.begin(), rim.end()) != rim.end();
    }

    // Takes what the step makes if that is a surface, and, when edges are contracted, of the same type.
    void Try(InputRepair::Step step, Workers &workers)
    {
        auto repaired = std::make_unique<InputRepair>(Tables(), step);
        if (!repaired->Changed())
            return;
        auto again = std::make_unique<InputMesh>(repaired->mesh, workers);
        if (!again->refusal.empty() ||
            (step == InputRepair::Step::Contract && !again->topology.SameTypeAs(_prepared->topology)))
            return;
        // What an earlier step has mended counts, what the input was refused for does not.
        const InputDefects &before = _prepared->defects, mended = _repaired ? before : InputDefects();
        InputDefects &d = again->defects;
        d.nonManifoldEdges = mended.nonManifoldEdges + repaired->cutEdges;
        d.nonManifoldVertices = mended.nonManifoldVertices + repaired->cutVertices;
        d.duplicateFaces = mended.duplicateFaces + repaired->droppedFaces;
        d.mergedVertices = mended.mergedVertices + repaired->mergedVertices;
        d.copiedVertices = mended.copiedVertices + static_cast<int>(repaired->copied.size());
        d.unreferencedVertices -= d.mergedVertices;
        d.repeatedIndexFaces = before.repeatedIndexFaces;
        d.zeroAreaFaces = std::max(d.zeroAreaFaces, before.zeroAreaFaces);
        d.turnedFaces = std::max(d.turnedFaces, before.turnedFaces);
        _copied.insert(_copied.end(), repaired->copied.begin(), repaired->copied.end());
        _prepared = std::move(again);
        _repaired = std::move(repaired);
    }
};

} // namespace ccdm
} // namespace vcg

#endif
