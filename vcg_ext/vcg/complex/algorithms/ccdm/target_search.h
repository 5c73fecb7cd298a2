// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_TARGET_SEARCH_H
#define VCG_CCDM_TARGET_SEARCH_H

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/remesher.h>
#include <vcg/complex/algorithms/mesh_quality/surface_distance.h>

namespace vcg {
namespace ccdm {

/// Two-sided Hausdorff distance of meshes from one original, relative to the diagonal of its bounding box.
class ErrorMeter
{
public:
    /// `original` has passed the input check.
    explicit ErrorMeter(const MeshTables &original)
        : _frame(tri::TriangleSoup{original.position, original.face}),
          _original(_frame.Place({original.position, original.face})), _tree(_original), _diagonal(_original.Diagonal())
    {
    }

    /// The maximum is searched as DeviationMeter does.
    double Measure(const MeshTables &mesh, Workers &workers) const
    {
        const tri::TriangleSoup other = _frame.Place({mesh.position, mesh.face});
        const tri::TriangleTree tree(other);
        const std::size_t faces = _original.face.size() + other.face.size();
        const int samples = static_cast<int>(std::min(MostSamples, 1000 + SamplesPerFace * faces));
        std::array<double, 2> way = {0, 0};
        workers.For(2, [&](int k, int) {
            way[k] = (k == 0 ? tri::DeviationMeter(_original, tree) : tri::DeviationMeter(other, _tree))
                         .Measure(samples)
                         .max;
        });
        return std::max(way[0], way[1]) / _diagonal;
    }

private:
    static constexpr std::size_t SamplesPerFace = 8, MostSamples = 100000;

    const tri::UnitFrame _frame;
    const tri::TriangleSoup _original;
    const tri::TriangleTree _tree;
    const double _diagonal;
};

/// Remeshes to any target: looks for the vertex count that reaches it in few runs of the Remesher.
class TargetSearch
{
public:
    using Progress = Remesher::Progress;
    static constexpr double EdgeTolerance = 0.02;

    TargetSearch(const Params &params, Progress progress) : _params(params), _progress(std::move(progress)) {}

    /// `output` and, if there is one, `provenance` are filled only when the report's status is Done.
    Report Run(const MeshTables &input, MeshTables &output, Provenance *provenance = nullptr)
    {
        _wantsProvenance = provenance != nullptr;
        Result result;
        Report report = Search(input, result);
        if (report.status == Status::Done) {
            output = std::move(result.mesh);
            if (provenance != nullptr)
                *provenance = std::move(result.provenance);
        }
        return report;
    }

    /// Whether a run has reached what was asked for, an edge length to 2 percent.
    static bool Met(const Report &r)
    {
        if (r.status != Status::Done)
            return false;
        switch (r.target) {
        case TargetKind::Vertices:
            return r.reached == r.asked;
        case TargetKind::EdgeLength:
            return std::abs(r.reached / r.asked - 1) <= EdgeTolerance;
        case TargetKind::MaxError:
            return r.reached <= r.asked;
        }
        return false;
    }

    /// Whether a face has an index that is none of a vertex.
    static bool NamesMissingVertices(const MeshTables &input)
    {
        const auto vertices = static_cast<int>(input.position.size());
        return std::any_of(input.face.begin(), input.face.end(), [&](const auto &f) {
            return std::any_of(f.begin(), f.end(), [&](int v) { return v < 0 || v >= vertices; });
        });
    }

private:
    using Clock = std::chrono::steady_clock;
    const Params _params;
    const Progress _progress;
    int _runs = 0, _last = 0;
    std::vector<std::pair<std::string, double>> _seconds; // of all runs
    bool _wantsProvenance = false;

    struct Result {
        MeshTables mesh;
        Provenance provenance;
    };

