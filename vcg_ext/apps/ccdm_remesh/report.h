// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_REMESH_REPORT_H
#define CCDM_REMESH_REPORT_H

#include <optional>
#include <ostream>
#include <string>

#include <vcg/complex/algorithms/ccdm/parameters.h>
#include <vcg/complex/algorithms/mesh_quality.h>

#include "options.h"

namespace ccdm_remesh {

/// What is known at the end of a run; figures that could not be measured are unset.
struct RunSummary {
    int status = 0; ///< exit status
    std::string message;
    vcg::ccdm::Report engine;
    std::optional<vcg::tri::MeshComparison> measured;
    double seconds = 0; ///< wall time of reading, remeshing, writing and measuring
};

/// Writes the JSON report. Returns what went wrong, or an empty string.
std::string WriteReport(const Options &options, const RunSummary &run);

/// Prints quality before and after as a table, and the warnings.
void PrintTable(std::ostream &out, const RunSummary &run, const vcg::tri::MeshComparison &measured);

} // namespace ccdm_remesh

#endif
