// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_FRONT_SAMPLER_H
#define VCG_CCDM_FRONT_SAMPLER_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include <vcg/complex/algorithms/ccdm/disjoint_sets.h>
#include <vcg/complex/algorithms/ccdm/patch_schedule.h>
#include <vcg/complex/algorithms/ccdm/sampling.h>

namespace vcg {
namespace ccdm {

/// Points in buckets by cube, the cube's edge being twice the power of two times a base that fits the point's
/// own spacing: finds those near a place in constant time at any gradation. Measured: with cubes half as wide, more
/// time goes into empty ones than into points that are too far away.
class PointBuckets
{
public:
    PointBuckets(double base, std::size_t expected) : _base(base)
    {
        std::size_t size = BlockCells;
        while (size < 4 * expected)
            size *= 2;
        _head.assign(size, -1);
        _entry.reserve(expected);
        for (int level = 0; level < Levels; ++level)
            _cell[level] = std::ldexp(base, level - BaseLevel + 1);
    }

    int Size() const { return static_cast<int>(_entry.size()); }

    void Add(const Point &p, double spacing)
    {
        const int level = Level(spacing);
        _levels |= std::uint64_t(1) << level;
        const double cell = _cell[level];
        const int i = Floor(p[0] / cell), j = Floor(p[1] / cell), k = Floor(p[2] / cell);
        int &head = _head[Block(Column(level, i, j), k) + Offset(i, j, k)];
        _entry.push_back({p, head});
        head = Size() - 1;
    }

    /// Calls visit(index, squared distance) for every point within `radius` of p whose spacing is within
    /// a factor of about four of `spacing`; visit returns false to stop. An index may come twice.
    template <class Visit>
    void Near(const Point &p, double radius, double spacing, Visit visit) const
    {
        const int own = Level(spacing);
        for (int level = std::max(own - 2, 0); level <= std::min(own + 2, Levels - 1); ++level) {
            if (((_levels >> level) & 1) == 0)
                continue;
            const double cell = _cell[level];
            int low[3], high[3];
            for (int k = 0; k < 3; ++k) {
                low[k] = Floor((p[k] - radius) / cell);
                high[k] = Floor((p[k] + radius) / cell);
            }
            for (int i = low[0]; i <= high[0]; ++i)
                for (int j = low[1]; j <= high[1]; ++j) {
                    const std::uint64_t column = Column(level, i, j);
                    for (int k = low[2]; k <= high[2]; ++k)
                        for (int at = _head[Block(column, k) + Offset(i, j, k)]; at >= 0; at = _entry[at].next) {
                            const double d = SquaredNorm(_entry[at].point - p);
                            if (d < radius * radius && !visit(at, d))
                                return;
                        }
                }
        }
    }

private:
    struct Entry {
        Point point;
        int next;
    };
    static constexpr int Levels = 64, BaseLevel = 32;
    // Cells are hashed in blocks of four by four by four, so that those around a place share cache lines.
    static constexpr std::size_t BlockCells = 64;

    const double _base;
    std::array<double, Levels> _cell; // edge of the cubes of each level
    std::uint64_t _levels = 0;
    std::vector<int> _head;
    std::vector<Entry> _entry;