    Report Search(const MeshTables &input, Result &output)
    {
        const bool one =
            (_params.vertexCount != 0) + _params.edgeLength.has_value() + _params.maxError.has_value() == 1;
        const TargetKind target = TargetOf(_params);
        // The remesher refuses what is not one target.
        Report report = NamesMissingVertices(input)
                            ? Fail(Report(), Status::InvalidInput, "a face names a vertex that does not exist")
                        : !one || target == TargetKind::Vertices ? One(input, _params, 100, output)
                        : target == TargetKind::EdgeLength       ? ForEdgeLength(input, output)
                                                                 : ForMaxError(input, output);
        report.target = target;
        report.runs = _runs;
        report.seconds = _seconds;
        switch (target) {
        case TargetKind::Vertices:
            report.asked = _params.vertexCount;
            report.reached = report.resultTopology.vertices;
            break;
        case TargetKind::EdgeLength:
            report.asked = *_params.edgeLength;
            report.reached = report.meanEdgeLength;
            break;
        case TargetKind::MaxError:
            report.asked = _params.maxError.value_or(0);
            break;
        }
        if (report.status == Status::Done && _progress && _last < 100)
            _progress(100, "done"); // nothing is left to cancel
        return report;
    }

    // One remeshing, which takes the progress from where it stands to `to`.
    Report One(const MeshTables &input, const Params &params, int to, Result &output)
    {
        ++_runs;
        const int from = _last;
        bool stop = false;
        Report report = Remesher(params, [&](int at, const char *phase) {
                            stop = !Advance(from + (to - from) * at / 100, at == 100 && to < 100 ? "measuring" : phase);
                            return !stop;
                        }).Run(input, output.mesh, _wantsProvenance ? &output.provenance : nullptr);
        for (const auto &s : report.seconds)
            AddSeconds(s.first, s.second);
        // The remesher is done at its last step, the search is not.
        if (stop && to < 100 && report.status == Status::Done)
            return Fail(std::move(report), Status::Cancelled, "cancelled while measuring");
        return report;
    }

    bool Advance(int at, const char *phase)
    {
        _last = std::max(_last, at);
        return !_progress || _progress(_last, phase);
    }

    void AddSeconds(const std::string &phase, double seconds)
    {
        for (auto &s : _seconds)
            if (s.first == phase) {
                s.second += seconds;
                return;
            }
        _seconds.emplace_back(phase, seconds);
    }

    static Report Fail(Report report, Status status, const std::string &why)
    {
        report.status = status;
        report.message = why;
        return report;
    }

    static std::string Text(double x)
    {
        std::array<char, 32> s = {};
        std::snprintf(s.data(), s.size(), "%.3g", x);
        return s.data();
    }

    // The closed formula is right where the remesh has about the input's area. A rough surface loses area to
    // the chords, and edges that have to stay are as long as they are: then the count is put right by what was
    // measured.
    Report ForEdgeLength(const MeshTables &input, Result &output)
    {
        const double length = *_params.edgeLength;
        Result first;
        Report report = One(input, _params, 90, first);
        if (report.status != Status::Done)
            return report;
        const auto off = [&](const Report &r) { return std::abs(r.meanEdgeLength / length - 1); };
        int wanted = report.requestedVertices;
        for (int round = 0; round < MostCorrections && off(report) > EdgeTolerance; ++round) {
            Params params = _params;
            params.edgeLength.reset();
            const double share = report.meanEdgeLength / length;
            params.vertexCount = std::max(4, static_cast<int>(std::lround(wanted * share * share)));
            if (params.vertexCount == wanted || report.extraVertices > 0)
                break;
            Result again;
            Report next = One(input, params, 90 + 9 * (round + 1) / MostCorrections, again);
            if (next.status == Status::Cancelled)
                return next;
            if (next.status != Status::Done || off(next) >= off(report))
                break;
            report = std::move(next);
            first = std::move(again);
            wanted = params.vertexCount;
        }
        if (off(report) > EdgeTolerance)
            report.warnings.push_back(
                "the edge length asked for was not reached: the mean is " + Text(report.meanEdgeLength) +
                " instead of " + Text(length) +
                (report.requestedVertices <= 4 || report.extraVertices > 0 ? ", as fewer vertices cannot be had" : ""));
        output = std::move(first);
        return report;
    }

