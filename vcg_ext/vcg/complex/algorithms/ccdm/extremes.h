// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_EXTREMES_H
#define VCG_CCDM_EXTREMES_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/parallel.h>
#include <vcg/complex/algorithms/ccdm/patch_schedule.h>
#include <vcg/complex/algorithms/ccdm/probes.h>
#include <vcg/complex/algorithms/ccdm/trial_patch.h>

namespace vcg {
namespace ccdm {

/// Puts vertices of the remesh onto the tips and ridges of the input that the remesh cuts off. Relocation pays no
/// regard to the distance between the surfaces (paper, section 4, limitations), so the distance there would
/// otherwise be several times that of the rest.
class ExtremeCapture
{
public:
    ExtremeCapture(const Model &model, Remesh &remesh, Probes &probes, Workers &workers)
        : _remesh(remesh), _probe(probes), _workers(workers), _hand(workers, Hand(model, remesh, probes, _run))
    {
    }
    ExtremeCapture(const ExtremeCapture &) = delete;
    ExtremeCapture &operator=(const ExtremeCapture &) = delete;

    /// Finds the probes furthest from the remesh, those beyond `outlier` times the root mean square
    /// distance, and moves a free vertex onto each, with those around making room, if no angle under `minAngle`
    /// degrees (or 25, for what is more than a spacing away) comes about that was not there, no edge gets too sharp,
    /// and nothing else around gets further away. Returns the vertices that now sit on a tip.
    std::vector<int> Run(double outlier, double minAngle)
    {
        _probe.Find();
        double squares = 0;
        for (int r = 0; r < _probe.Count(); ++r)
            squares += _probe.Distance(r) * _probe.Distance(r);
        _run.limit = outlier * std::sqrt(squares / std::max(_probe.Count(), 1));
        _run.cosine = std::cos(minAngle * Pi / 180);
        _run.settled.assign(_remesh.VertexCount(), 0);
        std::vector<Task> task = Divide();
        _workers.For(static_cast<int>(task.size()) - 1, [&](int region, int worker) {
            const int vertices = std::min(Regions::Size, _remesh.VertexCount() - region * Regions::Size);
            _hand[worker].Work(task[region], region, Tries(vertices));
        });
        // What reaches out of its region comes last, and what was one too many for it.
        Task &last = task.back();
        int tries = Tries(_remesh.VertexCount());
        for (std::size_t k = 0; k + 1 < task.size(); ++k) {
            last.worst.insert(last.worst.end(), task[k].left.begin(), task[k].left.end());
            last.captured.insert(last.captured.end(), task[k].captured.begin(), task[k].captured.end());
            tries -= task[k].tries;
        }
        SortByDistance(last.worst);
        _hand[0].Work(last, Everywhere, std::max(tries, Tries(0)));
        return last.captured;
    }

private:
    static constexpr int Everywhere = -1;

    // What all captures of a run are to keep to.
    struct Limits {
        double limit = 0;          // nearer probes are of no interest
        double cosine = 1;         // of the smallest angle
        std::vector<char> settled; // vertices on tips
    };

    // The probes of a region, or those of none.
    struct Task {
        std::vector<int> worst, left; // the latter reach out of it, or are too many
        std::vector<int> captured;    // vertices
        int tries = 0;
    };

    // What a worker needs.
    class Hand
    {
    public:
        Hand(const Model &model, Remesh &remesh, const Probes &probes, Limits &run)
            : _model(model), _remesh(remesh), _probe(probes), _run(run), _patch(model, remesh)
        {
        }

