// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_RELOCATION_H
#define VCG_CCDM_RELOCATION_H

#include <algorithm>
#include <cmath>
#include <vector>

#include <vcg/complex/algorithms/ccdm/patch_schedule.h>

namespace vcg {
namespace ccdm {

/// The star of a vertex with geometry: what a relocation rule sees. Positions are relative to the
/// vertex; triangle k lies between spokes k and k + 1, of which the last is the first one again if the star is closed.
/// The arrays are as long as the largest star so far.
struct LocalStar {
    int triangles = 0;
    int spokes = 0;
    bool closed = true;
    bool onCurve = false;          ///< feature edges meet at the vertex, and sectorStart is filled
    bool walled = false;           ///< wall is filled; otherwise there is none
    std::vector<int> id;           ///< outer vertices
    std::vector<Point> spoke;      ///< their positions relative to the centre
    std::vector<double> squared;   ///< their squared distances from it
    std::vector<Point> cross;      ///< spoke k x spoke k + 1, twice the area vector of triangle k
    std::vector<char> sectorStart; ///< a feature edge runs along spoke k
    std::vector<char> wall;        ///< the outer side of triangle k is a feature or boundary edge
    Point normal = {0, 0, 0};      ///< sum of the cross products
    double radius = 0;             ///< mean length of the spokes

    bool Wall(int k) const { return walled && wall[k] != 0; }
};

/// Moves the vertices of a remesh one at a time: free ones over the surface, curve vertices along their
/// curve, corners not at all; and refuses every move that would fold the star.
class Relocator
{
public:
    Relocator(const Model &model, Remesh &remesh) : _model(model), _remesh(remesh) {}

    /// One sweep: every vertex moves by `displacement(star, vertex)`, in order. Returns the vertices
    /// that moved.
    template <class Displacement>
    long long Sweep(Displacement displacement)
    {
        long long moved = 0;
        const int count = _remesh.VertexCount();
        for (int v = 0; v < count; ++v)
            moved += Relocate(v, displacement);
        return moved;
    }

    /// Moves v by `displacement(star, v)`. Returns whether it moved.
    template <class Displacement>
    bool Relocate(int v, const Displacement &displacement)
    {
        if (_remesh.place[v].kind == VertexKind::Corner)
            return false;
        Gather(v);
        return Move(v, displacement(_star, v), [](const Point &) { return true; });
    }

    /// Pattern search for single vertices: moves v by `size` times its mean edge length in six directions of its
    /// tangent plane, up to `repeats` times each, as long as a score rises by more than `gain` with that; then by half
    /// of that, down to `least`. score(star, position relative to v, wanted) may return anything that is not above
    /// `wanted` if the score is not. Returns whether v has moved.
    template <class Score>
    bool Search(int v, double size, double least, int repeats, double gain, const Score &score)
    {
        constexpr double half = 0.5, root = 0.8660254037844386; // cosine and sine of 60 degrees
        constexpr double direction[6][2] = {{1, 0},  {half, root},   {-half, root},
                                            {-1, 0}, {-half, -root}, {half, -root}};
        const bool free = _remesh.place[v].kind == VertexKind::Free;
        bool moved = false, gathered = false;
        double wanted = 0;
        Point t1(0, 0, 0), t2(0, 0, 0);
        const auto tryShift = [&](int k) {
            if (!gathered) {
                Gather(v);
                TangentAxes(_star, t1, t2);
                wanted = score(_star, Point(0, 0, 0), -1e300) + gain;
                gathered = true;
            }
            const Point step = (t1 * direction[k][0] + t2 * direction[k][1]) * (size * _star.radius);
            // Finding the surface costs most: a free vertex is to gain by the step as such.
            if (free && !(score(_star, step, wanted) > wanted))
                return false;
            if (!Move(v, step, [&](const Point &q) { return score(_star, q, wanted) > wanted; }))
                return false;
            gathered = false;
            return true;
        };
        for (; size > least; size *= 0.5)
            for (int k = 0; k < 6; ++k)
                for (int repeat = 0; repeat < repeats && tryShift(k); ++repeat)
                    moved = true;
        return moved;
    }

