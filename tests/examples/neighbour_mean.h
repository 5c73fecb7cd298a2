// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_TESTS_EXAMPLES_NEIGHBOUR_MEAN_H
#define CCDM_TESTS_EXAMPLES_NEIGHBOUR_MEAN_H

#include <vcg/complex/algorithms/ccdm/centroid_rules.h>

namespace examples {

/// A relocation rule: the mean of the neighbours, the umbrella operator of Laplacian smoothing (Taubin 1995), each
/// weighted with the density half way to it.
struct NeighbourMean {
    static constexpr double Pull = 0.5; ///< share of the displacement that momentum bears
    const vcg::ccdm::Remesh &remesh;
    bool uniform;

    vcg::ccdm::Point operator()(const vcg::ccdm::LocalStar &star, int v) const
    {
        vcg::ccdm::Point sum(0, 0, 0);
        double mass = 0;
        for (int k = 0; k < star.spokes; ++k) {
            const double m = uniform ? 1 : remesh.rho[v] + remesh.rho[star.id[k]];
            sum += star.spoke[k] * m;
            mass += m;
        }
        return mass > 0 ? sum / mass : vcg::ccdm::Point(0, 0, 0);
    }
};

} // namespace examples

#endif
