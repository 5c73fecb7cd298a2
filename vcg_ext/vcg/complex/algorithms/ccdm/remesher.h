// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_REMESHER_H
#define VCG_CCDM_REMESHER_H

#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/certificate.h>
#include <vcg/complex/algorithms/ccdm/coarse_level.h>
#include <vcg/complex/algorithms/ccdm/edge_length.h>
#include <vcg/complex/algorithms/ccdm/false_creases.h>
#include <vcg/complex/algorithms/ccdm/front_sampler.h>
#include <vcg/complex/algorithms/ccdm/initial_mesh.h>
#include <vcg/complex/algorithms/ccdm/input_repair.h>
#include <vcg/complex/algorithms/ccdm/optimizer.h>
#include <vcg/complex/algorithms/ccdm/provenance.h>
#include <vcg/complex/algorithms/ccdm/result_check.h>
#include <vcg/complex/algorithms/ccdm/surface_offset.h>
#include <vcg/complex/algorithms/ccdm/thin_parts.h>

namespace vcg {
namespace ccdm {

/// From mesh tables to mesh tables: the stages of the remesher in order. Takes a vertex count or an edge
/// length; TargetSearch (target_search.h) takes every target.
class Remesher
{
public:
    /// Gets a position in 0..100 and the name of the phase; false cancels.
    using Progress = std::function<bool(int, const char *)>;

    Remesher(const Params &params, Progress progress)
        : _params(params), _progress(std::move(progress)), _workers(params.threads)
    {
    }

    /// `output` and, if there is one, `provenance` are filled only when the report's status is Done.
    Report Run(const MeshTables &input, MeshTables &output, Provenance *provenance = nullptr)
    {
        Stages(input, output, provenance);
        return std::move(_report);
    }

private:
    using Clock = std::chrono::steady_clock;
    Params _params; // an edge length is turned into a vertex count
    const Progress _progress;
    Workers _workers;
    Report _report;
    Clock::time_point _phaseStart;
    const char *_phase = "";
    int _from = 0, _to = 0, _last = -1;

    bool Stages(const MeshTables &input, MeshTables &output, Provenance *provenance)
    {
        if (!CheckParams())
            return false;

        if (!Begin("checking the input", 0, 3))
            return false;
        SoundInput sound(input, _params.repair, _workers);
        InputMesh &prepared = sound.Prepared();
        _report.defects = prepared.defects;
        _report.inputTopology = prepared.topology;
        if (!prepared.refusal.empty())
            return Fail(Status::InvalidInput, prepared.refusal + sound.Hint());
        WarnOfDefects();

        if (!Begin("finding features", 3, 6))
            return false;
        Model model;
        model.surface.position = std::move(prepared.mesh.position);
        model.surface.mesh = std::move(prepared.tables);
        if (!FindFeatures(model, prepared))
            return false;

        ThinParts thin(model, _workers);
        WarnOfNarrowPlaces(thin, prepared);

        Remesh remesh;
        if (!AttemptAll(model, remesh))
            return false;
        Certify(model, remesh, thin, prepared);
        const ProvenanceFinder finder(model, remesh, prepared, sound.Tables());
        WriteBack(prepared, remesh, finder, sound.Tables(), output);
        if (provenance != nullptr) {
            *provenance = finder.Run(_workers);
            for (int &v : provenance->sameVertex)
                v = v < 0 ? v : sound.CallersVertex(v);
        }
        _report.meanEdgeLength = MeanEdgeLength(remesh) * prepared.Scale();
        Finish();
        return true;
    }

