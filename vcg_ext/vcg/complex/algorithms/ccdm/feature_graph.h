// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_FEATURE_GRAPH_H
#define VCG_CCDM_FEATURE_GRAPH_H

#include <cmath>
#include <cstdint>
#include <vector>

#include <vcg/complex/algorithms/ccdm/reference_surface.h>

namespace vcg {
namespace ccdm {

/// A polyline of feature edges on the reference surface, between two corners or closed.
struct FeatureCurve {
    std::vector<int> vertex; ///< reference vertices in order; a closed curve repeats its first at the end
    std::vector<Side> side;  ///< a side of the reference surface for each segment
    std::vector<double> arc; ///< arc length from the first vertex to each vertex
    bool closed = false;
    bool locked = false; ///< one edge that stays undivided

    int Segments() const { return static_cast<int>(side.size()); }
    double Length() const { return arc.back(); }
    /// Whether it runs along the boundary of the reference surface, with that mesh.
    bool OnBoundary(const Triangulation &mesh) const { return mesh.Mate(side.front()) == NoSide; }
    /// Segment that holds arc length s, searched from a hint.
    int SegmentAt(double s, int hint = 0) const
    {
        int k = std::clamp(hint, 0, Segments() - 1);
        while (k > 0 && s < arc[k])
            --k;
        while (k + 1 < Segments() && s > arc[k + 1])
            ++k;
        return k;
    }
    /// Share of a segment that arc length s has run through, in [0, 1].
    double Fraction(int segment, double s) const
    {
        const double l = arc[segment + 1] - arc[segment];
        return l > 0 ? std::clamp((s - arc[segment]) / l, 0.0, 1.0) : 0.0;
    }
    /// Length of a segment in units of the spacing there, which is given at the reference vertices.
    double InSpacings(int segment, const std::vector<double> &spacing) const
    {
        return 2 * (arc[segment + 1] - arc[segment]) / (spacing[vertex[segment]] + spacing[vertex[segment + 1]]);
    }
    /// Its whole length in units of the spacing.
    double InSpacings(const std::vector<double> &spacing) const
    {
        double length = 0;
        for (int k = 0; k < Segments(); ++k)
            length += InSpacings(k, spacing);
        return length;
    }
    /// Arc length s brought onto the curve: around a closed one, to the nearer end of another.
    double OnCurve(double s) const
    {
        if (closed) {
            s = std::fmod(s, Length());
            s += s < 0 ? Length() : 0;
        }
        return std::clamp(s, 0.0, Length());
    }
    /// The point at arc length s, of the reference vertices' positions; `hint` as for SegmentAt.
    Point At(const std::vector<Point> &position, double s, int hint) const
    {
        s = OnCurve(s);
        const int k = SegmentAt(s, hint);
        const Point &a = position[vertex[k]], &b = position[vertex[k + 1]];
        return a + (b - a) * Fraction(k, s);
    }
};

/// The features of a reference surface: creases, boundaries and marked edges as curves that meet at
/// corners.
struct FeatureGraph {
    std::vector<FeatureCurve> curve;
    std::vector<int> corner; ///< reference vertices
    int pruned = 0;          ///< loose chains that were too short to keep
    int prunedEdges = 0;     ///< edges of those chains
};

/// One bit a side for each face, as callers mark edges; empty: none.
using SideMarks = std::vector<std::uint8_t>;

/// Unit normals of the faces, each in the orientation of its own face. A face without area takes the
/// normal that lies behind its longest side, so that a crease runs around it and not through it.
inline std::vector<Point> FaceNormals(const ReferenceSurface &surface)
{
    const Triangulation &m = surface.mesh;
    std::vector<Point> normal(m.TriangleCount());
    std::vector<int> flat;
    auto longest = [&](int t) {
        int best = 0;
        double length = -1;
        for (int e = 0; e < 3; ++e) {
            const Triangle &T = m.triangle[t];
            const double l = SquaredNorm(surface.position[T.v[Next(e)]] - surface.position[T.v[Prev(e)]]);
            if (l > length) {
                length = l;
                best = e;
            }
        }
        return std::pair<int, double>(best, length);
    };
    for (int t = 0; t < m.TriangleCount(); ++t) {
        const Point area = surface.AreaVector(t);
        if (Norm(area) > 1e-12 * longest(t).second)
            normal[t] = Normalized(area);
        else
            flat.push_back(t);
    }
    // A chain of flat faces is resolved from its end; as many rounds as it is long, and no more than 8.
    for (int round = 0; round < 8 && !flat.empty(); ++round) {
        std::vector<int> rest;
        for (const int t : flat) {
            const Side s = MakeSide(t, longest(t).first), mate = m.Mate(s);
            const Point behind = mate == NoSide ? Point(0, 0, 0) : normal[SideTriangle(mate)];
            if (SquaredNorm(behind) > 0)
                normal[t] = m.Coherent(s) ? behind : -behind;
            else
                rest.push_back(t);
        }
        flat.swap(rest);
    }
    return normal;
}

/// Normal of the face across a side, turned to the orientation of the side's own face.
inline Point NormalAcross(const Triangulation &m, const std::vector<Point> &normal, Side s)
{
    const Point &other = normal[SideTriangle(m.Mate(s))];
    return m.Coherent(s) ? other : -other;
}

/// Angle between two vectors, in radians.
inline double TurnBetween(const Point &a, const Point &b)
{
    return std::atan2(Norm(Cross(a, b)), Dot(a, b));
}

/// Marks as features the boundary edges, the edges whose faces turn by more than `degrees`, and those
/// in `marked`.
inline void MarkFeatures(ReferenceSurface &surface, double degrees, const SideMarks &marked)
{
    Triangulation &m = surface.mesh;
    const double limit = degrees * Pi / 180;
    const std::vector<Point> normal = FaceNormals(surface);
    for (int t = 0; t < m.TriangleCount(); ++t)
        for (int e = 0; e < 3; ++e) {
            const Side s = MakeSide(t, e), mate = m.Mate(s);
            bool feature = mate == NoSide || (!marked.empty() && ((marked[t] >> e) & 1));
            if (!feature && mate > s && degrees < 180) {
                feature = TurnBetween(normal[t], NormalAcross(m, normal, s)) > limit;
            }
            if (feature)
                m.SetConstrained(s, true);
        }
}

/// What makes a vertex of a curve a corner, beside other than two feature edges that meet there.
struct CornerRules {
    /// The curve turns by more than this, as seen over half the spacing.
    double degrees = 40;
    /// Whether that goes for boundaries as well.
    bool turnsOfBoundaries = true;
    /// Every boundary vertex is a corner.
    bool allOfBoundaries = false;
    /// Boundary sides that become curves of their own, between two corners; empty: none.
    SideMarks locked = {};
};

/// Turns the marks of a reference surface into curves and corners.
class FeatureTracer
{
public:
    /// `spacing` is the wanted edge length at each reference vertex. Open chains that hang loose and
    /// are shorter than it lose their marks, unless they are boundary or in `marked`.
    FeatureTracer(ReferenceSurface &surface, const std::vector<double> &spacing, const SideMarks &marked,
                  const CornerRules &rules)
        : _surface(surface), _mesh(surface.mesh), _spacing(spacing), _marked(marked), _rules(rules)
    {
    }

