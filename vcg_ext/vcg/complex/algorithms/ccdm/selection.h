// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_SELECTION_H
#define VCG_CCDM_SELECTION_H

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/disjoint_sets.h>
#include <vcg/complex/algorithms/ccdm/target_search.h>

namespace vcg {
namespace ccdm {

/// Remeshes the chosen faces of a mesh. The others and their vertices stay as they are, in their order; the edges
/// where the two meet stay too, so that the parts join without a gap.
class SelectionRemesher
{
public:
    SelectionRemesher(const Params &params, TargetSearch::Progress progress)
        : _params(params), _progress(std::move(progress))
    {
    }

    /// `chosen` has an entry for each face. `output` and, if there is one, `provenance` are filled only when the
    /// report's status is Done. The report's topology and angles are those of the remeshed part.
    Report Run(const MeshTables &whole, const std::vector<char> &chosen, MeshTables &output,
               Provenance *provenance = nullptr)
    {
        std::string refusal = Cut(whole, chosen);
        if (!refusal.empty())
            return Fail(Status::InvalidInput, refusal);
        Params params = _params;
        const int kept = static_cast<int>(_kept.size()), seam = static_cast<int>(_onSeam.size());
        if (_params.vertexCount != 0) {
            if (_params.vertexCount < kept)
                return Fail(Status::InvalidParameter, "the vertex count must be at least " + std::to_string(kept) +
                                                          ", as that many do not lie inside the selected faces");
            params.vertexCount = std::max(4, _params.vertexCount - kept + seam);
        }
        MeshTables part;
        Provenance of;
        Report report = TargetSearch(params, std::move(_progress)).Run(_part, part, &of);
        if (report.status != Status::Done)
            return report;
        MeshTables joined;
        refusal = Join(whole, part, of, joined);
        if (!refusal.empty())
            return Fail(Status::CheckFailed, "the result was thrown away: " + refusal);
        output = std::move(joined);
        report.keptVertices = kept;
        report.requestedVertices += kept - seam;
        if (report.target == TargetKind::Vertices) {
            report.asked = _params.vertexCount;
            report.reached = static_cast<double>(output.position.size());
            report.extraVertices = static_cast<int>(output.position.size()) - _params.vertexCount;
        }
        if (provenance != nullptr)
            *provenance = Translated(of);
        return report;
    }

private:
    const Params _params;
    TargetSearch::Progress _progress;
    MeshTables _part;
    std::vector<int> _partFace;             // of the whole, for each face of the part
    std::vector<int> _partVertex;           // of the whole, for each vertex of the part
    std::vector<int> _onSeam;               // vertices of the part that others use too
    std::vector<std::pair<int, int>> _seam; // edges between chosen faces and others, by vertices of the whole
    std::vector<int> _kept;                 // vertices of the whole that stay
    std::vector<int> _keptFace;
    std::vector<int> _newIndex; // in the output, for each vertex of the part after remeshing

    static Report Fail(Status status, const std::string &why)
    {
        Report report;
        report.status = status;
        report.message = why;
        return report;
    }

    struct EdgeUse {
        int a, b; // a < b
        int face, corner;
        bool operator<(const EdgeUse &o) const
        {
            return std::tie(a, b, face, corner) < std::tie(o.a, o.b, o.face, o.corner);
        }
    };

    // Takes the chosen faces out of the whole; returns why that cannot be done.
    std::string Cut(const MeshTables &whole, const std::vector<char> &chosen)
    {
        if (TargetSearch::NamesMissingVertices(whole))
            return "a face names a vertex that does not exist";
        for (std::size_t t = 0; t < whole.face.size(); ++t)
            if (chosen[t] == 0)
                _keptFace.push_back(static_cast<int>(t));
            else if (!RepeatsVertex(whole.face[t])) // which the remesher would drop
                _partFace.push_back(static_cast<int>(t));
        if (_partFace.empty())
            return "no face is selected";

        std::vector<char> byPart(whole.position.size(), 0), byOthers(whole.position.size(), 0), seam = byPart;
        std::vector<EdgeUse> use;
        for (std::size_t t = 0; t < whole.face.size(); ++t)
            for (int k = 0; k < 3 && !RepeatsVertex(whole.face[t]); ++k) {
                const int p = whole.face[t][Next(k)], q = whole.face[t][Prev(k)];
                (chosen[t] != 0 ? byPart : byOthers)[p] = 1;
                use.push_back({std::min(p, q), std::max(p, q), static_cast<int>(t), k});
            }
        std::sort(use.begin(), use.end());

        // The corners of the chosen faces at one vertex are one vertex of the part where edges join them; where
        // others lie between them, they are several.
        std::vector<int> partIndex(whole.face.size(), -1);
        for (std::size_t k = 0; k < _partFace.size(); ++k)
            partIndex[_partFace[k]] = static_cast<int>(k);
        DisjointSets corners(3 * _partFace.size());
        const auto cornerAt = [&](int t, int v) {
            const auto &f = whole.face[t];
            return 3 * partIndex[t] + static_cast<int>(std::find(f.begin(), f.end(), v) - f.begin());
        };
        _part.locked.assign(_partFace.size(), 0);
        int crowded = 0;
        for (std::size_t first = 0; first < use.size();) {
            std::size_t last = first;
            std::vector<EdgeUse> here;
            for (; last < use.size() && use[last].a == use[first].a && use[last].b == use[first].b; ++last)
                if (chosen[use[last].face] != 0)
                    here.push_back(use[last]);
            const bool others = here.size() < last - first;
            if (others && !here.empty()) {
                crowded += here.size() > 1;
                _seam.emplace_back(use[first].a, use[first].b);
                seam[use[first].a] = seam[use[first].b] = 1;
                std::uint8_t &bits = _part.locked[partIndex[here[0].face]];
                bits = static_cast<std::uint8_t>(bits | (1U << here[0].corner));
            }
            for (std::size_t k = 1; k < here.size(); ++k)
                for (const int v : {use[first].a, use[first].b})
                    corners.Join(cornerAt(here[k].face, v), cornerAt(here[0].face, v));
            first = last;
        }
        if (crowded > 0)
            return Counted(crowded, "edge of the selection has", "edges of the selection have") +
                   " more than two faces";
        int pinched = 0;
        for (std::size_t v = 0; v < seam.size(); ++v) {
            pinched += byPart[v] != 0 && byOthers[v] != 0 && seam[v] == 0;
            if (byPart[v] == 0 || byOthers[v] != 0)
                _kept.push_back(static_cast<int>(v));
        }
        if (pinched > 0)
            return Counted(pinched, "vertex joins", "vertices join") + " selected faces and others that share no edge";

        std::map<std::pair<int, int>, int> index; // of a vertex of the whole and, on the seam, a set of corners
        for (const int t : _partFace) {
            std::array<int, 3> corner;
            for (int k = 0; k < 3; ++k) {
                const int v = whole.face[t][k];
                const auto [at, isNew] =
                    index.try_emplace(std::pair(v, seam[v] != 0 ? corners.SetOf(3 * partIndex[t] + k) : -1),
                                      static_cast<int>(_partVertex.size()));
                corner[k] = at->second;
                if (!isNew)
                    continue;
                if (seam[v] != 0)
                    _onSeam.push_back(at->second);
                _partVertex.push_back(v);
                _part.vertexName.push_back(v);
                _part.position.push_back(whole.position[v]);
                if (!whole.field.empty())
                    _part.field.push_back(whole.field[v]);
            }
            _part.face.push_back(corner);
            if (!whole.marked.empty())
                _part.marked.push_back(whole.marked[t]);
        }
        return "";
    }