    // From the attempt that makes the best mesh to the one that stands most. At a handful of vertices on a
    // curved surface the momentum can fold what annealing does not, and no placement at all may be free of
    // folds (eight vertices on a round torus): then a few more are taken.
    bool AttemptAll(Model &model, Remesh &remesh)
    {
        Params params = _params;
        TakeEnoughForComponents(model, params);
        const CoarseLevel level(model, _workers);
        bool coarse = params.optimizer == OptimizerKind::Accelerated && level.Serves(params.vertexCount);
        for (int growths = 0;;) {
            bool passed = Attempt(model, params, coarse, remesh);
            // What is too many at the coarse level is four times that once it is quartered, and may be there to stay.
            if (passed && coarse && remesh.VertexCount() > params.vertexCount)
                passed = Fail(Status::CheckFailed, "the coarse level has too many vertices");
            if (passed && coarse && level.MayLackParts(remesh, MinAngle(params)) &&
                !SecondAttempt(model, params, level, remesh))
                return false;
            if (passed) {
                Offset(model, remesh);
                CountExtra(model, remesh, params.vertexCount);
                WarnOfTheResult();
                return true;
            }
            if (_report.status != Status::CheckFailed)
                return false;
            const int got = remesh.VertexCount();
            remesh = Remesh();
            if (coarse) {
                coarse = false;
            } else if (params.optimizer != OptimizerKind::Annealing) {
                _report.warnings.push_back("annealed with random samples, as another attempt failed: " +
                                           _report.message);
                params.optimizer = OptimizerKind::Annealing;
                params.sampler = SamplerKind::Random;
            } else if (got < MostForGrowth * _report.inputTopology.components && growths++ < MostGrowths) {
                TakeMore(got + got / 2, model, params);
                _report.warnings.push_back("more vertices were taken, as an attempt with " + std::to_string(got) +
                                           " failed: " + _report.message);
            } else {
                return false;
            }
            _report.message.clear();
        }
    }

    static void TakeMore(int vertices, Model &model, Params &params)
    {
        const double before = params.vertexCount;
        params.vertexCount = vertices;
        for (double &h : model.density.spacing)
            h *= std::sqrt(before / vertices);
    }

    // A closed component takes four vertices, an open one three.
    void TakeEnoughForComponents(Model &model, Params &params)
    {
        const TopologyCounts &t = _report.inputTopology;
        const int least = (t.boundaryLoops > 0 ? 3 : 4) * t.components;
        if (params.vertexCount >= least)
            return;
        TakeMore(least, model, params);
        _report.warnings.push_back("more vertices were taken, as " + Counted(t.components, "component", "components") +
                                   " cannot do with fewer than " + std::to_string(least));
    }

    // Without the coarse level, which can lose thin parts. False when it was cancelled.
    bool SecondAttempt(Model &model, const Params &params, const CoarseLevel &level, Remesh &remesh)
    {
        Report report = _report;
        Remesh other;
        const bool passed = Attempt(model, params, false, other);
        if (passed && level.IsSurpassed(remesh, other)) {
            remesh = std::move(other);
            return true;
        }
        const Status status = _report.status;
        std::swap(report, _report);
        _report.seconds = report.seconds;
        if (passed || status == Status::CheckFailed)
            return true;
        return Fail(status, report.message);
    }

    // Samples, builds, optimises and checks; `coarse`: a coarse level first. False when it was cancelled or the check
    // failed.
    bool Attempt(Model &model, const Params &params, bool coarse, Remesh &remesh)
    {
        if (!Begin("sampling", 6, 8))
            return false;
        const SampleSet samples = Sample(model, params, coarse);

        if (!Begin("building the initial mesh", 8, 20))
            return false;
        if (!InitialMeshBuilder(model, samples).Build(remesh, _workers, [this](double x) { return Advance(x); }))
            return false;

        if (!Begin("optimising", 20, 92))
            return false;
        _report.flipsBounded = false;
        Optimizer optimizer(model, params, remesh, _report, _workers);
        if (!optimizer.Run(coarse ? params.vertexCount : 0, [this](double x) { return Advance(x); }))
            return false;

        if (!Begin("polishing", 92, 97))
            return false;
        if (!optimizer.Close([this](double x) { return Advance(x); }))
            return false;

        return Begin("checking the result", 97, 100) && Check(model, remesh);
    }

    bool Fail(Status status, const std::string &why)
    {
        _report.status = status;
        _report.message = why;
        return false;
    }