    FeatureGraph Trace()
    {
        CollectSpokes();
        Prune();
        CollectSpokes();
        TraceCurves();
        return std::move(_graph);
    }

private:
    struct Spoke {
        int vertex;
        Side side;
    };

    ReferenceSurface &_surface;
    Triangulation &_mesh;
    const std::vector<double> &_spacing;
    const SideMarks &_marked;
    const CornerRules &_rules;
    FeatureGraph _graph;
    std::vector<int> _first; // spokes of vertex v: _first[v] to _first[v + 1]
    std::vector<Spoke> _spoke;
    std::vector<char> _isCorner; // per reference vertex

    int Degree(int v) const { return _first[v + 1] - _first[v]; }

    template <class Visit>
    void VisitFeatureEdges(Visit visit) const
    {
        _mesh.VisitEdges([&](Side s) {
            if (_mesh.Constrained(s))
                visit(s);
        });
    }

    void CollectSpokes()
    {
        _first.assign(_mesh.VertexCount() + 1, 0);
        VisitFeatureEdges([&](Side s) {
            ++_first[_mesh.Tail(s) + 1];
            ++_first[_mesh.Head(s) + 1];
        });
        for (int v = 0; v < _mesh.VertexCount(); ++v)
            _first[v + 1] += _first[v];
        _spoke.resize(_first.back());
        std::vector<int> fill(_first.begin(), _first.end() - 1);
        VisitFeatureEdges([&](Side s) {
            _spoke[fill[_mesh.Tail(s)]++] = {_mesh.Head(s), s};
            _spoke[fill[_mesh.Head(s)]++] = {_mesh.Tail(s), s};
        });
    }

    bool Removable(Side s) const
    {
        auto marked = [&](Side x) { return !_marked.empty() && ((_marked[SideTriangle(x)] >> SideEdge(x)) & 1); };
        return _mesh.Mate(s) != NoSide && !marked(s) && !marked(_mesh.Mate(s));
    }

    bool Locked(Side s) const
    {
        return !_rules.locked.empty() && ((_rules.locked[SideTriangle(s)] >> SideEdge(s)) & 1) != 0;
    }

