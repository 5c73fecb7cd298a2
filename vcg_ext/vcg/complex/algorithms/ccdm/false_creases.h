// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_FALSE_CREASES_H
#define VCG_CCDM_FALSE_CREASES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <vcg/complex/algorithms/ccdm/disjoint_sets.h>
#include <vcg/complex/algorithms/ccdm/feature_graph.h>

namespace vcg {
namespace ccdm {

/// Tells noise from creases. An edge that turns by more than the feature angle stays a feature only if it
/// stands out from the turns of the other edges around it, or is sharp and longer than the spacing, which noise rarely
/// is; if the surface turns there at the scale of the wanted mesh too; and only in company: as part of a connected set
/// of such edges that is several spacings long. Where there is no roughness that it could be part of, a smaller scale
/// will do: a hole of a clean part that is narrower than the spacing keeps its rim. Boundaries and marked edges always
/// stay.
class FalseCreases
{
public:
    FalseCreases(ReferenceSurface &surface, const std::vector<double> &spacing, const SideMarks &marked, double degrees)
        : _surface(surface), _mesh(surface.mesh), _spacing(spacing), _marked(marked), _turn(Share * degrees * Pi / 180),
          _sharp(std::max(Sharp * degrees, LeastSharp) * Pi / 180), _normal(FaceNormals(surface)),
          _stamp(surface.FaceCount(), -1)
    {
    }

    /// Takes the marks off false creases; returns the number of connected sets that were dropped for being
    /// short.
    int Drop()
    {
        const std::vector<Side> crease = UnmarkedCreases();
        if (crease.empty())
            return 0;
        const std::vector<double> rough = Roughness();
        std::vector<Side> kept;
        int tick = 0;
        for (const Side s : crease) {
            const double around = (rough[_mesh.Tail(s)] + rough[_mesh.Head(s)]) / 2;
            // An edge between two vertices at one place has no direction; it goes on with a crease or hangs loose.
            const bool point = _surface.position[_mesh.Tail(s)] == _surface.position[_mesh.Head(s)];
            const double h = (_spacing[_mesh.Tail(s)] + _spacing[_mesh.Head(s)]) / 2;
            const double turn = Turn(s);
            const auto turns = [&](double radius) { return TurnsWithin(radius * h, s, ++tick); };
            const bool clean = around < Smooth && turn < Folded;
            const bool standsOut = turn > Prominence * around || (turn > _sharp && _surface.EdgeLength(s) > h);
            if (point || (standsOut && (turns(Radius) || (clean && turns(SmoothRadius)))))
                kept.push_back(s);
            else
                _mesh.SetConstrained(s, false);
        }
        const int sets = DropShort(kept);
        _dropped = static_cast<int>(
            std::count_if(crease.begin(), crease.end(), [&](Side s) { return !_mesh.Constrained(s); }));
        return sets;
    }

    /// Number of edges that Drop took the marks off.
    int DroppedEdges() const { return _dropped; }

private:
    static constexpr double Prominence = 4.5; // of a crease's turn over the mean turn of the other edges around it
    static constexpr int RoughnessRounds = 3; // of averaging over the neighbours
    // What an edge turns by that is sharp: so many times the feature angle, and so many degrees at least, as small ones
    // are common on smooth surfaces of few faces. Measured on such models: with less, twisted bands get creases across;
    // with 1.9 times, edges are cut off and thin parts fold.
    static constexpr double Sharp = 1.5, LeastSharp = 60;
    static constexpr double Share = 0.7;  // of the feature angle, that the mean normals have to differ by
    static constexpr double Radius = 1.0; // of the neighbourhood, in spacings
    // The same where the other edges turn by less than so many radians, and the crease by less than the last: what is
    // folded back is none. Details that are much finer make triangles that are no use.
    static constexpr double SmoothRadius = 0.25, Smooth = 0.02, Folded = 2.6;
    static constexpr double LeastLength = 4; // of a connected set, in spacings
    // Least norm of the mean of unit normals that tells a direction. Measured: up to 0.15 no crease of a scan more is
    // kept, and down to 0.05 every crease of thin plates is.
    static constexpr double LeastMean = 0.15;
    static constexpr std::size_t MostFaces = 256;

    ReferenceSurface &_surface;
    Triangulation &_mesh;
    const std::vector<double> &_spacing;
    const SideMarks &_marked;
    const double _turn, _sharp;
    const std::vector<Point> _normal;
    std::vector<int> _stamp;
    int _dropped = 0;

    struct Seen {
        int face;
        double sign; // 1 or -1: whether its normal runs with that of the first face
    };
    std::vector<Seen> _seen;

    bool Marked(Side s) const { return !_marked.empty() && ((_marked[SideTriangle(s)] >> SideEdge(s)) & 1) != 0; }
    Point Middle(Side s) const { return (_surface.position[_mesh.Tail(s)] + _surface.position[_mesh.Head(s)]) / 2; }

    double Turn(Side s) const { return TurnBetween(_normal[SideTriangle(s)], NormalAcross(_mesh, _normal, s)); }

