// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_REFINEMENT_H
#define VCG_CCDM_REFINEMENT_H

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/patch_schedule.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>
#include <vcg/complex/algorithms/ccdm/vertex_removal.h>

namespace vcg {
namespace ccdm {

/// Splits every triangle of a remesh in four. The new vertices lie on the surface, those of feature edges on
/// their curves; between features that leave no room there are none. So a mesh that was improved when it was coarse
/// becomes a fine one with few irregular vertices.
class Refinement
{
public:
    Refinement(const Model &model, Remesh &remesh) : _model(model), _remesh(remesh) {}

    void Run()
    {
        Workers alone(1);
        Run(alone, std::numeric_limits<int>::max());
    }
    /// `most`: vertices that may come of it; what is above that is taken out where it is narrowest, as far as it can
    /// be.
    void Run(Workers &workers, int most)
    {
        const Triangulation &m = _remesh.mesh;
        const int before = _remesh.VertexCount();
        std::vector<std::array<int, 3>> middle(m.triangle.size());
        std::vector<Side> split;
        std::vector<int> crowded;
        m.VisitEdges([&](Side s) {
            const int v = before + static_cast<int>(split.size());
            for (const Side side : {s, m.Mate(s)})
                if (side != NoSide)
                    middle[SideTriangle(side)][SideEdge(side)] = v;
            split.push_back(s);
            if (Crowded(s))
                crowded.push_back(v);
        });
        const std::vector<int> spare = SpareOnCurves();
        AddMiddles(split, workers);
        CollectSpare(before, spare, crowded);
        _remesh.mesh = Quartered(middle, workers);
        if (!crowded.empty() || _remesh.VertexCount() > most)
            Remove(crowded, most, workers);
    }

    /// How many vertices Run would lead to, but for those that cannot be taken out.
    int CountAfter() const
    {
        int count = _remesh.VertexCount();
        _remesh.mesh.VisitEdges([&](Side s) { count += Crowded(s) ? 0 : 1; });
        for (const int spare : SpareOnCurves())
            count -= spare;
        return count;
    }

    /// Adds vertices in the middle of the longest edges, for the spacing there, that are no features.
    void SplitLongest(int count, Workers &workers)
    {
        if (count <= 0)
            return;
        struct Edge {
            double length;
            int tail, head;
        };
        const auto longer = [](const Edge &a, const Edge &b) {
            return std::tie(b.length, a.tail, a.head) < std::tie(a.length, b.tail, b.head);
        };
        const Triangulation &m = _remesh.mesh;
        // Of each run of triangles a heap of the longest so far, the shortest of them on top.
        const auto look = [&](int first, int last, std::vector<Edge> &found) {
            m.VisitEdges(first, last, [&](Side s) {
                if (m.Constrained(s))
                    return;
                const Edge edge = {SquaredLength(s), m.Tail(s), m.Head(s)};
                if (static_cast<int>(found.size()) == count) {
                    if (!longer(edge, found.front()))
                        return;
                    std::pop_heap(found.begin(), found.end(), longer);
                    found.pop_back();
                }
                found.push_back(edge);
                std::push_heap(found.begin(), found.end(), longer);
            });
        };
        std::vector<Edge> longest = Chunks::CollectList<Edge>(workers, m.TriangleCount(), look);
        std::sort(longest.begin(), longest.end(), longer);
        longest.resize(std::min(longest.size(), static_cast<std::size_t>(count)));
        for (const Edge &edge : longest) {
            const Side s = m.FindEdge(edge.tail, edge.head);
            AddMiddles({s}, workers);
            _remesh.mesh.SplitEdge(s, _remesh.VertexCount() - 1);
        }
    }

    /// Numbers vertices and triangles along a space-filling curve.
    void Sort(Workers &workers) { Renumber(SpatialOrder(_remesh.position, workers)); }

    /// Vertex k becomes what order[k] was; vertices that are not named, which no live triangle may use, are dropped.
    void Renumber(const std::vector<int> &order)
    {
        _remesh.mesh.Compact(order);
        Remesh sorted;
        sorted.position.reserve(order.size());
        sorted.place.reserve(order.size());
        sorted.rho.reserve(order.size());
        for (const int v : order) {
            sorted.position.push_back(_remesh.position[v]);
            sorted.place.push_back(_remesh.place[v]);
            sorted.rho.push_back(_remesh.rho[v]);
        }
        sorted.mesh = std::move(_remesh.mesh);
        _remesh = std::move(sorted);
    }

private:
    /// Edges between features that are shorter than so many spacings are not halved: no sample is to be nearer to a
    /// feature than half of that, as in the front sampler.
    static constexpr double MostCrowded = 1.4;

    const Model &_model;
    Remesh &_remesh;

    // An edge between features, that is none itself, with no room for a vertex in its middle.
    bool Crowded(Side s) const
    {
        const int a = _remesh.mesh.Tail(s), b = _remesh.mesh.Head(s);
        if (_remesh.mesh.Constrained(s) || _remesh.place[a].kind == VertexKind::Free ||
            _remesh.place[b].kind == VertexKind::Free)
            return false;
        return SquaredLength(s) < MostCrowded * MostCrowded;
    }