    // The least whole number, within bounds, that is not below the logarithm but for rounding.
    int Level(double spacing) const
    {
        int exponent = 0;
        const double fraction = std::frexp(spacing / _base, &exponent);
        return std::clamp(BaseLevel + exponent - (fraction <= 0.5 * (1 + 7e-10) ? 1 : 0), 0, Levels - 1);
    }
    static int Floor(double x)
    {
        x = std::clamp(x, -1e9, 1e9);
        const int towardsZero = static_cast<int>(x);
        return towardsZero - (x < towardsZero ? 1 : 0);
    }
    static std::uint64_t Column(int level, int i, int j)
    {
        const std::uint64_t h = static_cast<std::uint32_t>(i >> 2) * 0x9e3779b97f4a7c15ULL;
        return (h ^ (h >> 29) ^ static_cast<std::uint32_t>(j >> 2)) * 0xbf58476d1ce4e5b9ULL +
               static_cast<std::uint64_t>(level) * 0x632be59bd9b4e019ULL;
    }
    std::size_t Block(std::uint64_t column, int k) const
    {
        const std::uint64_t h = (column ^ (column >> 29) ^ static_cast<std::uint32_t>(k >> 2)) * 0x94d049bb133111ebULL;
        return (h ^ (h >> 31)) & (_head.size() - BlockCells);
    }
    static std::size_t Offset(int i, int j, int k)
    {
        return static_cast<std::size_t>((i & 3) << 4 | (j & 3) << 2 | (k & 3));
    }
};

/// Lays samples out in hexagons: each sample, first in first out, proposes the others around it at one spacing,
/// reached by straight lines over the surface that stop at features; a proposal is taken if nothing on
/// its sheet is nearer than 0.7 spacings. Curve samples start the front, random points where it has not
/// come. The spacing is scaled until nearly the wanted number comes out, the rest is added in the widest
/// gaps or taken from the narrowest places.
class FrontSampler
{
public:
    /// `connected`: the surface is known to have one component.
    FrontSampler(const ReferenceSurface &surface, const FeatureGraph &features, const DensityField &density,
                 bool orientable, bool connected = false)
        : _surface(surface), _features(features), _density(density), _orientable(orientable)
    {
        if (!connected)
            NumberComponents();
        _base = *std::min_element(density.spacing.begin(), density.spacing.end());
    }

    /// Exactly `count` points on faces.
    std::vector<SurfacePoint> Run(const std::vector<CurveSample> &onCurves, int count, Random &random)
    {
        Workers alone(1);
        return Run(onCurves, count, random, alone);
    }
    std::vector<SurfacePoint> Run(const std::vector<CurveSample> &onCurves, int count, Random &random, Workers &workers)
    {
        std::vector<SurfacePoint> best;
        if (count <= 0)
            return best;
        double scale = FirstScale;
        int closest = -1;
        for (int round = 0; round < 3; ++round) {
            std::vector<SurfacePoint> found = Advance(onCurves, count, scale, random);
            const int size = static_cast<int>(found.size()), miss = std::abs(size - count);
            if (closest < 0 || miss < closest) {
                closest = miss;
                best.swap(found);
                _bestScale = scale;
            }
            if (miss <= 2 + count / MissedShare)
                break;
            scale *= std::sqrt(static_cast<double>(std::max(size, 1)) / count);
        }
        if (static_cast<int>(best.size()) > count)
            Thin(best, count, workers);
        else if (static_cast<int>(best.size()) < count)
            Fill(best, onCurves, count, random);
        return best;
    }

private:
    // What keeps others away: a sample with its face and normal; with no normal, one on a feature.
    struct Keeper {
        Point point, normal;
        int face;
        bool onFeature;
    };
    struct Sample {
        SurfacePoint at;
        Point point, direction; // the direction in which the front came, in the plane of its face
        bool seed;              // no front came, and the direction is any
    };

    // Measured: gaps where fronts meet leave 2 to 6 percent too few points at the wanted spacing.
    static constexpr double FirstScale = 0.983;
    /// A miss of one in so many is made good by filling or thinning, without another round. Measured: against one in a
    /// hundred 5 % of the time of a part whose first round misses by more, for 0.06 degrees.
    static constexpr int MissedShare = 50;
    static constexpr std::size_t MostJoined = 128; // faces looked at

    const ReferenceSurface &_surface;
    const FeatureGraph &_features;
    const DensityField &_density;
    const bool _orientable;
    double _base, _bestScale = 1;
    double _scale = 1;
    std::vector<Keeper> _keeper;
    std::vector<Sample> _queue;
    std::vector<int> _component; // of each face; empty: there is but one