    bool CheckParams()
    {
        auto bad = [&](const std::string &why) { return Fail(Status::InvalidParameter, why); };
        const Params &p = _params;
        if ((p.vertexCount != 0) + p.edgeLength.has_value() + p.maxError.has_value() != 1)
            return bad("exactly one of the vertex count, the edge length and the largest error must be given");
        if (p.maxError)
            return bad("the largest error takes a search over several runs");
        if (p.edgeLength && !(*p.edgeLength > 0 && std::isfinite(*p.edgeLength)))
            return bad("the edge length must be above 0");
        if (!p.edgeLength && p.vertexCount < 4)
            return bad("the vertex count must be at least 4, not " + std::to_string(p.vertexCount));
        if (p.vertexCount > MostVertices)
            return bad("the vertex count must be at most 100000000, not " + std::to_string(p.vertexCount));
        if (!(p.featureAngle > 0 && p.featureAngle <= 180))
            return bad("the feature angle must lie above 0 and be at most 180 degrees");
        if (!(p.lambda >= 0 && p.lambda <= 1))
            return bad("lambda must lie between 0 and 1");
        if (GlobalIterations(p) < 0 || GlobalIterations(p) > 1000000)
            return bad("the number of global iterations must lie between 0 and 1000000");
        if (p.localIterations < 1 || p.localIterations > 1000000)
            return bad("the number of local iterations must lie between 1 and 1000000");
        const double exponent = DensityExponent(p);
        if (!(exponent >= 0 && exponent <= 3))
            return bad("the density exponent must lie between 0 and 3");
        if (!(MinAngle(p) >= 0 && MinAngle(p) <= 45))
            return bad("the smallest angle aimed at must lie between 0 and 45 degrees");
        if (!(p.approximation >= 0 && p.approximation <= 1))
            return bad("the weight of the approximation must lie between 0 and 1");
        if (p.threads < 0)
            return bad("the number of threads must be at least 0");
        _report.requestedVertices = p.vertexCount;
        return true;
    }

    // The vertex count for the wanted edge length. What limits the gradation depends on it in turn.
    bool CountForEdgeLength(const ReferenceSurface &surface, const std::vector<double> &phi, bool limited,
                            double length)
    {
        std::vector<double> graded = phi;
        for (int round = 0; round < (limited ? 3 : 1); ++round) {
            const double n = VerticesForEdgeLength(surface, graded, _report.inputTopology.euler, length);
            if (!(n <= MostVertices))
                return Fail(Status::InvalidParameter, "the edge length takes more than 100000000 vertices");
            _params.vertexCount = std::max(4, static_cast<int>(std::lround(n)));
            if (limited) {
                graded = phi;
                LimitGradation(surface, _params.vertexCount, MostGradation, graded);
            }
        }
        _report.requestedVertices = _params.vertexCount;
        return true;
    }

    void WarnOfDefects()
    {
        const InputDefects &d = _report.defects;
        auto warn = [&](int n, const char *one, const char *many) {
            if (n > 0)
                _report.warnings.push_back(Counted(n, one, many));
        };
        warn(d.unreferencedVertices, "vertex that no face uses was dropped", "vertices that no face uses were dropped");
        warn(d.repeatedIndexFaces, "face that names a vertex twice was dropped",
             "faces that name a vertex twice were dropped");
        warn(d.zeroAreaFaces, "input face has no area", "input faces have no area");
        warn(d.duplicateFaces, "face that repeats another was dropped", "faces that repeat others were dropped");
        warn(d.mergedVertices, "vertex was merged into another at its position, as that makes the surface one",
             "vertices were merged into others at their positions, as that makes the surface one");
        if (_report.inputTopology.orientable)
            warn(d.turnedFaces, "face was turned over to agree with its neighbours",
                 "faces were turned over to agree with their neighbours");
        if (d.copiedVertices > 0) {
            const std::string edges = d.nonManifoldEdges > 0 ? " at " + Counted(d.nonManifoldEdges, "edge", "edges") +
                                                                   " of more than two faces"
                                                             : "";
            _report.warnings.push_back("the surface was cut apart" + edges + ": " +
                                       Counted(d.nonManifoldVertices, "vertex", "vertices") + " got " +
                                       Counted(d.copiedVertices, "copy", "copies"));
        }
    }

    void WarnOfNarrowPlaces(ThinParts &thin, const InputMesh &prepared)
    {
        _report.narrow = thin.Find(_workers);
        for (NarrowPlace &p : _report.narrow) {
            const Point at = prepared.Restore(Point(p.position[0], p.position[1], p.position[2]));
            p.position = {at[0], at[1], at[2]};
            const double factor = ThinParts::NarrowShare * p.spacing / std::max(p.width, 1e-12);
            p.vertices = std::ceil(_params.vertexCount * factor * factor);
            p.width *= prepared.Scale();
            p.spacing *= prepared.Scale();
        }
        for (const NarrowKind kind : {NarrowKind::ThinPart, NarrowKind::CloseFeatures}) {
            const std::string warning = NarrowWarning(_report.narrow, kind);
            if (!warning.empty())
                _report.warnings.push_back(warning);
        }
    }