    /// One step of an ascent: moves v by `size` times its mean edge length along the gradient of a score, or by a part
    /// of that, if the score rises by that. score(star, position relative to v, gradient, wanted) adds to the gradient
    /// unless it is null, and may return anything that is not above `wanted` if the score is not. `cheapScore`: to find
    /// the surface costs more than the score; a step of a free vertex that gains nothing in the tangent plane, nor half
    /// of it, is not tried on the surface.
    template <class Score>
    bool Ascend(int v, double size, const Score &score, bool cheapScore)
    {
        Gather(v);
        Point g(0, 0, 0);
        const double before = score(_star, Point(0, 0, 0), &g, -1e300), wanted = before + 1e-9;
        const double n2 = SquaredNorm(_star.normal);
        if (n2 > 0 && _remesh.place[v].kind == VertexKind::Free)
            g -= _star.normal * (Dot(_star.normal, g) / n2);
        const double length = Norm(g);
        if (!(length > 0))
            return false;
        const auto gains = [&](const Point &q) { return score(_star, q, nullptr, wanted) > wanted; };
        Point step = g * (size * _star.radius / length);
        if (cheapScore && _remesh.place[v].kind == VertexKind::Free && !gains(step)) {
            step *= 0.5;
            if (!gains(step))
                return false;
        }
        return Move(v, step, gains);
    }

    /// In a sweep in order, before v: has the faces of the vertices that come next brought into the cache. Where the
    /// tables are larger than that, waiting for them took a tenth of the time. Of the patch at hand only, as another
    /// thread may be at work on the next one.
    void PrefetchAfter(int v) const
    {
        constexpr int ahead = 4;
        const int end = std::min((Patches::Of(v) + 1) * Patches::Size, _remesh.VertexCount());
        if (v + ahead < end)
            _model.surface.PrefetchCorners(_remesh.place[v + ahead].face);
        if (v + 2 * ahead < end)
            _model.surface.PrefetchRecord(_remesh.place[v + 2 * ahead].face);
    }

    /// The vector (x, y) in the tangent plane of a star.
    static Point TangentStep(const LocalStar &star, double x, double y)
    {
        Point t1(0, 0, 0), t2(0, 0, 0);
        TangentAxes(star, t1, t2);
        return t1 * x + t2 * y;
    }

private:
    const Model &_model;
    Remesh &_remesh;
    LocalStar _star;

    static void TangentAxes(const LocalStar &star, Point &t1, Point &t2)
    {
        const Point n = Normalized(star.normal);
        const Point axis = std::abs(n[0]) < 0.6 ? Point(1, 0, 0) : Point(0, 1, 0);
        t1 = Normalized(Cross(n, axis));
        t2 = Cross(n, t1);
    }

    void Gather(int v)
    {
        const Triangulation::Ring *ring = _remesh.mesh.KnownRing(v);
        if (ring != nullptr)
            TakeRing(v, *ring);
        else
            WalkAround(v);
        LocalStar &s = _star;
        if (s.cross.size() < s.spoke.size()) {
            s.cross.resize(s.spoke.size());
            s.squared.resize(s.spoke.size());
        }
        if (s.closed) {
            s.id[s.spokes] = s.id[0];
            s.spoke[s.spokes] = s.spoke[0];
        }
        // Sums in locals: in the star, each addition would wait for the last one to be stored.
        Point normal(0, 0, 0);
        double radius = 0;
        for (int k = 0; k < s.triangles; ++k) {
            const Point cross = Cross(s.spoke[k], s.spoke[k + 1]);
            s.cross[k] = cross;
            normal += cross;
        }
        for (int k = 0; k < s.spokes; ++k) {
            const double squared = SquaredNorm(s.spoke[k]);
            s.squared[k] = squared;
            radius += std::sqrt(squared);
        }
        if (s.closed)
            s.squared[s.spokes] = s.squared[0];
        s.normal = normal;
        s.radius = radius / s.spokes;
    }

