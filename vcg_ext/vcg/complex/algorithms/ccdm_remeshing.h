// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_REMESHING_H
#define VCG_CCDM_REMESHING_H

#include <vcg/complex/complex.h>

#include <vcg/complex/algorithms/ccdm/parameters.h>

namespace vcg {
namespace tri {

/// Isotropic surface remeshing by constrained centroidal Delaunay meshes.
template <class MeshType>
class CCDMRemeshing
{
public:
    using Params = ccdm::Params;
    using Report = ccdm::Report;

    /// Remeshes `input` into `output`, which is replaced when the status is Done and left alone
    /// otherwise. Positions, vertex quality (DensityKind::Quality) and face-edge selection
    /// (useMarkedEdges) are read; deleted elements are skipped.
    /// `progress` gets positions 0 to 100, never falling; returning false cancels.
    static Report Do(const MeshType &input, MeshType &output, const Params &params, CallBackPos *progress = nullptr);

    /// Remeshes in place; the mesh is untouched unless the status is Done.
    static Report Do(MeshType &mesh, const Params &params, CallBackPos *progress = nullptr);
};

} // namespace tri
} // namespace vcg

#endif
