// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <sstream>
#include <type_traits>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "atomic_file.h"
#include "mesh_io.h"

namespace ccdm_remesh {
namespace {

using vcg::ccdm::BoundaryKind;
using vcg::ccdm::DensityKind;
using vcg::ccdm::OptimizerKind;
using vcg::ccdm::RelocationKind;
using vcg::ccdm::RepairKind;
using vcg::ccdm::SamplerKind;
using vcg::ccdm::TargetKind;

const std::map<std::string, BoundaryKind> boundaries = {
    {"sliding", BoundaryKind::Sliding}, {"fixed", BoundaryKind::Fixed}, {"smooth", BoundaryKind::Smooth}};
const std::map<std::string, DensityKind> densities = {
    {"uniform", DensityKind::Uniform}, {"curvature", DensityKind::Curvature}, {"quality", DensityKind::Quality}};
const std::map<std::string, OptimizerKind> optimizers = {{"accelerated", OptimizerKind::Accelerated},
                                                         {"annealing", OptimizerKind::Annealing}};
const std::map<std::string, RelocationKind> relocations = {{"cpt", RelocationKind::PatchCentroid},
                                                           {"cvt", RelocationKind::CellCentroid},
                                                           {"odt", RelocationKind::Circumcentres}};
const std::map<std::string, RepairKind> repairs = {{"harmless", RepairKind::Harmless}, {"split", RepairKind::Split}};
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

// The values of an option, in words as its help and its errors give them.
struct Range {
    double low, high;
    const char *text;
};

template <class Value>
CLI::Option *AddNumber(CLI::App &app, const char *names, Value &value, const Range &range, const std::string &help)
{
    constexpr bool whole = !std::is_same_v<Value, double> && !std::is_same_v<Value, std::optional<double>>;
    return app.add_option(names, value, help)
        ->type_name(whole ? "INTEGER" : "NUMBER")
        ->check([=](const std::string &text) -> std::string {
            std::conditional_t<whole, std::int64_t, double> x = 0;
            // So written that it is false for what is not a number.
            if (CLI::detail::lexical_cast(text, x) && static_cast<double>(x) >= range.low &&
                static_cast<double>(x) <= range.high)
                return "";
            return "'" + text + "' is not a " + (whole ? "whole number " : "number ") + range.text;
        });
}

template <class Kind, class Value>
CLI::Option *AddChoice(CLI::App &app, const char *name, Value &value, const std::map<std::string, Kind> &choices,
                       const std::string &help)
{
    std::string all, list;
    for (const auto &c : choices) {
        all += (all.empty() ? "" : "|") + c.first;
        list += (list.empty() ? "" : ", ") + c.first;
    }
    const auto set = [&](const std::string &text) { value = choices.at(CLI::detail::to_lower(text)); };
    return app.add_option_function<std::string>(name, set, help)
        ->type_name(all)
        ->check([&, list](const std::string &text) -> std::string {
            return choices.count(CLI::detail::to_lower(text)) != 0 ? "" : "'" + text + "' is none of " + list;
        });
}

void AddTarget(CLI::App &app, vcg::ccdm::Params &p)
{
    const char *group = "Target (exactly one)";
    AddNumber(app, "-n,--vertices", p.vertexCount, {4, 100000000, "from 4 to 100000000"},
              "number of vertices of the result, from 4 to 100000000")
        ->group(group);
    AddNumber(app, "--edge-length", p.edgeLength, {1e-300, 1e300, "above 0"},
              "mean edge length of the result, in the mesh's units, above 0")
        ->group(group);
    AddNumber(app, "--max-error", p.maxError, {1e-12, 1, "above 0 up to 1"},
              "largest distance between input and result, relative to the input's bounding-box diagonal, above 0 up to "
              "1; few vertices that reach it are looked for in up to 8 runs")
        ->group(group);
}

void AddParameters(CLI::App &app, vcg::ccdm::Params &p)
{
    AddNumber(app, "--feature-angle", p.featureAngle, {1e-6, 180, "above 0 up to 180"},
              "edges whose faces turn by more than this are kept as features, degrees, above 0 up to 180; 180: "
              "boundaries only (default: 40)");
    AddChoice(app, "--boundary", p.boundary, boundaries,
              "sliding (default): corners of the boundary stay, its other vertices are replaced; fixed: all of its "
              "vertices stay; smooth: none, sharp turns are rounded off");
    AddChoice(app, "--repair", p.repair, repairs,
              "what is mended of an input that is no surface; harmless (default): nothing that changes it, which is "
              "refused with the places; split: it is cut apart at edges of more than two faces and at vertices that "
              "join several sheets");
    AddChoice(app, "--optimizer", p.optimizer, optimizers, "accelerated (default), or annealing: the paper's");
    AddChoice(app, "--sampler", p.sampler, samplers,
              "front (default): laid out in hexagons; or random: drawn in proportion to the density");
    AddChoice(app, "--relocation", p.relocation, relocations,
              "where a vertex goes: cpt, the centroid of its star (default with annealing); cvt, that of its Voronoi "
              "cell (default otherwise); odt, the mean of the circumcentres around it");
    AddNumber(app, "--lambda", p.lambda, {0, 1, "from 0 to 1"},
              "size of the perturbation, relative to the edge length, from 0 to 1 (default: 0.2)");
    AddNumber(app, "--global-iterations", p.globalIterations, {0, 1000000, "from 0 to 1000000"},
              "perturb-optimise rounds (NG), from 0 to 1000000 (default: 14; with annealing 40)");
    AddNumber(app, "--local-iterations", p.localIterations, {1, 1000000, "from 1 to 1000000"},
              "relocations in a round (NL), from 1 to 1000000 (default: 3)");
    AddNumber(app, "--min-angle", p.minAngle, {0, 45, "from 0 to 45"},
              "smallest angle that the closing polish aims at, degrees, from 0 to 45 (default: 40; with annealing 34)");
    AddChoice(app, "--density", p.density, densities,
              "what the vertex density follows: nothing (uniform, the default), the curvature, or the quality of the "
              "vertices");
    AddNumber(app, "--density-exponent", p.densityExponent, {0, 3, "from 0 to 3"},
              "gamma in rho = phi^gamma, the weight in the energy, from 0 to 3 (default: 2, with cpt 1, with odt 1.6; "
              "with annealing 0.2)");
    AddNumber(app, "--approximation", p.approximation, {0, 1, "from 0 to 1"},
              "how much closeness to the input counts against the angles, from 0 to 1; above 0.5 the vertices leave "
              "the surface by up to the offset that makes the squared distance least (default: 0.25)");
    AddNumber(app, "--seed", p.seed, {0, 4294967295.0, "from 0 to 4294967295"},
              "of the random generator, from 0 to 4294967295 (default: 1)");
    AddNumber(app, "--threads", p.threads, {0, 256, "from 0 to 256"},
              "from 1 to 256; 0 (default): as many as there are cores; the result is the same for any");
    for (CLI::Option *option :
         app.get_options([](const CLI::Option *o) { return o->nonpositional() && o->get_group() == "Options"; }))
        option->group("Parameters");
}

// Help in two columns of at most `Width` characters together.
class HelpFormatter : public CLI::Formatter
{
public:
    std::string make_help(const CLI::App *app, std::string name, CLI::AppFormatMode mode) const override
    {
        return CLI::detail::find_and_replace(Formatter::make_help(app, name, mode), "\n\n\n", "\n\n");
    }
    std::string make_description(const CLI::App *app) const override { return Wrapped(app->get_description(), 0); }
    std::string make_footer(const CLI::App *app) const override { return "\n" + Wrapped(app->get_footer(), 0); }
    std::string make_option(const CLI::Option *option, bool positional) const override
    {
        std::string head =
            "  " + (positional ? option->get_name(true) : make_option_name(option, false) + make_option_opts(option));
        if (head.size() + 2 > Column)
            head += "\n";
        const std::size_t lines = head.back() == '\n' ? Column : Column - head.size();
        return head + std::string(lines, ' ') + Wrapped(option->get_description(), Column);
    }

private:
    static constexpr std::size_t Column = 34, Width = 100;