    void TakeRing(int v, const Triangulation::Ring &ring)
    {
        LocalStar &s = _star;
        Reserve(Triangulation::MostInRing + 1);
        const Point x = _remesh.position[v];
        int k = 0, marks = 0;
        for (; k < Triangulation::MostInRing && ring[k] >= 0; ++k) {
            const int outer = ring[k] & Triangulation::RingNumber;
            marks |= ring[k];
            s.id[k] = outer;
            s.spoke[k] = _remesh.position[outer] - x;
        }
        s.spokes = k;
        s.closed = (marks & Triangulation::RingOpen) == 0;
        s.triangles = s.closed ? k : k - 1;
        s.walled = (marks & Triangulation::RingWall) != 0;
        s.onCurve = _remesh.place[v].kind == VertexKind::Curve;
        if (s.walled || s.onCurve)
            for (k = 0; k < s.spokes; ++k) {
                s.wall[k] = static_cast<char>((ring[k] & Triangulation::RingWall) != 0);
                s.sectorStart[k] = static_cast<char>((ring[k] & Triangulation::RingSpoke) != 0);
            }
    }

    void KeepRing(int v)
    {
        const LocalStar &s = _star;
        if (!_remesh.mesh.KeepsRingsOf(s.spokes))
            return;
        Triangulation::Ring ring;
        ring.fill(-1);
        for (int k = 0; k < s.spokes; ++k)
            ring[k] = s.id[k] | (k < s.triangles && s.wall[k] != 0 ? Triangulation::RingWall : 0) |
                      (s.sectorStart[k] != 0 ? Triangulation::RingSpoke : 0);
        if (!s.closed)
            ring[0] |= Triangulation::RingOpen;
        _remesh.mesh.KeepRing(v, ring);
    }

    void WalkAround(int v)
    {
        const Triangulation &m = _remesh.mesh;
        LocalStar &s = _star;
        s.closed = true;
        s.walled = false;
        s.onCurve = _remesh.place[v].kind == VertexKind::Curve;
        const Point x = _remesh.position[v];
        const int first = m.incident[v];
        int t = first, i = m.triangle[t].IndexOf(v), j = Next(i);
        if (s.onCurve) {
            // Start at a feature edge, so that sectors do not wrap around; at the boundary if there is
            // one.
            const Side start = SectorStart(v);
            t = SideTriangle(start);
            i = m.triangle[t].IndexOf(v);
            j = 3 - i - SideEdge(start);
        }
        const int origin = t;
        int k = 0;
        for (;;) {
            const Triangle &T = m.triangle[t];
            Reserve(k + 2);
            s.id[k] = T.v[j];
            s.spoke[k] = _remesh.position[T.v[j]] - x;
            s.wall[k] = static_cast<char>(T.Constrained(i));
            s.walled = s.walled || s.wall[k] != 0;
            s.sectorStart[k] = static_cast<char>(T.Constrained(3 - i - j));
            ++k;
            const Side next = T.n[j];
            if (next == NoSide) {
                s.closed = false;
                s.id[k] = T.v[3 - i - j];
                s.spoke[k] = _remesh.position[s.id[k]] - x;
                s.sectorStart[k] = 1;
                break;
            }
            t = SideTriangle(next);
            if (t == origin)
                break;
            i = m.triangle[t].IndexOf(v);
            j = 3 - i - SideEdge(next);
        }
        s.triangles = k;
        s.spokes = k + (s.closed ? 0 : 1);
        KeepRing(v);
    }

    void Reserve(int spokes)
    {
        if (_star.id.size() >= static_cast<std::size_t>(spokes))
            return;
        const std::size_t size = std::max<std::size_t>(16, 2 * static_cast<std::size_t>(spokes));
        _star.id.resize(size);
        _star.spoke.resize(size);
        _star.sectorStart.resize(size);
        _star.wall.resize(size);
    }

