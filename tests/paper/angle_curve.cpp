// SPDX-License-Identifier: GPL-3.0-or-later
// angle_curve INPUT RESULT VERTICES SEED local ITERATIONS
// angle_curve INPUT RESULT VERTICES SEED global LAMBDA NL NG
//
// The curves of the paper's figures 3(d), 4(c) and 4(d): the average smallest angle, in degrees, of the mesh after each
// iteration of the local or of the global optimisation; the first number is that of the mesh that they begin with.
// Random samples, curvature density, rho = phi^(1/5), boundaries only as features; none of the closing steps, which
// are not the paper's. Prints the curve and the processor seconds from the density to the last iteration as JSON;
// RESULT is the last mesh; -: it is not written.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <vcg/complex/algorithms/ccdm/initial_mesh.h>
#include <vcg/complex/algorithms/ccdm/optimizer.h>

#include "../bench/read_tables.h"

namespace {

using namespace vcg::ccdm;

constexpr double BoundariesOnly = 180; // degrees
constexpr double PaperExponent = 0.2;

Model MakeModel(const InputMesh &input, int vertices)
{
    Model model;
    ReferenceSurface &surface = model.surface;
    surface.position = input.mesh.position;
    surface.mesh = input.tables;
    MarkFeatures(surface, BoundariesOnly, {});
    model.density = MakeDensityField(surface, CurvatureDensity(surface), false, PaperExponent, vertices);
    model.features = FeatureTracer(surface, model.density.spacing, {}, CornerRules()).Trace();
    WidenForCurves(model.features, vertices, model.density.spacing);
    return model;
}

Remesh InitialRemesh(const Model &model, int vertices, unsigned seed)
{
    Random random(seed);
    SampleSet samples;
    const int corners = static_cast<int>(model.features.corner.size());
    samples.onCurves = SampleCurvesWithin(model.surface, model.features, model.density, vertices - corners);
    const int rest = vertices - corners - static_cast<int>(samples.onCurves.size());
    samples.onFaces = SampleFaces(model.surface, model.density, std::max(0, rest), random);
    Remesh remesh;
    InitialMeshBuilder(model, samples).Build(remesh, [](double) { return true; });
    remesh.mesh.KeepRings();
    return remesh;
}

// Algorithm 1, with a look at each state.
template <class Look>
void OptimizeLocally(const Model &model, Remesh &remesh, int iterations, Workers &workers, const Look &look)
{
    PatchSchedule schedule(remesh, workers);
    Relocator relocator(model, remesh);
    DelaunayFlipper flipper(workers);
    if (iterations > 0)
        flipper.Run(remesh);
    for (int i = 0; i < iterations; ++i) {
        schedule.Changed();
        schedule.ForVertices([&](int v, int) { relocator.Relocate(v, PatchCentroid{remesh, false}); });
        flipper.Run(remesh);
        look();
    }
}

// In degrees, exact: the remesher's own SmallestAngle is an approximation.
double LeastAngle(const Point (&p)[3])
{
    double least = Pi;
    for (int k = 0; k < 3; ++k) {
        const Point u = p[(k + 1) % 3] - p[k], w = p[(k + 2) % 3] - p[k];
        least = std::min(least, std::atan2(Norm(u ^ w), u * w));
    }
    return least * 180 / Pi;
}

// The average smallest angles so far. The time that it takes to find them is not counted.
class Curve
{
public:
    void Add(const Remesh &remesh)
    {
        const std::clock_t start = std::clock();
        double sum = 0;
        for (const Triangle &T : remesh.mesh.triangle)
            sum += LeastAngle({remesh.position[T.v[0]], remesh.position[T.v[1]], remesh.position[T.v[2]]});
        _degrees.push_back(sum / remesh.mesh.TriangleCount());
        _start += std::clock() - start;
    }

    nlohmann::json Json() const
    {
        return {{"angles", _degrees}, {"seconds", static_cast<double>(std::clock() - _start) / CLOCKS_PER_SEC}};
    }

private:
    std::clock_t _start = std::clock();
    std::vector<double> _degrees;
};

void RunLocal(const Model &model, Remesh &remesh, int iterations, Workers &workers, Curve &curve)
{
    curve.Add(remesh);
    OptimizeLocally(model, remesh, iterations, workers, [&] { curve.Add(remesh); });
}

void RunGlobal(const Model &model, Remesh &remesh, const Params &params, Workers &workers, Curve &curve)
{
    // The state in which the optimiser begins its first round is not shown to the progress.
    Remesh begin = remesh;
    OptimizeLocally(model, begin, params.localIterations, workers, [] {});
    curve.Add(begin);
    Report report;
    Optimizer(model, params, remesh, report, workers).Run(0, [&](double) {
        curve.Add(remesh);
        return true;
    });
}

void Write(const std::string &path, const Remesh &remesh, const InputMesh &input)
{
    ccdm_remesh::Mesh mesh;
    auto v = vcg::tri::Allocator<ccdm_remesh::Mesh>::AddVertices(mesh, remesh.position.size());
    for (const Point &p : remesh.position)
        (v++)->P() = input.Restore(p);
    auto f = vcg::tri::Allocator<ccdm_remesh::Mesh>::AddFaces(mesh, remesh.mesh.triangle.size());
    for (const Triangle &T : remesh.mesh.triangle) {
        for (int k = 0; k < 3; ++k)
            f->V(k) = &mesh.vert[T.v[k]];
        ++f;
    }
    const std::string fault = ccdm_remesh::WriteMesh(path, mesh);
    if (!fault.empty())
        throw std::runtime_error(path + ": " + fault);
}

void Run(const std::vector<std::string> &argument)
{
    const InputMesh input(ReadTables(argument[0], false));
    if (!input.refusal.empty())
        throw std::runtime_error(argument[0] + ": " + input.refusal);
    const int vertices = std::stoi(argument[2]);
    Params params;
    params.seed = static_cast<unsigned>(std::stoul(argument[3]));
    params.optimizer = OptimizerKind::Annealing;
    Workers workers(1);
    Curve curve;
    const Model model = MakeModel(input, vertices);
    Remesh remesh = InitialRemesh(model, vertices, params.seed);
    if (argument[4] == "local") {
        RunLocal(model, remesh, std::stoi(argument[5]), workers, curve);
    } else {
        params.lambda = std::stod(argument[5]);
        params.localIterations = std::stoi(argument[6]);
        params.globalIterations = std::stoi(argument[7]);
        RunGlobal(model, remesh, params, workers, curve);
    }
    std::cout << curve.Json().dump() << '\n';
    if (argument[1] != "-")
        Write(argument[1], remesh, input);
}

} // namespace

int main(int argc, char **argv)
{
    const std::vector<std::string> argument(argv + 1, argv + argc);
    const std::string kind = argument.size() > 4 ? argument[4] : "";
    if (!(kind == "local" && argument.size() == 6) && !(kind == "global" && argument.size() == 8)) {
        std::cerr << "usage: angle_curve INPUT RESULT VERTICES SEED local ITERATIONS | ... global LAMBDA NL NG\n";
        return 2;
    }
    try {
        Run(argument);
    } catch (const std::exception &e) {
        std::cerr << e.what() << '\n';
        return 1;
    }
    return 0;
}