    // In lines from `column` on, the first of which has begun.
    static std::string Wrapped(const std::string &text, std::size_t column)
    {
        std::istringstream words(text);
        std::string word, out;
        std::size_t at = column;
        while (words >> word) {
            if (at > column && at + 1 + word.size() > Width) {
                out += "\n" + std::string(column, ' ');
                at = column;
            }
            out += (at > column ? " " : "") + word;
            at += (at > column) + word.size();
        }
        return out + "\n";
    }
};

// Number of letters to change, insert or leave out from one word to the other.
std::size_t Edits(const std::string &a, const std::string &b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t(0));
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j)
            diagonal =
                std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1, diagonal + (a[i] == b[j] ? 0 : 1)}));
    }
    return row.back();
}

// What to say of the first argument that looks like an option and is none; empty if there is none such.
std::string FaultOfUnknownOption(const CLI::App &app)
{
    for (const std::string &argument : app.remaining()) {
        if (argument.size() < 2 || argument[0] != '-')
            continue;
        const std::string name = argument.substr(0, argument.find('='));
        std::string closest;
        for (const CLI::Option *o : app.get_options())
            for (const std::string &known : o->get_lnames())
                if (closest.empty() || Edits(name, "--" + known) < Edits(name, closest))
                    closest = "--" + known;
        return "there is no option " + name + (Edits(name, closest) <= 3 ? "; is " + closest + " meant?" : "");
    }
    return "";
}