    // The mean turn of the edges that are no creases, around each vertex.
    std::vector<double> Roughness() const
    {
        struct Mean {
            double sum = 0, weight = 0;
            void Add(double x, double w)
            {
                sum += x;
                weight += w;
            }
        };
        std::vector<Mean> mean(_mesh.VertexCount()), last;
        _mesh.VisitEdges([&](Side s) {
            if (_mesh.Mate(s) == NoSide || _mesh.Constrained(s))
                return;
            const double turn = Turn(s);
            mean[_mesh.Tail(s)].Add(turn, 1);
            mean[_mesh.Head(s)].Add(turn, 1);
        });
        for (int round = 0; round < RoughnessRounds; ++round) {
            last = mean;
            for (const Triangle &T : _mesh.triangle)
                for (int k = 0; k < 3; ++k)
                    for (const int o : {T.v[Next(k)], T.v[Prev(k)]})
                        mean[T.v[k]].Add(last[o].sum, last[o].weight);
            for (Mean &m : mean)
                m = {m.weight > 0 ? m.sum / m.weight : 0.0, m.weight > 0 ? 1.0 : 0.0};
        }
        std::vector<double> rough;
        rough.reserve(mean.size());
        for (const Mean &m : mean)
            rough.push_back(m.sum);
        return rough;
    }

    std::vector<Side> UnmarkedCreases() const
    {
        std::vector<Side> crease;
        _mesh.VisitEdges([&](Side s) {
            if (_mesh.Constrained(s) && _mesh.Mate(s) != NoSide && !Marked(s) && !Marked(_mesh.Mate(s)))
                crease.push_back(s);
        });
        return crease;
    }

    // The mean normals of the surface around the middle of the edge, on either side of it. On a plate thinner than
    // the spacing its other face is within reach and its normals cancel those of the first: what is left says
    // nothing against the crease.
    bool TurnsWithin(double reach, Side s, int tick)
    {
        const Point middle = Middle(s);
        const double reach2 = reach * reach;
        const int first = SideTriangle(s);
        const Point edge = _surface.position[_mesh.Head(s)] - _surface.position[_mesh.Tail(s)];
        // Across the edge, in the plane between the two faces.
        Point across = Cross(edge, _normal[first] + NormalAcross(_mesh, _normal, s));
        const Point apex = _surface.position[_mesh.Opposite(s)] - middle;
        if (Dot(across, apex) < 0)
            across = -across;
        Point mean[2] = {Point(0, 0, 0), Point(0, 0, 0)};
        double sum[2] = {0, 0};
        _seen.assign(1, {first, 1.0});
        _stamp[first] = tick;
        for (std::size_t k = 0; k < _seen.size(); ++k) {
            const auto [face, sign] = _seen[k];
            const Triangle &T = _mesh.triangle[face];
            const Point centre =
                (_surface.position[T.v[0]] + _surface.position[T.v[1]] + _surface.position[T.v[2]]) / 3 - middle;
            // No face counts for more than the neighbourhood holds.
            const double weight = std::min(Norm(_surface.AreaVector(face)), reach2);
            const int half = Dot(centre, across) > 0 ? 0 : 1;
            mean[half] += _normal[face] * (sign * weight);
            sum[half] += weight;
            for (int e = 0; e < 3 && _seen.size() < MostFaces; ++e) {
                const Side mate = T.n[e];
                if (mate == NoSide || _stamp[SideTriangle(mate)] == tick)
                    continue;
                const Point &tail = _surface.position[T.v[Next(e)]];
                if (SegmentSquaredDistance(middle, tail, _surface.position[T.v[Prev(e)]] - tail) > reach2)
                    continue;
                _stamp[SideTriangle(mate)] = tick;
                _seen.push_back({SideTriangle(mate), _mesh.Coherent(MakeSide(face, e)) ? sign : -sign});
            }
        }
        for (const int half : {0, 1})
            if (Norm(mean[half]) < LeastMean * sum[half])
                return true;
        return TurnBetween(mean[0], mean[1]) > _turn;
    }

    int DropShort(const std::vector<Side> &crease)
    {
        // Union of the edges' ends; the length in spacings of each set.
        DisjointSets sets(static_cast<std::size_t>(_mesh.VertexCount()));
        for (const Side s : crease)
            sets.Join(_mesh.Tail(s), _mesh.Head(s));
        std::vector<double> length(_mesh.VertexCount(), 0);
        for (const Side s : crease)
            length[sets.SetOf(_mesh.Tail(s))] += _surface.EdgeLength(s) / _spacing[_mesh.Tail(s)];
        std::vector<char> shortSet(_mesh.VertexCount(), 0);
        int dropped = 0;
        for (const Side s : crease) {
            const int r = sets.SetOf(_mesh.Tail(s));
            if (length[r] >= LeastLength)
                continue;
            dropped += shortSet[r] == 0;
            shortSet[r] = 1;
            _mesh.SetConstrained(s, false);
        }
        return dropped;
    }
};

/// What to tell the caller of edges over the feature angle that are no features; empty for none.
inline std::string DroppedCreasesWarning(int edges, double degrees)
{
    if (edges == 0)
        return "";
    std::array<char, 32> angle = {};
    std::snprintf(angle.data(), angle.size(), "%.4g", degrees);
    return std::to_string(edges) + (edges == 1 ? " edge that turns" : " edges that turn") + " by more than " +
           angle.data() + " degrees " + (edges == 1 ? "was" : "were") +
           " taken for roughness, a stray fragment or too small a detail and not for a crease";
}

} // namespace ccdm
} // namespace vcg

#endif