    // What stays, then what is new; returns what is wrong with it.
    std::string Join(const MeshTables &whole, const MeshTables &part, const Provenance &of, MeshTables &joined)
    {
        std::vector<int> keptIndex(whole.position.size(), -1);
        for (const int v : _kept) {
            keptIndex[v] = static_cast<int>(joined.position.size());
            joined.position.push_back(whole.position[v]);
        }
        for (const int t : _keptFace) {
            const auto &f = whole.face[t];
            joined.face.push_back({keptIndex[f[0]], keptIndex[f[1]], keptIndex[f[2]]});
        }
        std::size_t found = 0;
        _newIndex.resize(part.position.size());
        for (std::size_t v = 0; v < part.position.size(); ++v) {
            const int same = of.sameVertex[v] < 0 ? -1 : keptIndex[_partVertex[of.sameVertex[v]]];
            found += same >= 0;
            _newIndex[v] = same >= 0 ? same : static_cast<int>(joined.position.size());
            if (same < 0)
                joined.position.push_back(part.position[v]);
        }
        for (const auto &f : part.face)
            joined.face.push_back({_newIndex[f[0]], _newIndex[f[1]], _newIndex[f[2]]});
        if (found != _onSeam.size())
            return "a vertex between the selected faces and the others is missing";

        // Faces at each edge that joins two kept vertices.
        std::map<std::pair<int, int>, int> faces;
        const int kept = static_cast<int>(_kept.size());
        for (const auto &[a, b] : _seam)
            faces[std::minmax(keptIndex[a], keptIndex[b])] = 0;
        for (std::size_t t = _keptFace.size(); t < joined.face.size(); ++t)
            Visit(joined.face[t], kept, [&](const std::pair<int, int> &edge) { ++faces[edge]; });
        for (std::size_t t = 0; t < _keptFace.size(); ++t)
            Visit(joined.face[t], kept, [&](const std::pair<int, int> &edge) {
                const auto at = faces.find(edge);
                if (at != faces.end())
                    ++at->second;
            });
        for (const auto &[a, b] : _seam)
            if (faces[std::minmax(keptIndex[a], keptIndex[b])] != 2)
                return "an edge between the selected faces and the others is missing";
        for (const auto &entry : faces)
            if (entry.second > 2)
                return "the selected faces would meet the others in an edge of more than two faces";
        return "";
    }

    template <class Function>
    static void Visit(const std::array<int, 3> &face, int kept, Function visit)
    {
        for (int k = 0; k < 3; ++k)
            if (face[Next(k)] < kept && face[Prev(k)] < kept)
                visit(std::minmax(face[Next(k)], face[Prev(k)]));
    }

    // In the numbers of the whole and of the output.
    Provenance Translated(const Provenance &of) const
    {
        Provenance p;
        p.keptVertices = static_cast<int>(_kept.size());
        p.keptFaces = static_cast<int>(_keptFace.size());
        p.vertex.resize(_kept.size());
        p.sameVertex = _kept;
        p.face = _keptFace;
        const auto translated = [&](SurfacePoint at) {
            at.face = _partFace[at.face];
            return at;
        };
        for (std::size_t v = 0; v < of.vertex.size(); ++v)
            if (_newIndex[v] >= p.keptVertices) {
                p.vertex.push_back(translated(of.vertex[v]));
                p.sameVertex.push_back(of.sameVertex[v] < 0 ? -1 : _partVertex[of.sameVertex[v]]);
            }
        for (const int t : of.face)
            p.face.push_back(_partFace[t]);
        for (const Provenance::SideCorner &c : of.onSides)
            p.onSides.push_back({c.face + p.keptFaces, c.corner, translated(c.at)});
        return p;
    }
};

} // namespace ccdm
} // namespace vcg

#endif