    // The side of a feature edge at v from which a walk that starts inside its triangle sees whole
    // sectors; a boundary edge if v has one.
    Side SectorStart(int v) const
    {
        Side start = NoSide;
        bool boundary = false;
        const Triangulation &m = _remesh.mesh;
        m.VisitSpokes(v, [&](int, Side s) {
            if (m.Constrained(s) && !boundary) {
                start = s;
                boundary = m.Mate(s) == NoSide;
            }
            return true;
        });
        return start;
    }

    // `accept` has the last word on a position, given relative to the vertex.
    template <class Accept>
    bool Move(int v, Point step, const Accept &accept)
    {
        if (!(SquaredNorm(step) > 0))
            return false;
        const double limit = 0.5 * _star.radius, length = Norm(step);
        if (length > limit)
            step *= limit / length;
        return _remesh.place[v].kind == VertexKind::Free ? MoveFree(v, step, accept) : Slide(v, step, accept);
    }

    template <class Accept>
    bool MoveFree(int v, Point step, const Accept &accept)
    {
        const Point x = _remesh.position[v];
        // The part along the star's normal would shrink curved and thin parts.
        const double n2 = SquaredNorm(_star.normal);
        if (n2 > 0)
            step -= _star.normal * (Dot(_star.normal, step) / n2);
        for (int attempt = 0; attempt < 2; ++attempt, step *= 0.5) {
            const auto [face, foot] = _model.surface.Project(_remesh.place[v].face, x, x + step);
            if (!KeepsStar(foot.point - x, false) || !accept(foot.point - x))
                continue;
            _remesh.position[v] = foot.point;
            _remesh.place[v].face = face;
            if (!_model.density.uniform) {
                const Triangle &T = _model.surface.mesh.triangle[face];
                const std::vector<double> &rho = _model.density.rho;
                _remesh.rho[v] =
                    foot.weight[0] * rho[T.v[0]] + foot.weight[1] * rho[T.v[1]] + foot.weight[2] * rho[T.v[2]];
            }
            return true;
        }
        return false;
    }

    template <class Accept>
    bool Slide(int v, Point step, const Accept &accept)
    {
        const Point x = _remesh.position[v];
        Place place = _remesh.place[v];
        const FeatureCurve &c = _model.features.curve[place.curve];
        MeasureSectors();
        for (int attempt = 0; attempt < 2; ++attempt, step *= 0.5) {
            double s = place.s;
            int segment = place.segment;
            NearestOnCurve(c, x + step, 1.5 * Norm(step), s, segment);
            if (s == place.s)
                return false;
            const Point &a = _model.surface.position[c.vertex[segment]];
            const Point &b = _model.surface.position[c.vertex[segment + 1]];
            const double t = c.Fraction(segment, s);
            const Point q = a + (b - a) * t;
            if (!KeepsStar(q - x, true) || !accept(q - x))
                continue;
            place.s = s;
            place.segment = segment;
            place.face = SideTriangle(c.side[segment]);
            _remesh.position[v] = q;
            _remesh.place[v] = place;
            const std::vector<double> &rho = _model.density.rho;
            _remesh.rho[v] = (1 - t) * rho[c.vertex[segment]] + t * rho[c.vertex[segment + 1]];
            return true;
        }
        return false;
    }

    // Point of the curve nearest to p among those within `reach` along the curve of (s, segment).
    void NearestOnCurve(const FeatureCurve &c, const Point &p, double reach, double &s, int &segment) const
    {
        const double start = s, length = c.Length();
        const int home = segment, count = c.Segments();
        double best = 1e300;
        auto consider = [&](int k, double offset) {
            // offset: what to add to the arc length of segment k to continue that of the start.
            const Point &a = _model.surface.position[c.vertex[k]];
            const Point d = _model.surface.position[c.vertex[k + 1]] - a;
            const double l = c.arc[k + 1] - c.arc[k];
            if (!(l > 0))
                return;
            double t = Dot(p - a, d) / (l * l);
            const double low = std::max(0.0, (start - reach - offset - c.arc[k]) / l);
            const double high = std::min(1.0, (start + reach - offset - c.arc[k]) / l);
            t = std::clamp(t, low, std::max(low, high));
            const double distance = SquaredNorm(a + d * t - p);
            if (distance < best) {
                best = distance;
                s = c.arc[k] + t * l;
                segment = k;
            }
        };
        consider(home, 0);
        double offset = 0;
        for (int k = home, steps = 0; steps < count; ++steps) {
            if (k + 1 == count) {
                if (!c.closed)
                    break;
                offset += length;
                k = -1;
            }
            ++k;
            if (k == home || c.arc[k] + offset > start + reach)
                break;
            consider(k, offset);
        }
        offset = 0;
        for (int k = home, steps = 0; steps < count; ++steps) {
            if (k == 0) {
                if (!c.closed)
                    break;
                offset -= length;
                k = count;
            }
            --k;
            if (k == home || c.arc[k + 1] + offset < start - reach)
                break;
            consider(k, offset);
        }
    }

