// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_APPROXIMATION_H
#define VCG_CCDM_APPROXIMATION_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <vcg/complex/algorithms/ccdm/angle_polish.h>
#include <vcg/complex/algorithms/ccdm/probes.h>

namespace vcg {
namespace ccdm {

/// Brings the remesh closer to the surface, where it strays most, by flips and by moves over the surface
/// that weigh the squared distance against the sum of the smallest angles. Neither the paper's energy nor
/// the angles see the distance between the surfaces (paper, section 4, limitations).
class Approximation
{
public:
    Approximation(const Model &model, Remesh &remesh, Probes &probes, Workers &workers)
        : _model(model), _remesh(remesh), _probe(probes), _workers(workers), _schedule(remesh, workers),
          _relocator(workers, Relocator(model, remesh)), _watched(workers), _anchor(workers)
    {
    }

    /// `rounds` times through the parts that stray, the moves getting smaller. `weight`: radians of angle
    /// that a triangle may lose for each mean squared distance that it gets nearer.
    void Run(double weight, int rounds)
    {
        const int triangles = _remesh.mesh.TriangleCount();
        if (!(weight > 0) || triangles == 0)
            return;
        _stray.assign(triangles, 0);
        _middle.assign(3 * static_cast<std::size_t>(triangles), 0);
        _active.assign(_remesh.VertexCount(), 1);
        double size = 0.12;
        for (int round = 0; round < rounds; ++round, size *= 0.8) {
            Measure();
            if (round % 2 == 0)
                _probe.Find();
            if (round == 0) {
                SetScale(weight);
                if (!(_mean > 0))
                    return;
            }
            Activate();
            _schedule.ForVertices([&](int v, int worker) {
                if (_active[v] != 0 && _remesh.place[v].kind != VertexKind::Corner)
                    Climb(v, size, worker);
            });
            Flip();
        }
    }

private:
    /// Parts that stray by more than this many mean squared distances are worked on.
    static constexpr double Cut = 4;
    /// A probe counts if it is further away than this many root mean square distances.
    static constexpr double FarProbe = 4;
    /// Outliers: squared distances above so many mean ones, and above this share of the largest. Measured:
    /// without the share, models with many tips lose angle for them.
    static constexpr double Outlier = 16, OutlierShare = 0.3;
    /// Where the mean squared distance is less than this times the mean squared edge, nothing strays.
    static constexpr double Flat = 1e-12;
    static constexpr int MostProbes = 6;
    /// Below this angle, in radians, a loss counts three times.
    static constexpr double LowAngle = 0.75;

    struct Anchor {
        int face;
        Point point;
    };

    const Model &_model;
    Remesh &_remesh;
    Probes &_probe;
    Workers &_workers;
    PatchSchedule _schedule;
    PerWorker<Relocator> _relocator;
    PerWorker<std::array<int, MostProbes>> _watched; // probes of the star at hand
    PerWorker<std::vector<Anchor>> _anchor;          // points of the surface next to its samples
    std::vector<double> _stray;                      // of each triangle: mean squared distance of its samples
    std::vector<float> _middle;                      // of each side: squared distance of its middle, if a Measurer
    std::vector<std::uint8_t> _active;
    double _mean = 0;    // of the squared distances
    double _weight = 0;  // of a squared distance
    double _outlier = 0; // squared distance from which on it costs more

    double SquaredDistance(int v, const Point &p) const { return SquaredDistanceNear(_model, _remesh, v, p, 0.05); }

    // The vertex of a triangle from which to look for points of the surface near it: a free one, as the
    // others may be at home on the far side of a feature.
    int Home(int a, int b, int c) const
    {
        const auto free = [&](int v) { return _remesh.place[v].kind == VertexKind::Free; };
        return free(a) || !(free(b) || free(c)) ? a : free(b) ? b : c;
    }

    bool MayHaveChanged(int t) const
    {
        const Triangle &T = _remesh.mesh.triangle[t];
        return _active[T.v[0]] != 0 || _active[T.v[1]] != 0 || _active[T.v[2]] != 0;
    }

    float &MiddleOf(Side s) { return _middle[3 * static_cast<std::size_t>(SideTriangle(s)) + SideEdge(s)]; }

