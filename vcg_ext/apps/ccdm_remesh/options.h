// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_REMESH_OPTIONS_H
#define CCDM_REMESH_OPTIONS_H

#include <string>

#include <vcg/complex/algorithms/ccdm/parameters.h>

namespace ccdm_remesh {

struct Options {
    std::string input;
    std::string output;
    std::string report; ///< path of the JSON report; empty: none
    bool quiet = false;
    vcg::ccdm::Params params;
};

/// Names of the enumerations as the command line and the report spell them.
const char *NameOf(vcg::ccdm::BoundaryKind k);
const char *NameOf(vcg::ccdm::DensityKind k);
const char *NameOf(vcg::ccdm::OptimizerKind k);
const char *NameOf(vcg::ccdm::RelocationKind k);
const char *NameOf(vcg::ccdm::RepairKind k);
const char *NameOf(vcg::ccdm::SamplerKind k);
const char *NameOf(vcg::ccdm::TargetKind k);

/// Reads the arguments. Returns -1 to go on, else the exit status (0 after --help and --version, 2 for
/// wrong usage, which has been explained on standard error).
int ParseArguments(int argc, char **argv, Options &options);

} // namespace ccdm_remesh

#endif
