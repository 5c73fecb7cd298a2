// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
        if (source.IsS())
            f->SetS();
        ++f;
    }
}

bool IsAsCopied(const CMeshO &layer, const Mesh &copy)
{
    Mesh now;
    CopyFromLayer(layer, now);
    const auto samePlace = [](const Vertex &a, const Vertex &b) { return a.cP() == b.cP(); };
    const auto sameFace = [&](const Face &a, const Face &b) {
        bool same = a.IsS() == b.IsS();
        for (int k = 0; k < 3; ++k)
            same = same && now.IndexOf(a, k) == copy.IndexOf(b, k);
        return same;
    };
    return std::equal(now.vert.begin(), now.vert.end(), copy.vert.begin(), copy.vert.end(), samePlace) &&
           std::equal(now.face.begin(), now.face.end(), copy.face.begin(), copy.face.end(), sameFace);
}

std::vector<vcg::Point3d> VertexNormals(const Mesh &mesh)
{
    std::vector<vcg::Point3d> normal(mesh.vert.size(), vcg::Point3d(0, 0, 0));
    for (const Face &f : mesh.face) {
        vcg::Point3d across = (f.cP(1) - f.cP(0)) ^ (f.cP(2) - f.cP(0));
        across.Normalize();
        for (int k = 0; k < 3; ++k) {
            const vcg::Point3d a = f.cP((k + 1) % 3) - f.cP(k), b = f.cP((k + 2) % 3) - f.cP(k);
            normal[static_cast<std::size_t>(mesh.IndexOf(f, k))] += across * std::atan2((a ^ b).Norm(), a * b);
        }
    }
    for (vcg::Point3d &n : normal)
        n.Normalize();
    return normal;
}

double Diagonal(const Mesh &mesh, bool selectedOnly)
{
    vcg::Box3d box;
    for (const Face &f : mesh.face)
        for (int k = 0; k < 3 && (!selectedOnly || f.IsS()); ++k)
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

int SelectedFaceCount(const Mesh &mesh)
{
    return static_cast<int>(std::count_if(mesh.face.begin(), mesh.face.end(), [](const Face &f) { return f.IsS(); }));
}

int VertexBudget(const Mesh &input, const vcg::ccdm::Params &params)
{
    double area = 0;
    std::vector<char> stays(input.vert.size(), 0);
    for (const Face &f : input.face)
        if (f.IsS() || !params.selectedFacesOnly)
            area += ((f.cP(1) - f.cP(0)) ^ (f.cP(2) - f.cP(0))).Norm() / 2;
        else
            for (int k = 0; k < 3; ++k)
                stays[static_cast<std::size_t>(input.IndexOf(f, k))] = 1;
    constexpr int most = std::numeric_limits<int>::max();
    if (params.edgeLength) // equilateral triangles, two for each vertex
        return static_cast<int>(std::min<double>(most, 2 / std::sqrt(3) * area / std::pow(*params.edgeLength, 2)));
    return params.maxError ? most
                           : params.vertexCount - static_cast<int>(std::count(stays.begin(), stays.end(), char(1)));
}

vcg::ccdm::Report RemeshCopy(const Mesh &input, Mesh &result, const vcg::ccdm::Params &params,
                             vcg::CallBackPos *progress, vcg::ccdm::Provenance *provenance)
{
    // The engine relates errors to the part that it remeshes.
    vcg::ccdm::Params own = params;
    const double part = Diagonal(input, params.selectedFacesOnly), scale = part > 0 ? Diagonal(input) / part : 1;
    if (params.maxError)
        own.maxError = std::min(1.0, *params.maxError * scale);
    vcg::ccdm::Report report = vcg::tri::CCDMRemeshing<Mesh>::Do(input, result, own, progress, provenance);
    if (params.maxError) {
        report.asked /= scale;
        report.reached /= scale;
    }
    if (report.status == vcg::ccdm::Status::NotReached)
        throw Failure(QString("an error of %1 % of the diagonal was not reached in %2 run(s); the closest came within "
                              "%3 %")
                          .arg(100 * *params.maxError)
                          .arg(report.runs)
                          .arg(100 * report.reached, 0, 'g', 3)
                          .toStdString());
    if (report.status != vcg::ccdm::Status::Done)
        throw Failure(report.message);
    return report;
}

} // namespace filter_ccdm
