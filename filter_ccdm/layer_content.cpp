// SPDX-License-Identifier: GPL-3.0-or-later
#include "layer_content.h"

namespace filter_ccdm {

namespace {

// All components that a layer may have beside those that it always has.
constexpr int Optional = MeshModel::MM_VERTCOLOR | MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTMARK |
                         MeshModel::MM_VERTFACETOPO | MeshModel::MM_VERTCURV | MeshModel::MM_VERTCURVDIR |
                         MeshModel::MM_VERTRADIUS | MeshModel::MM_VERTTEXCOORD | MeshModel::MM_FACECOLOR |
                         MeshModel::MM_FACEQUALITY | MeshModel::MM_FACEMARK | MeshModel::MM_FACEFACETOPO |
                         MeshModel::MM_FACECURVDIR | MeshModel::MM_WEDGTEXCOORD | MeshModel::MM_POLYGONAL;

} // namespace

LayerContent::LayerContent(const Mesh &result, MeshModel &target) : _target(target)
{
    const std::vector<vcg::Point3d> normal = VertexNormals(result);
    auto v = vcg::tri::Allocator<CMeshO>::AddVertices(mesh, result.vert.size());
    mesh.bbox.SetNull();
    for (std::size_t i = 0; i < result.vert.size(); ++i, ++v) {
        v->P().Import(result.vert[i].cP());
        v->N().Import(normal[i]);
        mesh.bbox.Add(v->P());
    }
    auto f = vcg::tri::Allocator<CMeshO>::AddFaces(mesh, result.face.size());
    for (const Face &source : result.face) {
        for (int k = 0; k < 3; ++k)
            f->V(k) = &mesh.vert[static_cast<std::size_t>(source.cV(k) - result.vert.data())];
        vcg::Point3d across = (source.cP(1) - source.cP(0)) ^ (source.cP(2) - source.cP(0));
        f->N().Import(across.Normalize());
        ++f;
    }
}

void LayerContent::Replace(Attributes &old, Attributes &fresh) noexcept
{
    for (const vcg::PointerToAttribute &attribute : old)
        delete attribute._handle;
    old.clear();
    old.swap(fresh);
}

void LayerContent::Commit() noexcept
{
    CMeshO &m = _target.cm;
    std::swap(m.vert, mesh.vert);
    std::swap(m.face, mesh.face);
    // The elements point to their container.
    m.vert._updateOVP(m.vert.begin(), m.vert.end());
    m.face._updateOVP(m.face.begin(), m.face.end());
    mesh.vert._updateOVP(mesh.vert.begin(), mesh.vert.end());
    mesh.face._updateOVP(mesh.face.begin(), mesh.face.end());
    std::swap(m.vn, mesh.vn);
    std::swap(m.fn, mesh.fn);
    m.edge.clear();
    m.en = 0;
    m.bbox = mesh.bbox;
    m.svn = m.sfn = m.pvn = m.pfn = 0;
    for (const CVertexO &v : m.vert)
        m.svn += v.IsS();
    for (const CFaceO &f : m.face)
        m.sfn += f.IsS();

    for (auto &data : _owned)
        (void)data.release(); // the sets own them now
    m.attrn += static_cast<int>(_owned.size());
    Replace(m.vert_attr, _ofVertices);
    Replace(m.face_attr, _ofFaces);
    for (const vcg::PointerToAttribute &attribute : m.edge_attr)
        attribute._handle->Resize(0);

    _target.clearDataMask(Optional & ~mask);
    _target.updateDataMask(mask);
}

} // namespace filter_ccdm