    // Of an edge, in spacings.
    double SquaredLength(Side s) const
    {
        const int a = _remesh.mesh.Tail(s), b = _remesh.mesh.Head(s);
        const double h = 0.5 * (SpacingNear(a) + SpacingNear(b));
        return SquaredNorm(_remesh.position[a] - _remesh.position[b]) / (h * h);
    }

    double SpacingNear(int v) const
    {
        double sum = 0;
        for (const int corner : _model.surface.mesh.triangle[_remesh.place[v].face].v)
            sum += _model.density.spacing[corner];
        return sum / 3;
    }

    // How many vertices each curve would have too many with all of its edges halved: on short ones they would lie much
    // closer together than wanted.
    std::vector<int> SpareOnCurves() const
    {
        const std::vector<FeatureCurve> &curve = _model.features.curve;
        std::vector<int> spare(curve.size(), 0);
        for (const Place &p : _remesh.place)
            if (p.kind == VertexKind::Curve)
                ++spare[p.curve];
        for (std::size_t k = 0; k < curve.size(); ++k) {
            const int edges = spare[k] + (curve[k].closed ? 0 : 1);
            const double length = curve[k].InSpacings(_model.density.spacing);
            const int wanted = std::max(static_cast<int>(std::lround(length)), edges);
            spare[k] = 2 * wanted < 3 * edges ? 2 * edges - wanted : 0;
        }
        return spare;
    }

    // Appends `spare` vertices of each curve, evenly among those from number `first` on.
    void CollectSpare(int first, const std::vector<int> &spare, std::vector<int> &crowded) const
    {
        std::vector<std::vector<std::pair<double, int>>> added(spare.size());
        for (int v = first; v < _remesh.VertexCount(); ++v) {
            const Place &p = _remesh.place[v];
            if (p.kind == VertexKind::Curve && spare[p.curve] > 0)
                added[p.curve].emplace_back(p.s, v);
        }
        for (std::size_t k = 0; k < spare.size(); ++k) {
            std::sort(added[k].begin(), added[k].end());
            const std::size_t share = static_cast<std::size_t>(spare[k]), all = added[k].size();
            for (std::size_t i = 0; i < all; ++i)
                if ((i + 1) * share / all > i * share / all)
                    crowded.push_back(added[k][i].second);
        }
    }

    // `most`: that may be left.
    void Remove(const std::vector<int> &vertices, int most, Workers &workers)
    {
        std::vector<char> kept(_remesh.position.size(), 1);
        for (const int v : vertices)
            kept[v] = 0;
        VertexRemoval removal(_remesh.mesh, _remesh.position, _remesh.place, {}, workers);
        removal.RemoveAll(kept, most, [](double) { return true; });
        std::vector<int> left;
        for (int v = 0; v < _remesh.VertexCount(); ++v)
            if (_remesh.mesh.incident[v] >= 0)
                left.push_back(v);
        Renumber(left);
    }

    // Puts vertex i of the new ones into the middle of split[i].
    void AddMiddles(const std::vector<Side> &split, Workers &workers)
    {
        const std::size_t before = _remesh.position.size(), after = before + split.size();
        _remesh.position.resize(after);
        _remesh.place.resize(after);
        _remesh.rho.resize(after);
        Chunks::For(workers, static_cast<int>(split.size()), [&](int first, int last, int) {
            for (int i = first; i < last; ++i)
                PutInMiddle(before + i, split[i]);
        });
    }

    void PutInMiddle(std::size_t v, Side s)
    {
        const int a = _remesh.mesh.Tail(s), b = _remesh.mesh.Head(s);
        if (_remesh.mesh.Constrained(s))
            PutOnCurve(v, a, b);
        else
            PutOnSurface(v, s, (_remesh.position[a] + _remesh.position[b]) / 2);
    }

    // Triangle t becomes 4 t + k at its corners k, and 4 t + 3 between the middles of its sides.
    Triangulation Quartered(const std::vector<std::array<int, 3>> &middle, Workers &workers) const
    {
        const Triangulation &m = _remesh.mesh;
        Triangulation fine;
        fine.triangle.resize(4 * m.triangle.size());
        fine.incident.resize(_remesh.position.size());
        Chunks::For(workers, m.TriangleCount(), [&](int first, int last, int) {
            for (int t = first; t < last; ++t) {
                const Triangle &T = m.triangle[t];
                Triangle &inner = fine.triangle[4 * t + 3];
                for (int k = 0; k < 3; ++k) {
                    Triangle &corner = fine.triangle[4 * t + k];
                    corner.v[0] = T.v[k];
                    corner.v[1] = middle[t][Prev(k)];
                    corner.v[2] = middle[t][Next(k)];
                    corner.n[0] = MakeSide(4 * t + 3, k);
                    corner.n[1] = HalfAcross(MakeSide(t, Next(k)), T.v[k]);
                    corner.n[2] = HalfAcross(MakeSide(t, Prev(k)), T.v[k]);
                    corner.SetConstrained(1, T.Constrained(Next(k)));
                    corner.SetConstrained(2, T.Constrained(Prev(k)));
                    inner.v[k] = middle[t][k];
                    inner.n[k] = MakeSide(4 * t + k, 0);
                }
            }
        });
        for (int t = 0; t < fine.TriangleCount(); ++t)
            for (const int v : fine.triangle[t].v)
                fine.incident[v] = t;
        return fine;
    }