    double Spacing(const SurfacePoint &p) const
    {
        return _scale * (_density.uniform ? _density.spacing[0] : _surface.Interpolate(p, _density.spacing));
    }
    const Point &Corner(int face, int i) const { return _surface.position[_surface.mesh.triangle[face].v[i]]; }

    void NumberComponents()
    {
        DisjointSets sets(static_cast<std::size_t>(_surface.FaceCount()));
        for (int t = 0; t < _surface.FaceCount(); ++t)
            for (const Side mate : _surface.mesh.triangle[t].n)
                if (mate != NoSide)
                    sets.Join(t, SideTriangle(mate));
        for (int t = 0; t < _surface.FaceCount(); ++t)
            _component.push_back(sets.SetOf(t));
    }

    bool OneComponent(int face, int other) const { return _component.empty() || _component[face] == _component[other]; }

    // Whether normals and the way from a keeper to a point say that they lie on one sheet: where it leads off the
    // surface, those whose normals agree may be on two.
    bool Compatible(const Keeper &k, const Point &p, const Point &normal) const
    {
        const double cosine = Dot(k.normal, normal);
        const Point way = p - k.point;
        const double off = Dot(way, normal);
        return (_orientable ? cosine : std::abs(cosine)) > 0.2 && off * off < 0.36 * SquaredNorm(way);
    }

    // Whether a keeper that is near in space is so on the surface too.
    bool OnSheet(const Keeper &k, const Point &p, int face, const Point &normal, double radius) const
    {
        // Those that are not compatible may be on one sheet all the same, as in a crumpled spot.
        return OneComponent(face, k.face) &&
               (k.onFeature || Compatible(k, p, normal) || _surface.Joined(face, k.face, p, radius, MostJoined));
    }

    bool Free(const PointBuckets &buckets, const Point &p, int face, const Point &normal, double radius, double spacing)
    {
        bool free = true;
        buckets.Near(p, radius, spacing, [&](int i, double) {
            free = !OnSheet(_keeper[i], p, face, normal, radius);
            return free;
        });
        return free;
    }

    std::vector<SurfacePoint> Advance(const std::vector<CurveSample> &onCurves, int count, double scale, Random &random)
    {
        _scale = scale;
        PointBuckets buckets(_base, static_cast<std::size_t>(count) + onCurves.size() + _features.corner.size());
        _keeper.clear();
        _queue.clear();
        std::vector<SurfacePoint> found;
        for (const int v : _features.corner)
            Keep(buckets, {_surface.position[v], Point(0, 0, 0), _surface.mesh.incident[v], true},
                 _scale * _density.spacing[v]);
        KeepAll(buckets, onCurves);
        for (const CurveSample &c : onCurves)
            ProposeFromCurve(buckets, c, found);
        std::size_t next = 0;
        const auto drain = [&] {
            for (; next < _queue.size(); ++next)
                ProposeAround(buckets, next, found);
        };
        drain();
        // Where the front has not come: other components, and pockets behind narrow places.
        for (const SurfacePoint &p : SampleFaces(_surface, _density, count, random)) {
            Take(buckets, p, Any(p.face), true, found);
            drain();
        }
        return found;
    }

    // Arc lengths grow along a curve, so the segment is found by bisection.
    static int HintSegment(const FeatureCurve &c, double s)
    {
        const auto at = std::upper_bound(c.arc.begin(), c.arc.end(), s);
        return static_cast<int>(at - c.arc.begin()) - 1;
    }

    void Keep(PointBuckets &buckets, const Keeper &keeper, double spacing)
    {
        buckets.Add(keeper.point, spacing);
        _keeper.push_back(keeper);
    }

