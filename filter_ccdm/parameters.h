// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_CCDM_PARAMETERS_H
#define FILTER_CCDM_PARAMETERS_H

#include <optional>
#include <stdexcept>

#include <vcg/complex/algorithms/ccdm/parameters.h>

#include "host_api.h"

namespace filter_ccdm {

/// A run that ended without a result; what() is plain text.
struct Failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The filter's parameters with their values as the user set them.
struct Settings {
    /// All but the edge length, which needs the size of the mesh.
    vcg::ccdm::Params engine;
    /// Mean edge length in percent of the bounding box's diagonal, when it is the target.
    std::optional<double> edgeLengthPercent;
    /// What the layer has beside the mesh goes to the result.
    bool keepAttributes = true;
    bool newLayer = true;
};

/// The parameters in the order of the dialog and of a script; `vertices` is the default of the vertex count.
RichParameterList DeclareParameters(int vertices);

/// Throws Failure with the parameter's name and range when a value is out of it.
Settings ReadParameters(const RichParameterList &list);

} // namespace filter_ccdm

#endif