    bool FindFeatures(Model &model, const InputMesh &prepared)
    {
        const MeshTables &input = prepared.mesh;
        ReferenceSurface &surface = model.surface;
        const SideMarks marked = _params.useMarkedEdges ? input.marked : SideMarks();
        MarkFeatures(surface, _params.featureAngle, marked);
        std::vector<double> phi;
        switch (_params.density) {
        case DensityKind::Uniform:
            phi.assign(surface.position.size(), 1.0);
            break;
        case DensityKind::Curvature:
            phi = CurvatureDensity(surface);
            break;
        case DensityKind::Quality:
            if (input.field.empty())
                return Fail(Status::InvalidInput, "the mesh has no per-vertex density");
            phi = input.field;
            const double largest = *std::max_element(phi.begin(), phi.end());
            if (!(largest > 0))
                return Fail(Status::InvalidInput, "the density is zero everywhere");
            for (double &x : phi)
                x = std::max(x / largest, 1e-6);
            break;
        }
        const bool limited =
            _params.density == DensityKind::Curvature && _params.optimizer == OptimizerKind::Accelerated;
        if (_params.edgeLength && !CountForEdgeLength(surface, phi, limited, *_params.edgeLength / prepared.Scale()))
            return false;
        if (limited)
            LimitGradation(surface, _params.vertexCount, MostGradation, phi);
        model.density = MakeDensityField(surface, std::move(phi), _params.density == DensityKind::Uniform,
                                         DensityExponent(_params), _params.vertexCount);
        FalseCreases falseCreases(surface, model.density.spacing, marked, _params.featureAngle);
        const int dropped = falseCreases.Drop();
        CornerRules rules;
        rules.turnsOfBoundaries = _params.boundary != BoundaryKind::Smooth;
        rules.allOfBoundaries = _params.boundary == BoundaryKind::Fixed;
        rules.locked = input.locked;
        model.features = FeatureTracer(surface, model.density.spacing, marked, rules).Trace();
        WidenForCurves(model.features, _params.vertexCount, model.density.spacing);
        _report.featureCurves = static_cast<int>(model.features.curve.size());
        _report.featureCorners = static_cast<int>(model.features.corner.size());
        _report.prunedFragments = dropped + model.features.pruned;
        const std::string warning =
            DroppedCreasesWarning(falseCreases.DroppedEdges() + model.features.prunedEdges, _params.featureAngle);
        if (!warning.empty())
            _report.warnings.push_back(warning);
        return true;
    }

    // The samples of the mesh that is built: the coarse level or the result's own.
    SampleSet Sample(Model &model, const Params &params, bool coarse)
    {
        const double scale = coarse ? 2 : 1;
        for (double &h : model.density.spacing)
            h *= scale;
        SampleSet samples;
        Random random(_params.seed);
        const int corners = static_cast<int>(model.features.corner.size());
        samples.onCurves =
            SampleCurvesWithin(model.surface, model.features, model.density, params.vertexCount - corners, coarse);
        const int featureSamples = static_cast<int>(samples.onCurves.size()) + corners;
        const int count = coarse ? CoarseLevel(model, _workers)
                                       .Vertices(params.vertexCount, _report.inputTopology.euler, samples.onCurves)
                                 : params.vertexCount;
        const int rest = std::max(0, count - featureSamples);
        switch (params.sampler) {
        case SamplerKind::Random:
            samples.onFaces = SampleFaces(model.surface, model.density, rest, random);
            break;
        case SamplerKind::Front:
            samples.onFaces = FrontSampler(model.surface, model.features, model.density,
                                           _report.inputTopology.orientable, _report.inputTopology.components == 1)
                                  .Run(samples.onCurves, rest, random, _workers);
            break;
        }
        for (double &h : model.density.spacing)
            h /= scale;
        return samples;
    }

    // The vertices leave the surface if the parameters want that and nothing breaks.
    void Offset(const Model &model, Remesh &remesh)
    {
        if (!(_params.approximation > 0.5))
            return;
        const std::vector<Point> onSurface = remesh.position;
        SurfaceOffset(model, remesh, _workers).Run(2 * _params.approximation - 1);
        if (Check(model, remesh))
            return;
        _report.warnings.push_back("the vertices stay on the surface: off it " + _report.message);
        _report.message.clear();
        remesh.position = onSurface;
        Check(model, remesh);
    }