        // In order, at most `tries` of them. What it writes lies two rings inside the region at least, as the triangles
        // of a patch reach one ring further than its vertices, and what they turn against one more; so what it reads,
        // one ring outside at most, no other worker writes.
        void Work(Task &task, int region, int tries)
        {
            _region = region;
            for (std::size_t k = 0; k < task.worst.size(); ++k) {
                const int r = task.worst[k];
                // What was captured before may have brought this one close.
                const auto [t, squared] = Nearest(r);
                if (std::sqrt(squared) <= _run.limit)
                    continue;
                if (region != Everywhere && !_patch.AllWithin(t, Rings + 2, [&](int v) { return Open(v); })) {
                    task.left.push_back(r);
                    continue;
                }
                _patch.Take(t, Rings);
                const double distance = DistanceInPatch(r, squared);
                if (distance <= _run.limit)
                    continue;
                if (task.tries == tries) {
                    task.left.insert(task.left.end(), task.worst.begin() + static_cast<std::ptrdiff_t>(k),
                                     task.worst.end());
                    break;
                }
                ++task.tries;
                const int v = Capture(r, t, distance);
                if (v < 0)
                    continue;
                _run.settled[v] = 1;
                task.captured.push_back(v);
            }
        }

    private:
        /// A part that is cut off by more than so many spacings may get the sharper turn. Measured: the milder one
        /// leaves such parts cut off, the sharper one is no gain where less is missing.
        static constexpr double CutOff = 0.45;
        static constexpr double TurnCosineLimit = -0.17364817766693033;   // of 100 degrees
        static constexpr double SharperCosineLimit = -0.6427876096865394; // of 130 degrees
        /// One that is cut off by more than so many may get an angle of 25 degrees, even if more is asked for.
        /// Measured: the last vertex of a horn or a finger costs an angle of 30 to 39 degrees and takes away a third of
        /// the largest distance; from 0.7 spacings on it would cost such angles on statues too, and with 15 degrees
        /// thin wings fold.
        static constexpr double PartOff = 1;
        static constexpr double PartCosineLimit = 0.9063077870366499;
        /// A capture must bring the farthest probe around to less than this share of its distance.
        static constexpr double Gain = 0.9;
        static constexpr int Sweeps = 6;
        static constexpr int Rings = 4;
        /// Vertices tried for one tip. Measured: of 1164 captures a fourth vertex made 3; of 703 the second and the
        /// third made none by going all the way.
        static constexpr std::size_t MostCandidates = 3;

        const Model &_model;
        Remesh &_remesh;
        const Probes &_probe;
        Limits &_run;
        TrialPatch _patch;
        int _region = Everywhere;
        std::vector<int> _near; // probes around

        bool Open(int v) const { return _region == Everywhere || Regions::Of(v) == _region; }

        std::pair<int, double> Nearest(int r) const
        {
            return _probe.Locate(r, _remesh.mesh.triangle[_probe.Owner(r)].v[0], [&](int v) { return Open(v); });
        }

        // Of a probe, now.
        double Distance(int r) const { return DistanceInPatch(r, Nearest(r).second); }

        // The same, of which a descent came to `squared`. It can end on a wrong part where the surface is crumpled:
        // what looks far is looked for in all of the patch.
        double DistanceInPatch(int r, double squared) const
        {
            if (squared > _run.limit * _run.limit)
                for (const int t : _patch.Triangles())
                    squared = std::min(squared, _probe.NearestOnRemesh(t, _probe[r].point).squaredDistance);
            return std::sqrt(squared);
        }

        // That of the farthest probe of the patch.
        double Stray() const
        {
            double worst = 0;
            for (const int r : _near)
                worst = std::max(worst, Distance(r));
            return worst;
        }

        // The free vertices of triangle t and its neighbours that are nearest to p, in order.
        std::vector<int> Candidates(int t, const Point &p) const
        {
            std::vector<int> found;
            const Triangle &T = _remesh.mesh.triangle[t];
            for (int i = 0; i < 3; ++i) {
                found.push_back(T.v[i]);
                if (T.n[i] != NoSide)
                    found.push_back(_remesh.mesh.Opposite(T.n[i]));
            }
            std::sort(found.begin(), found.end());
            found.erase(std::unique(found.begin(), found.end()), found.end());
            found.erase(std::remove_if(found.begin(), found.end(),
                                       [&](int v) { return !_patch.Contains(v) || _run.settled[v] != 0; }),
                        found.end());
            std::stable_sort(found.begin(), found.end(), [&](int a, int b) {
                return SquaredNorm(_remesh.position[a] - p) < SquaredNorm(_remesh.position[b] - p);
            });
            found.resize(std::min(found.size(), MostCandidates));
            return found;
        }

