// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_REFINEMENT_H
#define VCG_CCDM_REFINEMENT_H

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/remesh.h>

namespace vcg {
namespace ccdm {

/// Splits every triangle of a remesh in four. The new vertices lie on the surface, those of feature edges on
/// their curves. A mesh that was improved when it was coarse so becomes one with few irregular vertices.
class Refinement
{
public:
    Refinement(const Model &model, Remesh &remesh) : _model(model), _remesh(remesh) {}

    void Run()
    {
        const Triangulation &m = _remesh.mesh;
        std::vector<std::array<int, 3>> middle(m.triangle.size());
        for (int t = 0; t < m.TriangleCount(); ++t)
            for (int e = 0; e < 3; ++e) {
                const Side s = MakeSide(t, e), mate = m.Mate(s);
                if (mate != NoSide && mate < s)
                    middle[t][e] = middle[SideTriangle(mate)][SideEdge(mate)];
                else
                    middle[t][e] = AddMiddle(s);
            }
        std::vector<std::array<int, 3>> face;
        std::vector<std::uint8_t> constrained;
        face.reserve(4 * middle.size());
        constrained.reserve(4 * middle.size());
        for (std::size_t t = 0; t < middle.size(); ++t) {
            const Triangle &T = m.triangle[t];
            for (int k = 0; k < 3; ++k) {
                face.push_back({T.v[k], middle[t][Prev(k)], middle[t][Next(k)]});
                constrained.push_back(
                    static_cast<std::uint8_t>((T.Constrained(Next(k)) ? 2U : 0U) | (T.Constrained(Prev(k)) ? 4U : 0U)));
            }
            face.push_back(middle[t]);
            constrained.push_back(0);
        }
        Triangulation fine;
        fine.Build(_remesh.VertexCount(), face);
        for (std::size_t t = 0; t < face.size(); ++t)
            fine.triangle[t].constrained = constrained[t];
        _remesh.mesh = std::move(fine);
    }

    /// Adds vertices in the middle of the longest edges that are no features.
    void SplitLongest(int count)
    {
        for (int i = 0; i < count; ++i) {
            const Triangulation &m = _remesh.mesh;
            Side longest = NoSide;
            double length = 0;
            for (int t = 0; t < m.TriangleCount(); ++t)
                for (int e = 0; e < 3; ++e) {
                    const Side s = MakeSide(t, e);
                    if (m.Mate(s) <= s || m.Constrained(s))
                        continue;
                    const double l = SquaredNorm(_remesh.position[m.Head(s)] - _remesh.position[m.Tail(s)]);
                    if (l > length) {
                        length = l;
                        longest = s;
                    }
                }
            if (longest == NoSide)
                return;
            const int v = AddMiddle(longest);
            _remesh.mesh.SplitEdge(longest, v);
        }
    }

    /// Numbers vertices and triangles along a space-filling curve.
    void Sort()
    {
        const std::vector<int> order = SpatialOrder(_remesh.position);
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
    const Model &_model;
    Remesh &_remesh;

    int AddMiddle(Side s)
    {
        const int a = _remesh.mesh.Tail(s), b = _remesh.mesh.Head(s), v = _remesh.VertexCount();
        if (_remesh.mesh.Constrained(s))
            AddOnCurve(a, b);
        else
            AddOnSurface(s, (_remesh.position[a] + _remesh.position[b]) / 2);
        return v;
    }

    void AddOnSurface(Side s, const Point &p)
    {
        // A vertex of a curve is known by a face on one side of it: the faces of all vertices around are tried.
        const Triangulation &m = _remesh.mesh;
        const ReferenceSurface &surface = _model.surface;
        Foot best;
        int face = -1;
        const auto from = [&](int v) {
            const auto [f, foot] = surface.Project(_remesh.place[v].face, _remesh.position[v], p);
            if (face < 0 || foot.squaredDistance < best.squaredDistance) {
                face = f;
                best = foot;
            }
        };
        const int a = m.Tail(s), b = m.Head(s);
        if (_remesh.place[a].kind == VertexKind::Free)
            from(a);
        if (_remesh.place[b].kind == VertexKind::Free)
            from(b);
        if (face < 0)
            for (const int v : {a, b, m.Opposite(s), m.Opposite(m.Mate(s))})
                from(v);
        Place place;
        place.face = face;
        const Triangle &T = surface.mesh.triangle[face];
        double rho = 0;
        for (int k = 0; k < 3; ++k)
            rho += best.weight[k] * _model.density.rho[T.v[k]];
        _remesh.position.push_back(best.point);
        _remesh.place.push_back(place);
        _remesh.rho.push_back(rho);
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

    void AddOnCurve(int a, int b)
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
        _remesh.position.push_back(x[from] + (x[to] - x[from]) * t);
        _remesh.place.push_back(place);
        _remesh.rho.push_back((1 - t) * rho[from] + t * rho[to]);
    }
};

} // namespace ccdm
} // namespace vcg

#endif