    // A run of the search for a largest error.
    struct Trial {
        int vertices;
        double error; // infinite: the run failed its check
        bool full;    // with all iterations
        bool extra;   // came out with more vertices than asked for: fewer cannot be had
    };

    // Runs with few iterations until the error comes near, then full ones, of which that with the fewest
    // vertices is handed out.
    Report ForMaxError(const MeshTables &input, Result &output)
    {
        const double bound = *_params.maxError;
        if (!(bound > 0 && bound <= 1))
            return Fail(Report(), Status::InvalidParameter, "the largest error must lie above 0 and be at most 1");
        const auto inputs = static_cast<double>(input.position.size());
        const int most = static_cast<int>(std::clamp(5 * inputs, LeastCap, MostCap));
        Workers workers(_params.threads);
        std::optional<ErrorMeter> meter;
        std::vector<Trial> trials;
        std::optional<Report> best;
        Result bestResult;
        Report last;
        int n = static_cast<int>(std::clamp(1 / bound, 30.0, std::clamp(2 * inputs, 100.0, MostFirst)));
        bool full = GlobalIterations(_params) <= TrialIterations;
        while (_runs < MostRuns) {
            Params params = _params;
            params.maxError.reset();
            params.vertexCount = n;
            if (!full)
                params.globalIterations = TrialIterations;
            Result result;
            last = One(input, params, _last + (99 - _last) * 3 / 10, result);
            Trial trial = {n, std::numeric_limits<double>::infinity(), full, last.extraVertices > 0};
            if (last.status == Status::Done) {
                const Clock::time_point start = Clock::now();
                if (!meter)
                    meter.emplace(input);
                trial.error = meter->Measure(result.mesh, workers);
                AddSeconds("measuring the distance", std::chrono::duration<double>(Clock::now() - start).count());
            } else if (last.status != Status::CheckFailed) {
                return last;
            }
            trials.push_back(trial);
            if (full && Passes(trial, bound) && (!best || n < best->requestedVertices)) {
                last.reached = trial.error;
                best = last;
                bestResult = std::move(result);
            }
            const int next = NextCount(trials, bound, most);
            if (next == 0)
                break;
            // The last two runs are kept for what can be handed out.
            full = full || _runs >= MostRuns - 2 ||
                   (trial.error < NearAbove * bound && trial.error > NearBelow * bound) || next == n;
            n = next;
        }
        if (!best)
            return NotReached(std::move(last), trials, bound);
        if (bound > Suspicious)
            best->warnings.push_back(
                "the largest error is a share of the bounding box's diagonal: what was asked for is "
                "more than a tenth of it");
        output = std::move(bestResult);
        return std::move(*best);
    }

    static Report NotReached(Report report, const std::vector<Trial> &trials, double bound)
    {
        const Trial &closest = *std::min_element(trials.begin(), trials.end(),
                                                 [](const Trial &a, const Trial &b) { return a.error < b.error; });
        const Trial &largest = *std::max_element(
            trials.begin(), trials.end(), [](const Trial &a, const Trial &b) { return a.vertices < b.vertices; });
        report.reached = closest.error;
        if (!std::isfinite(closest.error))
            return report;
        return Fail(std::move(report), Status::NotReached,
                    "the error " + Text(bound) + " was not reached in " + std::to_string(trials.size()) +
                        (trials.size() == 1 ? " run" : " runs") + " of up to " + std::to_string(largest.vertices) +
                        " vertices: " + std::to_string(closest.vertices) + " came within " + Text(closest.error));
    }

    // The largest distance is known to 1 percent.
    static bool Passes(const Trial &t, double bound) { return 1.01 * t.error <= bound; }

