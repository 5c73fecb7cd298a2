// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh_layer.h"

#include <vcg/complex/algorithms/ccdm_remeshing.h>

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
    m.sfn = m.svn = 0;
    UpdateBoxAndNormals(layer);
}

double Diagonal(const Mesh &mesh)
{
    vcg::Box3d box;
    for (const Face &f : mesh.face)
        for (int k = 0; k < 3; ++k)
            box.Add(f.cP(k));
    return box.IsNull() ? 0 : box.Diag();
}

int SelectedEdgeCount(const Mesh &mesh)
{
    int count = 0;
    for (const Face &f : mesh.face)
        for (int k = 0; k < 3; ++k)
            count += f.IsFaceEdgeS(k);
    return count;
}

vcg::ccdm::Report RemeshCopy(const Mesh &input, Mesh &result, const vcg::ccdm::Params &params,
                             vcg::CallBackPos *progress)
{
    vcg::ccdm::Report report = vcg::tri::CCDMRemeshing<Mesh>::Do(input, result, params, progress);
    if (report.status != vcg::ccdm::Status::Done)
        throw Failure(report.message);
    return report;
}

} // namespace filter_ccdm