    void KeepAll(PointBuckets &buckets, const std::vector<CurveSample> &onCurves)
    {
        for (const CurveSample &c : onCurves) {
            const FeatureCurve &curve = _features.curve[c.curve];
            const int k = curve.SegmentAt(c.s, HintSegment(curve, c.s));
            const Point &a = _surface.position[curve.vertex[k]], &b = _surface.position[curve.vertex[k + 1]];
            const Point p = a + (b - a) * curve.Fraction(k, c.s);
            Keep(buckets, {p, Point(0, 0, 0), SideTriangle(curve.side[k]), true},
                 _scale * _density.spacing[curve.vertex[k]]);
        }
    }

    // Some direction in the plane of a face.
    Point Any(int face) const { return Corner(face, 1) - Corner(face, 0); }

    bool Take(PointBuckets &buckets, const SurfacePoint &at, const Point &direction, bool seed,
              std::vector<SurfacePoint> &found)
    {
        const Point p = _surface.At(at), normal = Normalized(_surface.AreaVector(at.face));
        const double h = Spacing(at);
        if (!Free(buckets, p, at.face, normal, 0.7 * h, h))
            return false;
        Keep(buckets, {p, normal, at.face, false}, h);
        _queue.push_back({at, p, direction, seed});
        found.push_back(at);
        return true;
    }

    void ProposeAround(PointBuckets &buckets, std::size_t index, std::vector<SurfacePoint> &found)
    {
        const Sample s = _queue[index];
        const Point normal = Normalized(_surface.AreaVector(s.at.face));
        const Point along = Normalized(s.direction), across = Cross(normal, along);
        if (!(SquaredNorm(along) > 0) || !(SquaredNorm(across) > 0))
            return;
        constexpr double half = 0.5, root = 0.8660254037844386;
        const double turn[6][2] = {{1, 0}, {half, root}, {half, -root}, {-half, root}, {-half, -root}, {-1, 0}};
        const double h = Spacing(s.at);
        // The last leads back to where the front came from.
        for (int k = 0; k < (s.seed ? 6 : 5); ++k)
            Propose(buckets, s.at, s.point, normal, along * turn[k][0] + across * turn[k][1], h, found);
    }

    // Into both faces, where the apices of equilateral triangles on the curve would lie.
    void ProposeFromCurve(PointBuckets &buckets, const CurveSample &c, std::vector<SurfacePoint> &found)
    {
        const FeatureCurve &curve = _features.curve[c.curve];
        const int k = curve.SegmentAt(c.s, HintSegment(curve, c.s));
        const Point &a = _surface.position[curve.vertex[k]], &b = _surface.position[curve.vertex[k + 1]];
        const double fraction = curve.Fraction(k, c.s);
        const Point p = a + (b - a) * fraction, along = Normalized(b - a);
        const double h = _scale * ((1 - fraction) * _density.spacing[curve.vertex[k]] +
                                   fraction * _density.spacing[curve.vertex[k + 1]]);
        for (const Side side : {curve.side[k], _surface.mesh.Mate(curve.side[k])}) {
            if (side == NoSide)
                continue;
            const int face = SideTriangle(side);
            const Triangle &T = _surface.mesh.triangle[face];
            SurfacePoint at;
            at.face = face;
            for (int i = 0; i < 3; ++i)
                at.weight[i] = T.v[i] == curve.vertex[k] ? 1 - fraction : T.v[i] == curve.vertex[k + 1] ? fraction : 0;
            const Point apex = Corner(face, SideEdge(side)) - p;
            const Point inward = Normalized(apex - along * Dot(apex, along));
            const Point normal = Normalized(_surface.AreaVector(face));
            for (const double s : {0.5, -0.5})
                Propose(buckets, at, p, normal, along * s + inward * 0.8660254037844386, h, found);
        }
    }