    // Beyond side s: the side of a quarter that is the half of s at its end v.
    Side HalfAcross(Side s, int v) const
    {
        const Side mate = _remesh.mesh.Mate(s);
        if (mate == NoSide)
            return NoSide;
        const int u = SideTriangle(mate), k = _remesh.mesh.triangle[u].IndexOf(v);
        return MakeSide(4 * u + k, SideEdge(mate) == Next(k) ? 1 : 2);
    }

    void PutOnSurface(std::size_t v, Side s, const Point &p)
    {
        // A vertex of a feature is known by a face on one side of it: those on all sides are tried.
        const Triangulation &m = _remesh.mesh;
        const ReferenceSurface &surface = _model.surface;
        std::optional<std::pair<int, Foot>> nearest;
        const auto from = [&](int w, int start) {
            const auto found = surface.Project(start, _remesh.position[w], p);
            if (!nearest || found.second.squaredDistance < nearest->second.squaredDistance)
                nearest = found;
        };
        const int a = m.Tail(s), b = m.Head(s);
        for (const int w : {a, b})
            if (_remesh.place[w].kind == VertexKind::Free)
                from(w, _remesh.place[w].face);
        if (!nearest)
            for (const int w : {a, b, m.Opposite(s), m.Opposite(m.Mate(s))})
                for (const int start : ReferenceFacesAt(_model, _remesh, w))
                    from(w, start);
        const auto &[face, foot] = *nearest;
        Place place;
        place.face = face;
        const Triangle &T = surface.mesh.triangle[face];
        double rho = 0;
        for (int k = 0; k < 3; ++k)
            rho += foot.weight[k] * _model.density.rho[T.v[k]];
        _remesh.position[v] = foot.point;
        _remesh.place[v] = place;
        _remesh.rho[v] = rho;
    }

    // The shortest curve with these ends; curves that share both have a vertex between them.
    int CurveBetween(const Point &a, const Point &b) const
    {
        const std::vector<Point> &x = _model.surface.position;
        int found = 0;
        double length = 1e300;
        for (std::size_t k = 0; k < _model.features.curve.size(); ++k) {
            const FeatureCurve &c = _model.features.curve[k];
            const Point &front = x[c.vertex.front()], &back = x[c.vertex.back()];
            if (((front == a && back == b) || (front == b && back == a)) && c.Length() < length) {
                length = c.Length();
                found = static_cast<int>(k);
            }
        }
        return found;
    }

    void PutOnCurve(std::size_t v, int a, int b)
    {
        if (_remesh.place[a].kind != VertexKind::Curve)
            std::swap(a, b);
        Place pa = _remesh.place[a];
        const Place &pb = _remesh.place[b];
        if (pa.kind != VertexKind::Curve) {
            // From corner to corner: the whole curve.
            pa.curve = CurveBetween(_remesh.position[a], _remesh.position[b]);
            const FeatureCurve &whole = _model.features.curve[pa.curve];
            pa.s = _model.surface.position[whole.vertex.front()] == _remesh.position[a] ? 0.0 : whole.Length();
        }
        const FeatureCurve &c = _model.features.curve[pa.curve];
        const double length = c.Length();
        // The other end: a corner is one end of the curve, of two the nearer along it.
        double other = pb.kind == VertexKind::Curve ? pb.s : 0.0;
        if (pb.kind != VertexKind::Curve) {
            const double front = Norm(_remesh.position[b] - _model.surface.position[c.vertex.front()]);
            const double back = Norm(_remesh.position[b] - _model.surface.position[c.vertex.back()]);
            other = front < back || (front == back && pa.s < length / 2) ? 0.0 : length;
        }
        if (c.closed && std::abs(other - pa.s) > length / 2)
            other += other < pa.s ? length : -length;
        double s = (pa.s + other) / 2;
        if (s < 0)
            s += length;
        if (s > length)
            s -= length;
        Place place;
        place.kind = VertexKind::Curve;
        place.curve = pa.curve;
        place.s = s;
        place.segment = c.SegmentAt(s, pa.segment);
        place.face = SideTriangle(c.side[place.segment]);
        const double t = c.Fraction(place.segment, s);
        const int from = c.vertex[place.segment], to = c.vertex[place.segment + 1];
        const std::vector<Point> &x = _model.surface.position;
        const std::vector<double> &rho = _model.density.rho;
        _remesh.position[v] = x[from] + (x[to] - x[from]) * t;
        _remesh.place[v] = place;
        _remesh.rho[v] = (1 - t) * rho[from] + t * rho[to];
    }
};

} // namespace ccdm
} // namespace vcg

#endif