int WrongUsage(const std::string &fault)
{
    std::cerr << "ccdm_remesh: " << fault << "\nRun with --help for more information.\n";
    return 2;
}

} // namespace

const char *NameOf(BoundaryKind k)
{
    return Lookup(boundaries, k);
}
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
const char *NameOf(RepairKind k)
{
    return Lookup(repairs, k);
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
    app.formatter(std::make_shared<HelpFormatter>());
    app.get_formatter()->label("Positionals", "Files");
    app.footer("Formats: ply, off, obj, stl. Exit status: 0 done, 2 wrong usage, 3 input unreadable, 4 input refused, "
               "5 output not written, 6 result failed its check, 7 largest error not reached, "
               "128 + number of the signal when interrupted.");
    app.add_option("INPUT", options.input, "mesh to read")->required();
    app.add_option("OUTPUT", options.output, "mesh to write")->required();
    AddTarget(app, options.params);
    AddParameters(app, options.params);
    app.add_option("--report", options.report, "file for a JSON report of what was achieved")
        ->type_name("FILE")
        ->group("Output");
    app.add_flag("--quiet", options.quiet, "print errors only")->group("Output");
    app.set_help_flag("-h,--help", "print this help and exit")->group("Output");
    app.set_version_flag("--version", std::string("ccdm_remesh ") + CCDM_VERSION, "print the version and exit")
        ->group("Output");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError &e) {
        if (e.get_exit_code() == 0)
            return app.exit(e);
        const std::string unknown = FaultOfUnknownOption(app);
        return WrongUsage(unknown.empty() ? e.what() : unknown);
    }
    const vcg::ccdm::Params &p = options.params;
    if ((p.vertexCount != 0) + p.edgeLength.has_value() + p.maxError.has_value() != 1)
        return WrongUsage("exactly one of --vertices, --edge-length and --max-error is needed");
    if (!IsMeshExtension(ExtensionOf(options.output)))
        return WrongUsage(options.output + ": the output's format is not known (ply, off, obj and stl are)");
    for (const auto &[mesh, name] : {std::pair(options.input, "input"), std::pair(options.output, "output")})
        if (!options.report.empty() && IsSameFile(options.report, mesh))
            return WrongUsage(options.report + ": the report would take the place of the " + name);
    return -1;
}

} // namespace ccdm_remesh