    // The side whose triangle measures the middle of the edge for both: the lower one of those that may have changed.
    // At a feature each measures its own, as they may see different surfaces.
    Side Measurer(Side s) const
    {
        const Side mate = _remesh.mesh.Mate(s);
        return mate == NoSide || _remesh.mesh.Constrained(s) || s < mate || !MayHaveChanged(SideTriangle(mate)) ? s
                                                                                                                : mate;
    }

    // The chords of features cannot be mended and do not count, if there are other triangles.
    void SetScale(double weight)
    {
        double sum = 0, all = 0, most = 0, edges = 0;
        int free = 0;
        for (int t = 0; t < _remesh.mesh.TriangleCount(); ++t) {
            const Triangle &T = _remesh.mesh.triangle[t];
            all += _stray[t];
            edges += SquaredNorm(_remesh.position[T.v[1]] - _remesh.position[T.v[0]]);
            if (std::all_of(std::begin(T.v), std::end(T.v),
                            [&](int v) { return _remesh.place[v].kind == VertexKind::Free; })) {
                sum += _stray[t];
                most = std::max(most, _stray[t]);
                ++free;
            }
        }
        for (int r = 0; r < _probe.Count(); ++r)
            most = std::max(most, _probe.Distance(r) * _probe.Distance(r));
        _mean = free > 0 ? sum / free : all / _remesh.mesh.TriangleCount();
        if (_mean < Flat * edges / _remesh.mesh.TriangleCount())
            _mean = 0;
        _weight = weight / std::max(_mean, 1e-300);
        _outlier = std::max(Outlier * _mean, OutlierShare * most);
    }

    // What a squared distance costs, in mean ones: outliers, which make the Hausdorff distance, cost more.
    double Cost(double d) const
    {
        const double excess = std::max(0.0, d - _outlier);
        return d + 0.5 * excess * excess / _mean;
    }

    double CostSlope(double d) const { return 1 + std::max(0.0, d - _outlier) / _mean; }

    // Only what may have changed. The centroid counts as much as the middles of two sides, each of which two triangles
    // share.
    void Measure()
    {
        const auto changed = [&](const auto &visit) {
            Chunks::For(_workers, _remesh.mesh.TriangleCount(), [&](int first, int last, int) {
                for (int t = first; t < last; ++t)
                    if (MayHaveChanged(t))
                        visit(t);
            });
        };
        changed([&](int t) {
            const Triangle &T = _remesh.mesh.triangle[t];
            const int home = Home(T.v[0], T.v[1], T.v[2]);
            const auto at = [&](int i) -> const Point & { return _remesh.position[T.v[i]]; };
            _stray[t] = 0.4 * SquaredDistance(home, (at(0) + at(1) + at(2)) / 3);
            for (int e = 0; e < 3; ++e)
                if (Measurer(MakeSide(t, e)) == MakeSide(t, e))
                    MiddleOf(MakeSide(t, e)) =
                        static_cast<float>(SquaredDistance(home, (at(Next(e)) + at(Prev(e))) / 2));
        });
        changed([&](int t) {
            for (int e = 0; e < 3; ++e)
                _stray[t] += 0.2 * MiddleOf(Measurer(MakeSide(t, e)));
        });
    }

    bool Far(int r) const { return _probe.Distance(r) * _probe.Distance(r) > FarProbe * FarProbe * _mean; }

    void Activate()
    {
        const auto strays = [&](int t) {
            bool far = _stray[t] > Cut * _mean;
            for (int k = _probe.First(t); k < _probe.First(t + 1) && !far; ++k)
                far = Far(_probe.Owned(k));
            return far;
        };
        std::fill(_active.begin(), _active.end(), 0);
        for (const int t : Chunks::Where(_workers, _remesh.mesh.TriangleCount(), strays))
            for (const int v : _remesh.mesh.triangle[t].v)
                _active[v] = 1;
    }

    // The farthest probes of the star of v; -1 ends the list.
    void Watch(int v, std::array<int, MostProbes> &watched) const
    {
        watched.fill(-1);
        _remesh.mesh.VisitSpokes(v, [&](int, Side s) {
            const int t = SideTriangle(s);
            for (int k = _probe.First(t); k < _probe.First(t + 1); ++k) {
                int r = _probe.Owned(k);
                if (!Far(r))
                    continue;
                for (int &w : watched)
                    if (w < 0 || _probe.Distance(w) < _probe.Distance(r))
                        std::swap(w, r);
            }
            return true;
        });
    }