    // The count to try next; 0: what there is will do, or no more can be done.
    static int NextCount(const std::vector<Trial> &trials, double bound, int most)
    {
        const Trial &last = trials.back();
        // Full runs that bracket the count; the error is not quite monotone, so from the passing one down.
        const Trial *high = nullptr, *low = nullptr;
        int failed = 0, largest = 0;
        for (const Trial &t : trials)
            if (t.full && Passes(t, bound) && (high == nullptr || t.vertices < high->vertices))
                high = &t;
        for (const Trial &t : trials)
            if (t.full && !Passes(t, bound)) {
                ++failed;
                largest = std::max(largest, t.vertices);
                if ((high == nullptr || t.vertices < high->vertices) && (low == nullptr || t.vertices > low->vertices))
                    low = &t;
            }
        if (high != nullptr) {
            const double n = Predicted(trials, 0.97 * bound);
            if (high->extra || high->vertices <= 4 || n > high->vertices / CloseEnough ||
                (low != nullptr && high->vertices <= CloseEnough * low->vertices))
                return 0;
            if (low == nullptr)
                return std::max(4, static_cast<int>(std::max(n, high->vertices / MostStep)));
            const double ratio = static_cast<double>(high->vertices) / low->vertices;
            return static_cast<int>(
                std::clamp(n, low->vertices * std::pow(ratio, 0.25), low->vertices * std::pow(ratio, 0.75)));
        }
        const bool passes = Passes(last, bound);
        if (!passes && last.vertices >= most && (last.full || last.error > NearAbove * bound))
            return 0;
        if (passes && (last.vertices <= 4 || last.extra))
            return last.vertices; // once more, in full
        // Each full run that failed asks for more room.
        double n =
            std::isfinite(last.error) ? Predicted(trials, bound * std::pow(0.97, 1 + failed)) : 2.0 * last.vertices;
        n = std::clamp(n, last.vertices / MostStep, last.vertices * MostStep);
        if (failed > 0)
            n = std::clamp(n, (1 + 0.05 * failed) * largest, FullStep * largest);
        return static_cast<int>(std::clamp(n, 4.0, static_cast<double>(most)));
    }

    // The count at which a line through the logarithms of counts and errors meets `aim`. The error of one run is
    // off by a quarter either way, so all runs count, those near the aim more.
    static double Predicted(const std::vector<Trial> &trials, double aim)
    {
        double sum = 0, x = 0, y = 0, xx = 0, xy = 0;
        const auto weigh = [&](const auto &visit) {
            for (const Trial &t : trials)
                if (std::isfinite(t.error)) {
                    const double e = std::log(std::max(t.error, 1e-12) / aim);
                    visit(1 / (0.1 + e * e), std::log(static_cast<double>(t.vertices)), e);
                }
        };
        weigh([&](double w, double n, double e) {
            sum += w;
            x += w * n;
            y += w * e;
        });
        x /= sum;
        y /= sum;
        weigh([&](double w, double n, double e) {
            xx += w * (n - x) * (n - x);
            xy += w * (n - x) * (e - y);
        });
        // 1 on a smooth surface, 1/2 at creases.
        const double slope = xx > 0.05 * sum ? std::clamp(-xy / xx, 0.5, 1.2) : 0.8;
        return std::exp(x + y / slope);
    }

    static constexpr int MostRuns = 8, MostCorrections = 3;
    static constexpr int TrialIterations = 4;
    static constexpr double LeastCap = 100000, MostCap = 4000000, MostFirst = 20000;
    static constexpr double MostStep = 8, FullStep = 1.7;
    static constexpr double Suspicious = 0.1; // largest error, in diagonals: percents may have been meant
    static constexpr double CloseEnough = 1.1;
    // The error of a trial, in units of the bound, from which full runs set out.
    static constexpr double NearAbove = 1.6, NearBelow = 0.6;
};

} // namespace ccdm
} // namespace vcg

#endif