    void Propose(PointBuckets &buckets, const SurfacePoint &from, const Point &start, const Point &normal,
                 const Point &direction, double length, std::vector<SurfacePoint> &found)
    {
        // Most proposals are taken already: a look at where the line would end on a flat surface saves it.
        const Point end = start + direction * length;
        bool taken = false;
        buckets.Near(end, 0.3 * length, length, [&](int i, double) {
            taken = !_keeper[i].onFeature && OneComponent(from.face, _keeper[i].face) &&
                    Compatible(_keeper[i], end, normal);
            return !taken;
        });
        if (taken)
            return;
        SurfacePoint at = from;
        Point d = direction;
        if (Trace(at, start, d, length))
            Take(buckets, at, d, false, found);
    }

    // Follows a straight line from x over the unfolded faces; `direction` is of length 1 and in the plane of the first.
    // Afterwards `at` is its end, and `direction` that in which it got there. False when it meets a feature or gets
    // nowhere.
    bool Trace(SurfacePoint &at, const Point &x, Point &direction, double length) const
    {
        const Triangle &first = _surface.mesh.triangle[at.face];
        const Point &p0 = _surface.position[first.v[0]];
        const Point e1 = _surface.position[first.v[1]] - p0, e2 = _surface.position[first.v[2]] - p0, n = Cross(e1, e2);
        const double nn = SquaredNorm(n);
        if (!(nn > 0))
            return false;
        const auto weights = [&](const Point &r, double *w) {
            w[1] = Dot(Cross(r, e2), n) / nn;
            w[2] = Dot(Cross(e1, r), n) / nn;
        };
        double w[3], rate[3];
        weights(x - p0, w);
        w[0] = 1 - w[1] - w[2];
        weights(direction, rate);
        rate[0] = -rate[1] - rate[2];
        int exit = -1;
        double way = length;
        for (int i = 0; i < 3; ++i)
            if (rate[i] < 0 && std::max(w[i], 0.0) < way * -rate[i]) {
                way = std::max(w[i], 0.0) / -rate[i];
                exit = i;
            }
        if (exit < 0)
            return Settle(at, w[0] + rate[0] * way, w[1] + rate[1] * way, w[2] + rate[2] * way);

        // Unfolded into a plane, the line is the x-axis: what counts of each edge is where its ends lie, to the left
        // and to the right of it.
        struct End {
            int vertex;
            double x, y;
        };
        const Point across = Cross(n, direction) / std::sqrt(nn);
        const auto place = [&](int v) {
            const Point r = _surface.position[v] - x;
            return End{v, Dot(r, direction), Dot(r, across)};
        };
        End right = place(first.v[Next(exit)]), left = place(first.v[Prev(exit)]);
        for (int step = 0; step < 1000; ++step) {
            const Triangle &T = _surface.mesh.triangle[at.face];
            const Side mate = T.n[exit];
            if (mate == NoSide || T.Constrained(exit))
                return false;
            at.face = SideTriangle(mate);
            const Triangle &U = _surface.mesh.triangle[at.face];
            const int i = SideEdge(mate), atLeft = U.v[Next(i)] == left.vertex ? Next(i) : Prev(i);
            const Point &r = _surface.position[right.vertex];
            const Point edge = _surface.position[left.vertex] - r, toApex = _surface.position[U.v[i]] - r;
            const double ex = left.x - right.x, ey = left.y - right.y, squared = SquaredNorm(edge);
            if (!(squared > 0))
                return false;
            const double along = Dot(toApex, edge) / squared;
            const double height = std::sqrt(std::max(SquaredNorm(toApex) / squared - along * along, 0.0));
            const End apex = {U.v[i], right.x + along * ex + height * ey, right.y + along * ey - height * ex};
            // The far edge that the line leaves by, and whether its end comes before.
            const bool turnsRight = apex.y > 0;
            const End &l = turnsRight ? apex : left, &m = turnsRight ? right : apex;
            if (m.x * l.y - l.x * m.y > length * (l.y - m.y)) {
                if (!(height > 0))
                    return false;
                // (length, 0) - right = s * edge + t * its normal
                const double dx = length - right.x, dy = -right.y, plane = ex * ex + ey * ey;
                const double s = (dx * ex + dy * ey) / plane, t = (dx * ey - dy * ex) / plane;
                double weight[3];
                weight[i] = t / height;
                weight[atLeft] = s - along * weight[i];
                weight[3 - i - atLeft] = 1 - weight[i] - weight[atLeft];
                direction = Normalized(edge * ex + (toApex - edge * along) * (ey / height));
                return Settle(at, weight[0], weight[1], weight[2]);
            }
            exit = turnsRight ? atLeft : 3 - i - atLeft;
            (turnsRight ? left : right) = apex;
        }
        return false;
    }

