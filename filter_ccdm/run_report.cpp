// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_report.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <vcg/complex/algorithms/ccdm/mended_figures.h>
#include <vcg/complex/algorithms/ccdm/target_search.h>

using vcg::ccdm::Params;

namespace filter_ccdm {

Measured::Measured(const Mesh &input, const Mesh &result, vcg::ccdm::Report r, double time, bool parallel)
    : report(std::move(r)), seconds(time), diagonal(Diagonal(input)),
      figures(vcg::ccdm::CompareMended(input, result, report, parallel))
{
}

QStringList DescribePlan(const Mesh &input, const Settings &settings)
{
    const Params &p = settings.engine;
    QString target;
    if (settings.edgeLengthPercent)
        target = QString("a mean edge length of %1 % of the diagonal").arg(*settings.edgeLengthPercent);
    else if (p.maxError)
        target = QString("an error of at most %1 % of the diagonal").arg(100 * *p.maxError);
    else
        target = QString("%1 vertices").arg(p.vertexCount);
    QString features = p.featureAngle < 180 ? QString("edges that turn by more than %1 deg").arg(p.featureAngle)
                                            : QString("boundaries only");
    const int selected = p.useMarkedEdges ? SelectedEdgeCount(input) : 0;
    if (p.useMarkedEdges)
        features += QString(" and the selected edges (%1 sides of faces)").arg(selected);
    static constexpr std::array<const char *, 3> densities = {"uniform", "by curvature", "by vertex quality"};
    static constexpr std::array<const char *, 3> boundaries = {"sliding", "fixed", "smooth"};
    QStringList lines;
    lines << QString("remeshing %1 vertices, %2 faces to %3; %4")
                 .arg(input.VN())
                 .arg(input.FN())
                 .arg(target, settings.newLayer ? "into a new layer" : "in place");
    if (p.selectedFacesOnly)
        lines << QString("only the %1 selected faces; all else stays as it is").arg(SelectedFaceCount(input));
    lines << QString("features: %1; boundary: %2; density: %3")
                 .arg(features, boundaries[static_cast<std::size_t>(p.boundary)],
                      densities[static_cast<std::size_t>(p.density)]);
    lines << QString("%1 optimizer, %2 x %3 iterations, lambda %4, smallest angle %5 deg, approximation %6, seed %7")
                 .arg(p.optimizer == vcg::ccdm::OptimizerKind::Accelerated ? "accelerated" : "annealing")
                 .arg(vcg::ccdm::GlobalIterations(p))
                 .arg(p.localIterations)
                 .arg(p.lambda)
                 .arg(vcg::ccdm::MinAngle(p))
                 .arg(p.approximation)
                 .arg(p.seed);
    return lines;
}

QStringList DescribeRun(const Measured &run)
{
    const vcg::ccdm::Report &report = run.report;
    const auto &before = run.figures.before, &after = run.figures.after;
    QStringList lines;
    const auto line = [&](const QString &name, const QString &a, const QString &b) {
        lines << name.leftJustified(36) + a.rightJustified(10) + b.rightJustified(10);
    };
    const auto row = [&](const char *name, double a, double b, int digits) {
        line(name, QString::number(a, 'f', digits), QString::number(b, 'f', digits));
    };
    line("", "before", "after");
    row("vertices", before.vertices - before.unreferenced, after.vertices - after.unreferenced, 0);
    row("faces", before.faces, after.faces, 0);
    row("Euler characteristic", before.euler, after.euler, 0);
    row("boundary loops", before.boundaryLoops, after.boundaryLoops, 0);
    row("average smallest angle (deg)", before.angleMinAvg, after.angleMinAvg, 2);
    row("smallest angle (deg)", before.angleMin, after.angleMin, 2);
    row("angles below 30 deg (%)", before.pctLt30, after.pctLt30, 3);
    row("aspect ratio [FB99], average", before.qFb99Avg, after.qFb99Avg, 3);
    row("interior vertices of valence 6 (%)", before.pctValence6, after.pctValence6, 1);
    lines << QString("distance / diagonal: Hausdorff %1, RMS %2")
                 .arg(run.figures.distance.hausdorff, 0, 'e', 2)
                 .arg(run.figures.distance.rms, 0, 'e', 2);
    const vcg::tri::SelfIntersectionCounts &crossing = run.figures.selfIntersections;
    if (crossing.before + crossing.after > 0)
        lines << QString("pairs of faces that cross: %1 before, %2 after; faces in new ones: %3")
                     .arg(crossing.before)
                     .arg(crossing.after)
                     .arg(crossing.newFaces);
    lines << QString("topology%1 %2 (Euler characteristic %3, %4 boundary loops, %5)")
                 .arg(report.keptVertices > 0 ? " of the remeshed part" : "",
                      report.topologyPreserved ? "preserved" : "changed")
                 .arg(report.resultTopology.euler)
                 .arg(report.resultTopology.boundaryLoops)
                 .arg(report.resultTopology.orientable ? "orientable" : "not orientable");
    if (report.target != vcg::ccdm::TargetKind::Vertices) {
        const bool length = report.target == vcg::ccdm::TargetKind::EdgeLength;
        const double percent = 100 / (length ? run.diagonal : 1);
        lines << QString("%1 (% of the diagonal): asked %2, reached %3%4 in %5 run(s)")
                     .arg(length ? "mean edge length" : "largest error")
                     .arg(percent * report.asked)
                     .arg(percent * report.reached)
                     .arg(vcg::ccdm::TargetSearch::Met(report) ? "" : " (not met)")
                     .arg(report.runs);
    }
    lines << QString("%1 feature curves, %2 corners; %3 of %4 global iterations accepted; %5 s")
                 .arg(report.featureCurves)
                 .arg(report.featureCorners)
                 .arg(report.accepted)
                 .arg(report.energy.empty() ? 0 : static_cast<int>(report.energy.size()) - 1)
                 .arg(run.seconds, 0, 'f', 2);
    return lines;
}

Outputs OutputsOf(const Measured &run)
{
    const vcg::ccdm::Report &report = run.report;
    const auto &[before, after, distance, crossing] = run.figures;
    Outputs out;
    // PyMeshLab passes on int, double and bool, nothing unsigned, long or text.
    out["vertex_number"] = after.vertices;
    out["face_number"] = after.faces;
    out["extra_vertices"] = report.extraVertices;
    out["kept_vertices"] = report.keptVertices;
    out["average_smallest_angle"] = after.angleMinAvg;
    out["smallest_angle"] = after.angleMin;
    out["largest_angle"] = after.angleMax;
    out["percent_angles_below_30"] = after.pctLt30;
    out["triangles_below_min_angle"] = static_cast<int>(report.angles.below.size());
    out["average_aspect_ratio"] = after.qFb99Avg;
    out["smallest_aspect_ratio"] = after.qFb99Min;
    out["percent_valence_6"] = after.pctValence6;
    out["mean_edge_length"] = report.meanEdgeLength;
    out["surface_area"] = after.area;
    out["hausdorff"] = distance.hausdorff;
    out["rms"] = distance.rms;
    out["euler_characteristic_before"] = before.euler;
    out["euler_characteristic_after"] = after.euler;
    out["boundary_loops"] = after.boundaryLoops;
    out["components"] = after.components;
    // A count of pairs above the range of int is one too many to be read.
    const auto count = [](long long pairs) {
        return static_cast<int>(std::min<long long>(pairs, std::numeric_limits<int>::max()));
    };
    out["crossing_pairs_before"] = count(crossing.before);
    out["crossing_pairs_after"] = count(crossing.after);
    out["faces_in_new_crossings"] = crossing.newFaces;
    out["topology_preserved"] = report.topologyPreserved;
    out["target_met"] = vcg::ccdm::TargetSearch::Met(report);
    out["energy_before"] = report.energy.empty() ? 0.0 : report.energy.front();
    out["energy"] = report.energy.empty() ? 0.0 : report.energy.back();
    out["iterations"] = report.energy.empty() ? 0 : static_cast<int>(report.energy.size()) - 1;
    out["iterations_accepted"] = report.accepted;
    out["feature_curves"] = report.featureCurves;
    out["feature_corners"] = report.featureCorners;
    out["warnings"] = static_cast<int>(report.warnings.size());
    out["seconds"] = run.seconds;
    return out;
}

} // namespace filter_ccdm