    void CountExtra(const Model &model, const Remesh &remesh, int aimedAt)
    {
        _report.extraVertices = std::max(0, remesh.VertexCount() - _params.vertexCount);
        if (remesh.VertexCount() <= aimedAt)
            return;
        int onFeatures = 0;
        for (const Place &p : remesh.place)
            onFeatures += p.kind != VertexKind::Free;
        _report.warnings.push_back(std::to_string(remesh.VertexCount()) + " vertices instead of " +
                                   std::to_string(_params.vertexCount) + ": the topology and the " +
                                   std::to_string(model.features.curve.size()) + " feature curves (with " +
                                   std::to_string(onFeatures) + " vertices) need them");
    }

    // Once the mesh to hand out is chosen: an attempt that was thrown away says nothing about it.
    void WarnOfTheResult()
    {
        if (_report.flipsBounded)
            _report.warnings.push_back(
                "the flips were ended at 12 for each edge: the mesh may not be Delaunay everywhere");
        if (_report.foldedEdges > 0)
            _report.warnings.push_back(
                std::to_string(_report.foldedEdges) +
                (_report.foldedEdges == 1 ? " edge of the result is" : " edges of the result are") +
                " sharper than 150 degrees, as the input is there at this number of vertices");
    }

    bool Check(const Model &model, const Remesh &remesh)
    {
        const ResultCheck check(model, remesh, _workers);
        _report.resultTopology = check.topology;
        _report.foldedEdges = check.foldedEdges;
        _report.topologyPreserved = check.topology.SameTypeAs(_report.inputTopology);
        if (!check.fault.empty())
            return Fail(Status::CheckFailed, "the result was thrown away: " + check.fault);
        if (!_report.topologyPreserved)
            return Fail(Status::CheckFailed, "the result was thrown away: its topology is not the input's");
        if (remesh.VertexCount() < _params.vertexCount)
            return Fail(Status::CheckFailed, "the result was thrown away: it has only " +
                                                 std::to_string(remesh.VertexCount()) + " vertices");
        return true;
    }

    void Certify(const Model &model, const Remesh &remesh, ThinParts &thin, const InputMesh &prepared)
    {
        _report.angles =
            Certifier(model, remesh, thin, MinAngle(_params), _report.inputTopology.orientable).Run(_workers);
        for (SmallAngle &a : _report.angles.below) {
            const Point p = prepared.Restore(Point(a.position[0], a.position[1], a.position[2]));
            a.position = {p[0], p[1], p[2]};
        }
    }

    // What stays where it was gets its coordinates back to the last bit.
    static void WriteBack(const InputMesh &prepared, const Remesh &remesh, const ProvenanceFinder &finder,
                          const MeshTables &input, MeshTables &output)
    {
        MeshTables result;
        result.position.reserve(remesh.position.size());
        for (int v = 0; v < remesh.VertexCount(); ++v) {
            const int same = finder.SameVertex(v);
            result.position.push_back(same < 0 ? prepared.Restore(remesh.position[v]) : input.position[same]);
        }
        result.face.reserve(remesh.mesh.triangle.size());
        for (const Triangle &T : remesh.mesh.triangle)
            result.face.push_back({T.v[0], T.v[1], T.v[2]});
        output = std::move(result);
    }

    bool Begin(const char *phase, int from, int to)
    {
        EndPhase();
        _phase = phase;
        _from = from;
        _to = to;
        _phaseStart = Clock::now();
        return Advance(0);
    }

    void EndPhase()
    {
        if (*_phase == 0)
            return;
        const double seconds = std::chrono::duration<double>(Clock::now() - _phaseStart).count();
        // A phase that another attempt has run counts once.
        for (auto &entry : _report.seconds)
            if (entry.first == _phase) {
                entry.second += seconds;
                return;
            }
        _report.seconds.emplace_back(_phase, seconds);
    }

    bool Advance(double share)
    {
        const int at = std::max(_last, static_cast<int>(_from + (_to - _from) * std::clamp(share, 0.0, 1.0)));
        _last = at;
        return !_progress || _progress(at, _phase) || Fail(Status::Cancelled, std::string("cancelled while ") + _phase);
    }

    void Finish()
    {
        EndPhase();
        _report.status = Status::Done;
        if (_progress)
            _progress(100, "done"); // nothing is left to cancel
    }

    /// Counts below this for each component may be raised where fewer vertices cannot but fold.
    static constexpr int MostForGrowth = 200;
    static constexpr int MostGrowths = 8;
    // Growth of the spacing per way, for curvature: measured, less makes better triangles, more follows the
    // curvature more closely.
    static constexpr double MostGradation = 0.1;
    static constexpr int MostVertices = 100000000;
};

} // namespace ccdm
} // namespace vcg

#endif