    // The point of a face with these weights, but for rounding. False if there is none.
    static bool Settle(SurfacePoint &at, double w0, double w1, double w2)
    {
        const double weight[3] = {std::max(w0, 0.0), std::max(w1, 0.0), std::max(w2, 0.0)};
        const double sum = weight[0] + weight[1] + weight[2];
        for (int i = 0; i < 3; ++i)
            at.weight[i] = weight[i] / sum;
        return sum > 0;
    }

    // Takes away the samples with the nearest neighbours.
    void Thin(std::vector<SurfacePoint> &samples, int count, Workers &workers)
    {
        _scale = _bestScale;
        PointBuckets buckets(_base, samples.size());
        for (const SurfacePoint &s : samples)
            buckets.Add(_surface.At(s), Spacing(s));
        std::vector<std::pair<double, int>> order(samples.size());
        std::vector<int> nearest(samples.size(), -1);
        Chunks::For(workers, buckets.Size(), [&](int first, int last, int) {
            for (int i = first; i < last; ++i) {
                const double h = Spacing(samples[i]);
                double closest = 2 * h * h;
                buckets.Near(_surface.At(samples[i]), 1.4 * h, h, [&](int k, double d) {
                    if (k != i && d < closest) {
                        closest = d;
                        nearest[i] = k;
                    }
                    return true;
                });
                order[i] = {closest / (h * h), i};
            }
        });
        SortInParts(workers, order, std::less<>());
        std::vector<char> gone(samples.size(), 0);
        int left = static_cast<int>(samples.size());
        for (int pass = 0; pass < 2; ++pass)
            for (const auto &[d, i] : order)
                if (left > count && !gone[i] && (pass == 1 || nearest[i] < 0 || !gone[nearest[i]])) {
                    gone[i] = 1;
                    --left;
                }
        std::vector<SurfacePoint> kept;
        for (std::size_t i = 0; i < samples.size(); ++i)
            if (!gone[i])
                kept.push_back(samples[i]);
        samples.swap(kept);
    }

    // Adds random points, the wider gaps first.
    void Fill(std::vector<SurfacePoint> &samples, const std::vector<CurveSample> &onCurves, int count, Random &random)
    {
        _scale = _bestScale;
        PointBuckets buckets(_base, static_cast<std::size_t>(count) + onCurves.size());
        _keeper.clear();
        KeepAll(buckets, onCurves);
        for (const SurfacePoint &s : samples)
            Keep(buckets, {_surface.At(s), Normalized(_surface.AreaVector(s.face)), s.face, false}, Spacing(s));
        for (double radius = 0.68; static_cast<int>(samples.size()) < count; radius *= 0.93) {
            const int darts = std::max(64, radius > 0.05 ? 2 * count : 0);
            for (const SurfacePoint &p : SampleFaces(_surface, _density, darts, random)) {
                if (static_cast<int>(samples.size()) == count)
                    return;
                const Point x = _surface.At(p), normal = Normalized(_surface.AreaVector(p.face));
                const double h = Spacing(p);
                if (radius < 0.05 || Free(buckets, x, p.face, normal, radius * h, h)) {
                    Keep(buckets, {x, normal, p.face, false}, h);
                    samples.push_back(p);
                }
            }
        }
    }
};

} // namespace ccdm
} // namespace vcg

#endif