    // Sum of the cross products of each sector between feature edges, repeated for its triangles.
    void MeasureSectors()
    {
        const int n = _star.triangles;
        _sector.resize(n);
        for (int k = 0; k < n;) {
            int end = k + 1;
            Point normal = _star.cross[k];
            while (end < n && !_star.sectorStart[end])
                normal += _star.cross[end++];
            for (; k < end; ++k)
                _sector[k] = normal;
        }
    }

    // How well a triangle with twice the area vector c faces the way of its sector: the square of the
    // cosine with the cosine's sign, or less if it has next to no area.
    static double Facing(const Point &c, const Point &sector)
    {
        const double along = Dot(c, sector), scale = SquaredNorm(sector);
        if (!(along > 1e-4 * scale))
            return std::min(along / std::max(scale, 1e-300), 0.0);
        return along * along / (SquaredNorm(c) * scale);
    }

    // Fold guard: every triangle still faces the way of its sector (the whole star of a free vertex).
    // Where some did not before, the worst must improve.
    bool KeepsStar(const Point &move, bool sectors) const
    {
        constexpr double least = 0.04; // the square of the cosine of 78 degrees
        bool all = true;
        Point here = _star.spoke[0] - move;
        double scale = SquaredNorm(_star.normal);
        for (int k = 0; k < _star.triangles && all; ++k) {
            const Point next = _star.spoke[k + 1] - move, c = Cross(here, next);
            const Point &sector = sectors ? _sector[k] : _star.normal;
            if (sectors)
                scale = SquaredNorm(sector);
            const double along = Dot(c, sector);
            all = along > 1e-4 * scale && along * along >= least * (SquaredNorm(c) * scale);
            here = next;
        }
        if (all)
            return true;
        double after = 1, before = 1;
        for (int k = 0; k < _star.triangles; ++k) {
            const Point c = Cross(_star.spoke[k] - move, _star.spoke[k + 1] - move);
            after = std::min(after, Facing(c, sectors ? _sector[k] : _star.normal));
        }
        for (int k = 0; k < _star.triangles; ++k)
            before = std::min(before, Facing(_star.cross[k], sectors ? _sector[k] : _star.normal));
        return after > before;
    }
    std::vector<Point> _sector;
};

/// The energy F of equation (1): 5/12 of the sum over the triangles of density * area * the sum of
/// the squared edge lengths, the density being constant on each triangle.
inline double Energy(const Remesh &r, Workers &workers)
{
    const auto add = [&](int first, int last, double &sum) {
        for (int t = first; t < last; ++t) {
            const Triangle &T = r.mesh.triangle[t];
            const Point &a = r.position[T.v[0]], &b = r.position[T.v[1]], &c = r.position[T.v[2]];
            const double rho = (r.rho[T.v[0]] + r.rho[T.v[1]] + r.rho[T.v[2]]) / 3;
            sum += rho * Norm(Cross(b - a, c - a)) / 2 * (SquaredNorm(b - a) + SquaredNorm(c - b) + SquaredNorm(a - c));
        }
    };
    double sum = 0;
    for (const double part : Chunks::Collect<double>(workers, r.mesh.TriangleCount(), add))
        sum += part;
    return sum * 5 / 12;
}

} // namespace ccdm
} // namespace vcg

#endif
