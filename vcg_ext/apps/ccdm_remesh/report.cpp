// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include <array>
#include <cmath>
#include <iomanip>

#include <nlohmann/json.hpp>

#include <vcg/complex/algorithms/ccdm/target_search.h>

#include "atomic_file.h"

namespace ccdm_remesh {
namespace {

using Json = nlohmann::ordered_json;
using vcg::tri::MeshQualityReport;

constexpr std::size_t MostListed = 1000; // entries of a list in the report

Json Number(double x)
{
    return std::isfinite(x) ? Json(x) : Json(nullptr);
}

Json QualityJson(const MeshQualityReport &q)
{
    Json j;
    j["vertices"] = q.vertices - q.unreferenced;
    j["faces"] = q.faces;
    j["euler"] = q.euler;
    j["components"] = q.components;
    j["boundary_loops"] = q.boundaryLoops;
    j["genus"] = q.genus ? Number(*q.genus) : Json(nullptr);
    j["orientable"] = q.orientable;
    j["angle_min_avg"] = Number(q.angleMinAvg);
    j["angle_min"] = Number(q.angleMin);
    j["pct_lt30"] = Number(q.pctLt30);
    j["q_fb99_avg"] = Number(q.qFb99Avg);
    j["q_fb99_min"] = Number(q.qFb99Min);
    j["pct_valence6"] = Number(q.pctValence6);
    j["folded_edges"] = q.foldedEdges;
    return j;
}

Json ParametersJson(const vcg::ccdm::Params &p)
{
    Json j;
    j["vertices"] = p.vertexCount != 0 ? Json(p.vertexCount) : Json(nullptr);
    j["edge_length"] = p.edgeLength ? Number(*p.edgeLength) : Json(nullptr);
    j["max_error"] = p.maxError ? Number(*p.maxError) : Json(nullptr);
    j["feature_angle"] = p.featureAngle;
    j["lambda"] = p.lambda;
    j["global_iterations"] = GlobalIterations(p);
    j["local_iterations"] = p.localIterations;
    j["boundary"] = NameOf(p.boundary);
    j["repair"] = NameOf(p.repair);
    j["density"] = NameOf(p.density);
    j["density_exponent"] = DensityExponent(p);
    j["min_angle"] = MinAngle(p);
    j["approximation"] = p.approximation;
    j["optimizer"] = NameOf(p.optimizer);
    j["sampler"] = NameOf(p.sampler);
    j["relocation"] = NameOf(Relocation(p));
    j["seed"] = p.seed;
    return j;
}

Json DefectsJson(const vcg::ccdm::InputDefects &d)
{
    Json j;
    j["unreferenced_vertices"] = d.unreferencedVertices;
    j["repeated_index_faces"] = d.repeatedIndexFaces;
    j["zero_area_faces"] = d.zeroAreaFaces;
    j["turned_faces"] = d.turnedFaces;
    j["merged_vertices"] = d.mergedVertices;
    j["copied_vertices"] = d.copiedVertices;
    j["non_finite_vertices"] = d.nonFiniteVertices;
    j["non_manifold_edges"] = d.nonManifoldEdges;
    j["non_manifold_vertices"] = d.nonManifoldVertices;
    j["duplicate_faces"] = d.duplicateFaces;
    j["bad_density_vertices"] = d.badDensityVertices;
    j["refused_edges"] = d.refusedEdges;
    j["refused_vertices"] = d.refusedVertices;
    return j;
}

Json NarrowJson(const std::vector<vcg::ccdm::NarrowPlace> &places)
{
    Json j;
    j["count"] = places.size();
    j["places"] = Json::array();
    for (const vcg::ccdm::NarrowPlace &p : places) {
        if (j["places"].size() == MostListed)
            break;
        j["places"].push_back({{"kind", p.kind == vcg::ccdm::NarrowKind::ThinPart ? "thin_part" : "close_features"},
                               {"position", p.position},
                               {"width", Number(p.width)},
                               {"spacing", Number(p.spacing)},
                               {"vertices", Number(p.vertices)}});
    }
    return j;
}

constexpr std::array<const char *, vcg::ccdm::SmallAngleReasonCount> reasons = {
    "input_corner", "close_features", "thin_part", "few_vertices", "unexplained"};
constexpr std::array<const char *, vcg::ccdm::SmallAngleReasonCount> reasonNames = {
    "at input corners", "between close features", "on thin parts", "for few vertices", "unexplained"};

Json AnglesJson(const vcg::ccdm::AngleCertificate &c)
{
    Json j;
    j["target"] = Number(c.target);
    j["reached"] = Number(c.reached);
    j["below"] = c.below.size();
    for (int k = 0; k < vcg::ccdm::SmallAngleReasonCount; ++k)
        j["reasons"][reasons[k]] = c.Count(static_cast<vcg::ccdm::SmallAngleReason>(k));
    j["triangles"] = Json::array();
    for (const vcg::ccdm::SmallAngle &a : c.below) {
        if (j["triangles"].size() == MostListed)
            break;
        j["triangles"].push_back({{"face", a.face},
                                  {"angle", Number(a.degrees)},
                                  {"position", a.position},
                                  {"reason", reasons[static_cast<std::size_t>(a.reason)]}});
    }
    return j;
}

} // namespace

std::string WriteReport(const Options &options, const RunSummary &run)
{
    const vcg::ccdm::Report &e = run.engine;
    Json j;
    j["status"] = run.status;
    j["message"] = run.message;
    j["input"] = run.measured ? QualityJson(run.measured->before) : Json::object();
    j["input"]["file"] = options.input;
    j["input"]["defects"] = DefectsJson(e.defects);
    j["parameters"] = ParametersJson(options.params);
    j["result"] = nullptr;
    if (run.measured) {
        const vcg::tri::MeshComparison &m = *run.measured;
        j["result"] = QualityJson(m.after);
        j["result"]["file"] = options.output;
        j["result"]["hausdorff"] = Number(m.distance.hausdorff);
        j["result"]["rms"] = Number(m.distance.rms);
        j["input"]["self_intersections"] = m.selfIntersections.before;
        j["result"]["self_intersections"] = m.selfIntersections.after;
        j["result"]["new_self_intersecting_faces"] = m.selfIntersections.newFaces;
        j["result"]["extra_vertices"] = e.extraVertices;
        j["result"]["mean_edge_length"] = Number(e.meanEdgeLength);
    }
    j["target"] = {{"kind", NameOf(e.target)},
                   {"asked", Number(e.asked)},
                   {"reached", Number(e.reached)},
                   {"met", vcg::ccdm::TargetSearch::Met(e)},
                   {"runs", e.runs}};
    j["topology_preserved"] = e.topologyPreserved;
    j["features"] = {{"curves", e.featureCurves}, {"corners", e.featureCorners}, {"pruned", e.prunedFragments}};
    j["smallest_angle"] = run.measured ? AnglesJson(e.angles) : Json(nullptr);
    j["narrow"] = NarrowJson(e.narrow);
    j["energy"] = e.energy;
    j["accepted"] = e.accepted;
    j["relocations"] = e.relocations;
    j["flips"] = e.flips;
    j["flips_bounded"] = e.flipsBounded;
    j["seconds"] = Json::object();
    for (const auto &s : e.seconds)
        j["seconds"][s.first] = s.second;
    j["seconds"]["total"] = run.seconds;
    j["warnings"] = e.warnings;
    return WriteAtomically(options.report, j.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

void PrintTable(std::ostream &out, const RunSummary &run, const vcg::tri::MeshComparison &measured)
{
    const auto row = [&](const char *name, int digits, auto value) {
        out << "  " << std::left << std::setw(34) << name << std::right << std::fixed << std::setprecision(digits);
        out << std::setw(12) << value(measured.before) << std::setw(12) << value(measured.after) << '\n';
    };
    out << "  " << std::left << std::setw(34) << "" << std::right << std::setw(12) << "before" << std::setw(12)
        << "after" << '\n';
    row("vertices", 0, [](const MeshQualityReport &q) { return q.vertices - q.unreferenced; });
    row("faces", 0, [](const MeshQualityReport &q) { return q.faces; });
    row("Euler characteristic", 0, [](const MeshQualityReport &q) { return q.euler; });
    row("boundary loops", 0, [](const MeshQualityReport &q) { return q.boundaryLoops; });
    row("average smallest angle (deg)", 2, [](const MeshQualityReport &q) { return q.angleMinAvg; });
    row("smallest angle (deg)", 2, [](const MeshQualityReport &q) { return q.angleMin; });
    row("angles below 30 deg (%)", 3, [](const MeshQualityReport &q) { return q.pctLt30; });
    row("aspect ratio [FB99], average", 3, [](const MeshQualityReport &q) { return q.qFb99Avg; });
    row("interior vertices of valence 6 (%)", 1, [](const MeshQualityReport &q) { return q.pctValence6; });
    out << "  distance / diagonal: Hausdorff " << std::scientific << std::setprecision(2) << measured.distance.hausdorff
        << ", RMS " << measured.distance.rms << '\n';
    if (run.engine.target != vcg::ccdm::TargetKind::Vertices)
        out << "  " << (run.engine.target == vcg::ccdm::TargetKind::EdgeLength ? "mean edge length" : "largest error")
            << ": asked " << std::defaultfloat << std::setprecision(4) << run.engine.asked << ", reached "
            << run.engine.reached << (vcg::ccdm::TargetSearch::Met(run.engine) ? "" : " (not met)") << " in "
            << run.engine.runs << (run.engine.runs == 1 ? " run\n" : " runs\n");
    const vcg::ccdm::AngleCertificate &angles = run.engine.angles;
    out << "  triangles below " << std::defaultfloat << std::setprecision(4) << angles.target
        << " deg: " << angles.below.size();
    const char *before = " (";
    for (int k = 0; k < vcg::ccdm::SmallAngleReasonCount; ++k)
        if (const int count = angles.Count(static_cast<vcg::ccdm::SmallAngleReason>(k))) {
            out << before << count << ' ' << reasonNames[k];
            before = ", ";
        }
    out << (angles.below.empty() ? "\n" : ")\n");
    out << "  topology " << (run.engine.topologyPreserved ? "preserved" : "changed") << "; " << run.engine.featureCurves
        << " feature curves, " << run.engine.featureCorners << " corners; " << std::fixed << std::setprecision(2)
        << run.seconds << " s\n";
    const vcg::tri::SelfIntersectionCounts &crossing = measured.selfIntersections;
    if (crossing.before + crossing.after > 0)
        out << "  pairs of faces that cross: " << crossing.before << " before, " << crossing.after
            << " after; faces in new ones: " << crossing.newFaces << '\n';
    for (const std::string &w : run.engine.warnings)
        out << "  note: " << w << '\n';
}

} // namespace ccdm_remesh
