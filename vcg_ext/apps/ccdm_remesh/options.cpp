// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include <iostream>
#include <map>

#include <CLI/CLI.hpp>

#include "mesh_io.h"

namespace ccdm_remesh {
namespace {

using vcg::ccdm::DensityKind;
using vcg::ccdm::OptimizerKind;
using vcg::ccdm::RelocationKind;
using vcg::ccdm::SamplerKind;
using vcg::ccdm::TargetKind;

const std::map<std::string, DensityKind> densities = {
    {"uniform", DensityKind::Uniform}, {"curvature", DensityKind::Curvature}, {"quality", DensityKind::Quality}};
const std::map<std::string, OptimizerKind> optimizers = {{"accelerated", OptimizerKind::Accelerated},
                                                         {"annealing", OptimizerKind::Annealing}};
const std::map<std::string, RelocationKind> relocations = {{"cpt", RelocationKind::PatchCentroid},
                                                           {"cvt", RelocationKind::CellCentroid},
                                                           {"odt", RelocationKind::Circumcentres}};
const std::map<std::string, TargetKind> targets = {
    {"vertices", TargetKind::Vertices}, {"edge_length", TargetKind::EdgeLength}, {"max_error", TargetKind::MaxError}};
const std::map<std::string, SamplerKind> samplers = {{"front", SamplerKind::Front}, {"random", SamplerKind::Random}};

template <class Kind>
const char *Lookup(const std::map<std::string, Kind> &names, Kind kind)
{
    for (const auto &n : names)
        if (n.second == kind)
            return n.first.c_str();
    return "";
}

void AddTarget(CLI::App &app, vcg::ccdm::Params &p)
{
    CLI::Option_group *target = app.add_option_group("Target", "exactly one is required");
    target->add_option("-n,--vertices", p.vertexCount, "number of vertices of the result, 4 to 100000000")
        ->check(CLI::Range(4, 100000000));
    target->add_option("--edge-length", p.edgeLength, "mean edge length of the result, in the mesh's units, above 0")
        ->check(CLI::Range(1e-300, 1e300));
    target
        ->add_option("--max-error", p.maxError,
                     "largest distance between input and result, relative to the input's bounding-box diagonal, above "
                     "0 up to 1; the fewest vertices that reach it are looked for in up to 8 runs")
        ->check(CLI::Range(1e-12, 1.0));
    target->require_option(1);
}

void AddParameters(CLI::App &app, vcg::ccdm::Params &p)
{
    app.add_option("--feature-angle", p.featureAngle,
                   "edges whose faces turn by more than this are kept as features, degrees, above 0 up to 180; "
                   "180: boundaries only")
        ->capture_default_str()
        ->check(CLI::Range(1e-6, 180.0));
    app.add_option("--lambda", p.lambda, "size of the perturbation, relative to the edge length, 0 to 1")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--global-iterations", p.globalIterations,
                   "perturb-optimise rounds (NG), 0 to 1000000 (default: 24; with annealing 40)")
        ->check(CLI::Range(0, 1000000));
    app.add_option("--local-iterations", p.localIterations, "relocations in a round (NL), 1 to 1000000")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000000));
    app.add_option("--density", p.density, "what the vertex density follows: uniform (default), curvature, quality")
        ->transform(CLI::CheckedTransformer(densities, CLI::ignore_case));
    app.add_option("--density-exponent", p.densityExponent,
                   "gamma in rho = phi^gamma, the weight in the energy, 0 to 3 (default: 2, with cpt 1, with odt 1.6; "
                   "with annealing 0.2)")
        ->check(CLI::Range(0.0, 3.0));
    app.add_option("--optimizer", p.optimizer, "accelerated (default), or annealing: the paper's")
        ->transform(CLI::CheckedTransformer(optimizers, CLI::ignore_case));
    app.add_option("--sampler", p.sampler,
                   "front (default): laid out in hexagons; or random: drawn in proportion to the density")
        ->transform(CLI::CheckedTransformer(samplers, CLI::ignore_case));
    app.add_option("--relocation", p.relocation,
                   "where a vertex goes: cpt, the centroid of its star (default with annealing); cvt, that of its "
                   "Voronoi cell (default otherwise); odt, the mean of the circumcentres around it")
        ->transform(CLI::CheckedTransformer(relocations, CLI::ignore_case));
    app.add_option("--min-angle", p.minAngle,
                   "smallest angle that the closing polish aims at, degrees, 0 to 45 (default: 40; with annealing 34)")
        ->check(CLI::Range(0.0, 45.0));
    app.add_option("--approximation", p.approximation,
                   "how much closeness to the input counts against the angles, 0 to 1; above 0.5 the vertices leave "
                   "the surface by up to the offset that makes the squared distance least")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--seed", p.seed, "of the random generator, 0 to 4294967295")->capture_default_str();
    app.add_option("--threads", p.threads, "0 (default): as many as there are cores; the result is the same for any")
        ->check(CLI::Range(0, 256));
}

} // namespace

const char *NameOf(DensityKind k)
{
    return Lookup(densities, k);
}
const char *NameOf(OptimizerKind k)
{
    return Lookup(optimizers, k);
}
const char *NameOf(RelocationKind k)
{
    return Lookup(relocations, k);
}
const char *NameOf(SamplerKind k)
{
    return Lookup(samplers, k);
}
const char *NameOf(TargetKind k)
{
    return Lookup(targets, k);
}

int ParseArguments(int argc, char **argv, Options &options)
{
    CLI::App app("Isotropic surface remeshing by constrained centroidal Delaunay meshes: a mesh of well-shaped "
                 "triangles with the wanted number of vertices, the input's topology and its sharp features.",
                 "ccdm_remesh");
    app.footer("Formats: ply, off, obj, stl. Exit status: 0 done, 2 wrong usage, 3 input unreadable, 4 input refused, "
               "5 output not written, 6 result failed its check, 7 largest error not reached, 130 interrupted.");
    app.add_option("INPUT", options.input, "mesh to read")->required();
    app.add_option("OUTPUT", options.output, "mesh to write")->required();
    AddTarget(app, options.params);
    AddParameters(app, options.params);
    app.add_option("--report", options.report, "file for a JSON report of what was achieved");
    app.add_flag("--quiet", options.quiet, "print errors only");
    app.set_version_flag("--version", std::string("ccdm_remesh ") + CCDM_VERSION);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError &e) {
        return app.exit(e) == 0 ? 0 : 2;
    }
    if (!IsMeshExtension(ExtensionOf(options.output))) {
        std::cerr << "ccdm_remesh: " << options.output
                  << ": the output's format is not known (ply, off, obj and stl are)\n";
        return 2;
    }
    return -1;
}

} // namespace ccdm_remesh