    void Climb(int v, double size, int worker)
    {
        std::array<int, MostProbes> &watched = _watched[worker];
        Watch(v, watched);
        const Point x = _remesh.position[v];
        // The samples of later positions are looked for where those of the first one were found.
        std::vector<Anchor> &anchor = _anchor[worker];
        anchor.clear();
        const auto stray = [&](std::size_t i, const Point &p, double share, Point *gradient) {
            const auto [face, foot] = _model.surface.Project(anchor[i].face, anchor[i].point, p, 0.05);
            anchor[i] = {face, foot.point};
            if (gradient != nullptr)
                *gradient -= (p - foot.point) * (0.8 * _weight * share * CostSlope(foot.squaredDistance));
            return Cost(foot.squaredDistance);
        };
        const auto score = [&](const LocalStar &star, const Point &q, Point *gradient, double wanted) {
            if (anchor.empty())
                for (int k = 0; k < star.triangles; ++k) {
                    const int home = Home(v, star.id[k], star.id[k + 1]);
                    anchor.insert(anchor.end(), 2, {_remesh.place[home].face, _remesh.position[home]});
                }
            double sum = 0;
            for (int k = 0; k < star.triangles; ++k) {
                const double angle =
                    gradient != nullptr
                        ? SmallestAngleAt(star, k, *gradient,
                                          [](double smallest) { return smallest < LowAngle ? 3.0 : 1.0; })
                        : SmallestAngle(q, star.spoke[k], star.spoke[k + 1]);
                sum += angle - 2 * std::max(0.0, LowAngle - angle);
            }
            for (const int r : watched)
                if (r >= 0) {
                    const Point p = _probe[r].point - x;
                    const Foot foot = NearestOnStar(star, q, p);
                    sum -= _weight * Cost(foot.squaredDistance);
                    if (gradient != nullptr)
                        *gradient +=
                            (p - foot.point) * (2 * _weight * foot.weight[0] * CostSlope(foot.squaredDistance));
                }
            // These cost most, and only lower the sum.
            for (int k = 0; k < star.triangles && sum > wanted; ++k) {
                const Point &a = star.spoke[k], &b = star.spoke[k + 1];
                sum -= 0.4 * _weight *
                       (stray(2 * k, x + (q + a + b) / 3, 1.0 / 3, gradient) +
                        stray(2 * k + 1, x + (q + a) / 2, 0.5, gradient));
            }
            return sum;
        };
        _relocator[worker].Ascend(v, size, score, false);
    }

    static Foot NearestOnStar(const LocalStar &star, const Point &q, const Point &p)
    {
        Foot nearest;
        nearest.squaredDistance = 1e300;
        for (int k = 0; k < star.triangles; ++k) {
            const Foot foot = NearestOnTriangle(q, star.spoke[k] - q, star.spoke[k + 1] - q, p);
            if (foot.squaredDistance < nearest.squaredDistance)
                nearest = foot;
        }
        return nearest;
    }

    bool FlipHelps(Side s, const Hinge &h) const
    {
        if (_remesh.mesh.Constrained(s))
            return false;
        const double before = SmallestAngle(h.a, h.p, h.q) + SmallestAngle(h.b, h.p, h.q);
        const double after = SmallestAngle(h.a, h.p, h.b) + SmallestAngle(h.a, h.b, h.q);
        if (after < before - 0.5)
            return false;
        const int home = Home(h.apexA, _remesh.mesh.Tail(s), _remesh.mesh.Head(s));
        const double now = SquaredDistance(home, (h.p + h.q) / 2), then = SquaredDistance(home, (h.a + h.b) / 2);
        return after - before > 2 * _weight * (Cost(then) - Cost(now)) + 1e-3;
    }

    void Flip()
    {
        _schedule.ForEdges(
            [&](Side s) {
                const Side mate = _remesh.mesh.Mate(s);
                return std::max(_stray[SideTriangle(s)], _stray[SideTriangle(mate)]) > Cut * _mean &&
                       FlipHelps(s, Hinge(_remesh, s));
            },
            [&](Side s) {
                if (_remesh.mesh.Mate(s) == NoSide)
                    return;
                const Hinge h(_remesh, s);
                if (FlipHelps(s, h) && MayFlip(_remesh, s, h))
                    _remesh.mesh.Flip(s);
            });
    }
};

} // namespace ccdm
} // namespace vcg

#endif