    // Walks from a loose end until the chain ends or meets others; unmarks it if it is short. A removed
    // chain may leave another loose end, which is looked at in turn.
    void Prune()
    {
        std::vector<int> ends;
        std::vector<int> degree(_mesh.VertexCount(), 0);
        for (int v = 0; v < _mesh.VertexCount(); ++v) {
            degree[v] = Degree(v);
            if (degree[v] == 1)
                ends.push_back(v);
        }
        std::vector<Side> chain;
        while (!ends.empty()) {
            const int end = ends.back();
            ends.pop_back();
            if (degree[end] != 1)
                continue;
            chain.clear();
            double length = 0;
            int v = end;
            bool removable = true;
            do {
                Side next = NoSide;
                int to = v;
                for (int k = _first[v]; k < _first[v + 1]; ++k)
                    if (_mesh.Constrained(_spoke[k].side) && (chain.empty() || _spoke[k].side != chain.back())) {
                        next = _spoke[k].side;
                        to = _spoke[k].vertex;
                    }
                if (next == NoSide)
                    break;
                chain.push_back(next);
                length += _surface.EdgeLength(next);
                removable = Removable(next) && length < _spacing[end];
                v = to;
            } while (removable && degree[v] == 2 && v != end);
            if (!removable || chain.empty())
                continue;
            ++_graph.pruned;
            _graph.prunedEdges += static_cast<int>(chain.size());
            for (const Side s : chain) {
                --degree[_mesh.Tail(s)];
                --degree[_mesh.Head(s)];
                _mesh.SetConstrained(s, false);
            }
            if (degree[v] == 1)
                ends.push_back(v);
        }
    }

    // A maximal run of feature edges from spoke k of vertex v to the next corner or back to v.
    FeatureCurve Follow(int v, int k, std::vector<char> &used) const
    {
        FeatureCurve c;
        c.vertex.push_back(v);
        c.arc.push_back(0);
        Spoke step = _spoke[k];
        for (;;) {
            used[3 * static_cast<std::size_t>(SideTriangle(step.side)) + SideEdge(step.side)] = 1;
            c.side.push_back(step.side);
            c.vertex.push_back(step.vertex);
            c.arc.push_back(c.arc.back() + _surface.EdgeLength(step.side));
            const int w = step.vertex;
            if (_isCorner[w] || w == v)
                break;
            const int f = _first[w];
            step = _spoke[f].side == step.side ? _spoke[f + 1] : _spoke[f];
        }
        c.closed = c.vertex.front() == c.vertex.back() && !_isCorner[v];
        c.locked = Locked(c.side.front());
        return c;
    }

    void TraceCurves()
    {
        _isCorner.assign(_mesh.VertexCount(), 0);
        for (int v = 0; v < _mesh.VertexCount(); ++v)
            _isCorner[v] = Degree(v) != 0 && Degree(v) != 2;
        VisitFeatureEdges([&](Side s) {
            if (_mesh.Mate(s) == NoSide && (_rules.allOfBoundaries || Locked(s)))
                _isCorner[_mesh.Tail(s)] = _isCorner[_mesh.Head(s)] = 1;
        });
        // First between junctions only; then the sharp turns of those runs become corners too.
        for (const FeatureCurve &c : CollectCurves())
            if (_rules.turnsOfBoundaries || !c.OnBoundary(_mesh))
                FindTurns(c);
        _graph.curve = CollectCurves();
        for (int v = 0; v < _mesh.VertexCount(); ++v)
            if (_isCorner[v])
                _graph.corner.push_back(v);
    }

    std::vector<FeatureCurve> CollectCurves() const
    {
        std::vector<FeatureCurve> curves;
        std::vector<char> used(3 * static_cast<std::size_t>(_mesh.TriangleCount()), 0);
        for (const bool corners : {true, false})
            for (int v = 0; v < _mesh.VertexCount(); ++v)
                for (int k = _first[v]; k < _first[v + 1] && (_isCorner[v] || !corners); ++k) {
                    const Side s = _spoke[k].side;
                    if (!used[3 * static_cast<std::size_t>(SideTriangle(s)) + SideEdge(s)])
                        curves.push_back(Follow(v, k, used));
                }
        return curves;
    }

    // Corners where the curve turns by more than the limit between the chords to the points half a
    // spacing before and after; of several such vertices within that distance, the sharpest.
    void FindTurns(const FeatureCurve &c)
    {
        const int last = c.Segments();
        std::vector<double> turn(last + 1, 0);
        for (int k = c.closed ? 0 : 1; k < last; ++k) {
            const double window = std::min(0.5 * _spacing[c.vertex[k]], 0.25 * c.Length());
            const Point &p = _surface.position[c.vertex[k]];
            const Point before = p - c.At(_surface.position, c.arc[k] - window, k);
            const Point after = c.At(_surface.position, c.arc[k] + window, k) - p;
            turn[k] = std::atan2(Norm(Cross(before, after)), Dot(before, after));
        }
        turn[last] = c.closed ? turn[0] : 0;
        for (int k = c.closed ? 0 : 1; k < last; ++k) {
            if (turn[k] <= _rules.degrees * Pi / 180)
                continue;
            const double window = 0.5 * _spacing[c.vertex[k]];
            bool sharpest = true;
            for (int j = k - 1; j >= 0 && c.arc[k] - c.arc[j] < window && sharpest; --j)
                sharpest = turn[k] > turn[j];
            for (int j = k + 1; j <= last && c.arc[j] - c.arc[k] < window && sharpest; ++j)
                sharpest = turn[k] >= turn[j];
            if (sharpest)
                _isCorner[c.vertex[k]] = 1;
        }
    }
};

} // namespace ccdm
} // namespace vcg

#endif