        // The vertex that now sits on probe r, `distance` from triangle t, around which the patch lies; -1 if none may.
        int Capture(int r, int t, double distance)
        {
            const Point target = _probe[r].point;
            _near.clear();
            for (const int k : _patch.Triangles())
                for (int i = _probe.First(k); i < _probe.First(k + 1); ++i)
                    _near.push_back(_probe.Owned(i));
            const double before = std::max(distance, Stray());
            const double spacings = distance / _model.density.spacing[_probe[r].vertex];
            const double least = spacings > PartOff ? PartCosineLimit : -1;
            const double cosine = std::max({_patch.WorstCosine(), _run.cosine, least});
            const double turn =
                std::min(_patch.WorstTurnCosine(), spacings > CutOff ? SharperCosineLimit : TurnCosineLimit);
            const std::vector<int> candidates = Candidates(t, target);
            for (std::size_t k = 0; k < candidates.size(); ++k) {
                const int v = candidates[k];
                const Point old = _remesh.position[v];
                // A tip behind a crease, or on another sheet, is not for this vertex.
                if (!_model.surface.Joined(_remesh.place[v].face, _probe[r].face, target, 1.5 * Norm(target - old),
                                           4096))
                    continue;
                for (double way = k > 0 ? 0.75 : 1; way >= 0.5; way -= 0.25) {
                    Put(r, v, old, way);
                    for (const int sweeps : {0, Sweeps}) {
                        if (sweeps > 0)
                            _patch.Relax(sweeps, [&](int o) { return o == v || _run.settled[o] != 0; });
                        // What is wrong is so next to the vertex, most often.
                        if (_patch.KeepsAt(v, cosine, turn) && _patch.Keeps(cosine, turn) &&
                            Distance(r) < Gain * distance && Stray() <= before)
                            return v;
                    }
                    _patch.Restore();
                }
            }
            return -1;
        }

        // Puts v on probe r, or `way` of the way there from its old position.
        void Put(int r, int v, const Point &old, double way)
        {
            const Point &target = _probe[r].point;
            const auto [face, foot] = _model.surface.Project(_probe[r].face, target, old + (target - old) * way, 0);
            _remesh.position[v] = way < 1 ? foot.point : target;
            _remesh.place[v].face = way < 1 ? face : _probe[r].face;
            _remesh.rho[v] = _model.density.rho[_probe[r].vertex];
        }
    };

    Remesh &_remesh;
    Probes &_probe;
    Workers &_workers;
    Limits _run;
    PerWorker<Hand> _hand;

    // Probes tried among so many vertices.
    static int Tries(int vertices) { return vertices / 500 + 8; }

    void SortByDistance(std::vector<int> &probes) const
    {
        std::sort(probes.begin(), probes.end(),
                  [&](int a, int b) { return std::pair(-_probe.Distance(a), a) < std::pair(-_probe.Distance(b), b); });
    }

    // The probes beyond the limit: those of each region, if there are several, and then those of none.
    std::vector<Task> Divide() const
    {
        const int regions = Regions::Count(_remesh.VertexCount());
        std::vector<Task> task(regions + 1);
        for (int r = 0; r < _probe.Count(); ++r) {
            if (!(_probe.Distance(r) > _run.limit))
                continue;
            const int(&v)[3] = _remesh.mesh.triangle[_probe.Owner(r)].v;
            const int region = Regions::Of(v[0]);
            const bool inside = regions > 1 && Regions::Of(v[1]) == region && Regions::Of(v[2]) == region;
            task[inside ? region : regions].worst.push_back(r);
        }
        for (Task &t : task)
            SortByDistance(t.worst);
        return task;
    }
};

} // namespace ccdm
} // namespace vcg

#endif
