// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_OPTIMIZER_H
#define VCG_CCDM_OPTIMIZER_H

#include <functional>
#include <vector>

#include <vcg/complex/algorithms/ccdm/angle_polish.h>
#include <vcg/complex/algorithms/ccdm/centroid_rules.h>
#include <vcg/complex/algorithms/ccdm/delaunay.h>
#include <vcg/complex/algorithms/ccdm/extremes.h>
#include <vcg/complex/algorithms/ccdm/polish.h>

namespace vcg {
namespace ccdm {

/// Improves a remesh by alternating Delaunay flips and vertex relocations (paper, sections 3.3, 3.4).
class Optimizer
{
public:
    /// Called with the share of the work done, in [0, 1]; false stops the optimisation.
    using Progress = std::function<bool(double)>;

    Optimizer(const Model &model, const Params &params, Remesh &remesh, Report &report, Workers &workers)
        : _model(model), _params(params), _remesh(remesh), _report(report), _workers(workers),
          _schedule(remesh, workers), _relocator(workers.Count(), Relocator(model, remesh)), _flipper(workers),
          _random(params.seed ^ 0x6f7074696d697a65ULL)
    {
    }

    /// Runs the optimiser that the parameters name. False when `progress` stopped it.
    bool Run(const Progress &progress)
    {
        switch (_params.optimizer) {
        case OptimizerKind::Annealing:
            return Anneal(progress);
        case OptimizerKind::Accelerated:
            return Accelerate(progress);
        }
        return false;
    }

    /// After Run: puts vertices on tips that are still cut off, opens folds, brings back triangles that
    /// stray from the surface, and raises the smallest angles.
    void Close()
    {
        ReleaseExtremes();
        Polish polish(_model, _remesh);
        polish.Unfold(10);
        polish.Approach(5, 30, 5);
        polish.RaiseAngles(MinAngle(_params), 0.1, 20);
        polish.RaiseAngles(MinAngle(_params), 0.2, 20);
        polish.RaiseAngles(30, 0.3, 20);
        polish.RaiseAngles(30, 1.0, 20);
    }

private:
    const Model &_model;
    const Params &_params;
    Remesh &_remesh;
    Report &_report;
    Workers &_workers;
    PatchSchedule _schedule;
    std::vector<Relocator> _relocator; // one for each worker
    DelaunayFlipper _flipper;
    Random _random;
    std::vector<int> _pinned; // vertices held on a tip of the input

    void Flip()
    {
        const long long flips = _flipper.Run(_remesh);
        if (flips > 0)
            _schedule.Changed();
        _report.flips += flips;
    }

    template <class Displacement>
    void Sweep(const Displacement &displacement)
    {
        _schedule.ForVertices([&](int v, int worker) { _relocator[worker].Relocate(v, displacement); });
        _report.relocations += _remesh.VertexCount();
    }

    // Algorithm 1: Delaunay mesh, then every vertex to its centroid.
    void OptimizeLocally()
    {
        for (int i = 0; i < _params.localIterations; ++i) {
            Flip();
            Sweep(PatchCentroid{_remesh, _model.density.uniform});
        }
        Flip();
    }

    // Vertices that are put on a tip stay there while the others settle around them.
    void PinExtremes()
    {
        for (const int v : ExtremeCapture(_model, _remesh).Run(5, 24)) {
            _remesh.place[v].kind = VertexKind::Corner;
            _pinned.push_back(v);
        }
    }

    void ReleaseExtremes()
    {
        for (const int v : _pinned)
            _remesh.place[v].kind = VertexKind::Free;
        _pinned.clear();
        ExtremeCapture(_model, _remesh).Run(5, 30);
    }

    // Section 3.4: perturb, optimise locally, keep the state only if it has the lower energy.
    bool Anneal(const Progress &progress)
    {
        OptimizeLocally();
        Remesh best = _remesh;
        double bestEnergy = Energy(_remesh, _workers);
        _report.energy.assign(1, bestEnergy);
        for (int i = 0; i < _params.globalIterations; ++i) {
            const int left = _params.globalIterations - i;
            if (left == 9 || left == 6 || left == 3) {
                PinExtremes();
                best = _remesh;
                bestEnergy = Energy(_remesh, _workers);
            }
            Sweep(Perturbation{_params.lambda, _random.Bits()});
            OptimizeLocally();
            const double energy = Energy(_remesh, _workers);
            if (energy < bestEnergy) {
                bestEnergy = energy;
                best = _remesh;
                ++_report.accepted;
            } else {
                _remesh = best;
                _schedule.Changed();
            }
            _report.energy.push_back(bestEnergy);
            if (!progress(static_cast<double>(i + 1) / _params.globalIterations))
                return false;
        }
        OptimizeLocally();
        return true;
    }

    // Momentum on the cell centroid, with noise that fades out: moves past the poor local optima where
    // plain relocation stalls. Ends with relocations to the patch centroid, so that the result is a
    // centroidal Delaunay mesh as the paper defines it.
    bool Accelerate(const Progress &progress)
    {
        const bool uniform = _model.density.uniform;
        const int count = _params.globalIterations * _params.localIterations;
        std::vector<Point> last = _remesh.position;
        const HeavyBall<CellCentroid> pull = {
            {_remesh, uniform}, {{_remesh, uniform}}, 1.5, 0.6, _remesh.position, last};
        Flip();
        _report.energy.assign(1, Energy(_remesh, _workers));
        for (int i = 0; i < count; ++i) {
            const double noise = 0.5 * _params.lambda * (1 - i / (0.6 * count));
            if (i % 3 == 0 && noise > 0) {
                const Perturbation perturb{noise, _random.Bits()};
                Sweep([&](const LocalStar &star, int v) { return Point(pull(star, v) + perturb(star, v)); });
            } else {
                Sweep(pull);
            }
            Flip();
            if ((i + 1) % _params.localIterations == 0) {
                _report.energy.push_back(Energy(_remesh, _workers));
                ++_report.accepted; // no state is taken back
            }
            if (i == count * 4 / 5 || i == count * 9 / 10)
                PinExtremes();
            if (!progress(0.9 * (i + 1) / count))
                return false;
        }
        for (int i = 0; i < ClosingRelocations; ++i) {
            Sweep(PatchCentroid{_remesh, uniform});
            Flip();
        }
        AnglePolish(_model, _remesh, _workers).Run(PolishRounds);
        _schedule.Changed();
        return progress(1);
    }

    static constexpr int ClosingRelocations = 6;
    static constexpr int PolishRounds = 14;
};

} // namespace ccdm
} // namespace vcg

#endif
