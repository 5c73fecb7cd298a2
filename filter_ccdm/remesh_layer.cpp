// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh_layer.h"

#include <vcg/complex/algorithms/ccdm_remeshing.h>
#include <vcg/complex/algorithms/mesh_quality.h>

namespace filter_ccdm {

void CopyFromLayer(const CMeshO &layer, Mesh &mesh)
{
    mesh.Clear();
    std::vector<int> index(layer.vert.size(), -1);
    auto v = vcg::tri::Allocator<Mesh>::AddVertices(mesh, static_cast<std::size_t>(layer.vn));
    int next = 0;
    for (std::size_t i = 0; i < layer.vert.size(); ++i) {
        if (layer.vert[i].IsD())
            continue;
        index[i] = next++;
        v->P().Import(layer.vert[i].cP());
        v->Q() = static_cast<double>(layer.vert[i].cQ());
        ++v;
    }
    auto f = vcg::tri::Allocator<Mesh>::AddFaces(mesh, static_cast<std::size_t>(layer.fn));
    for (const CFaceO &source : layer.face) {
        if (source.IsD())
            continue;
        for (int k = 0; k < 3; ++k) {
            f->V(k) =
                &mesh.vert[static_cast<std::size_t>(index[static_cast<std::size_t>(source.cV(k) - layer.vert.data())])];
            if (source.IsFaceEdgeS(k))
                f->SetFaceEdgeS(k);
        }
        ++f;
    }
}

void CopyToLayer(const Mesh &mesh, MeshModel &layer)
{
    layer.cm.Clear();
    CMeshO &m = layer.cm;
    auto v = vcg::tri::Allocator<CMeshO>::AddVertices(m, mesh.vert.size());
    for (const Vertex &source : mesh.vert) {
        v->P().Import(source.cP());
        ++v;
    }
    auto f = vcg::tri::Allocator<CMeshO>::AddFaces(m, mesh.face.size());
    for (const Face &source : mesh.face) {
        for (int k = 0; k < 3; ++k)
            f->V(k) = &m.vert[static_cast<std::size_t>(source.cV(k) - mesh.vert.data())];
        ++f;
    }
    layer.UpdateBoxAndNormals();
}

vcg::ccdm::Report RemeshCopy(const Mesh &input, Mesh &result, const vcg::ccdm::Params &params,
                             vcg::CallBackPos *progress)
{
    vcg::ccdm::Report report = vcg::tri::CCDMRemeshing<Mesh>::Do(input, result, params, progress);
    if (report.status != vcg::ccdm::Status::Done)
        throw Failure(report.message);
    return report;
}

QStringList DescribeRun(const Mesh &input, const Mesh &result, const vcg::ccdm::Report &report, double seconds)
{
    using Quality = vcg::tri::MeshQuality<Mesh>;
    const vcg::tri::MeshQualityReport before = Quality::Measure(input), after = Quality::Measure(result);
    const vcg::tri::SurfaceDistance distance = Quality::Distance(input, result);
    QStringList lines;
    const auto row = [&](const char *name, double a, double b, int digits) {
        lines << QString("%1: %2 before, %3 after").arg(name).arg(a, 0, 'f', digits).arg(b, 0, 'f', digits);
    };
    row("vertices", before.vertices - before.unreferenced, after.vertices, 0);
    row("faces", before.faces, after.faces, 0);
    row("average smallest angle (deg)", before.angleMinAvg, after.angleMinAvg, 2);
    row("smallest angle (deg)", before.angleMin, after.angleMin, 2);
    row("angles below 30 deg (%)", before.pctLt30, after.pctLt30, 3);
    row("aspect ratio [FB99], average", before.qFb99Avg, after.qFb99Avg, 3);
    row("interior vertices of valence 6 (%)", before.pctValence6, after.pctValence6, 1);
    lines << QString("distance / diagonal: Hausdorff %1, RMS %2")
                 .arg(distance.hausdorff, 0, 'e', 2)
                 .arg(distance.rms, 0, 'e', 2);
    lines << QString("topology preserved (Euler characteristic %1, %2 boundary loops, %3)")
                 .arg(report.resultTopology.euler)
                 .arg(report.resultTopology.boundaryLoops)
                 .arg(report.resultTopology.orientable ? "orientable" : "not orientable");
    lines << QString("%1 feature curves, %2 corners; %3 of %4 global iterations accepted; %5 s")
                 .arg(report.featureCurves)
                 .arg(report.featureCorners)
                 .arg(report.accepted)
                 .arg(static_cast<int>(report.energy.size()) - 1)
                 .arg(seconds, 0, 'f', 2);
    for (const std::string &w : report.warnings)
        lines << "note: " + QString::fromStdString(w);
    return lines;
}

} // namespace filter_ccdm
