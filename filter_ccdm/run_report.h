// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_CCDM_RUN_REPORT_H
#define FILTER_CCDM_RUN_REPORT_H

#include <map>
#include <string>

#include <QString>
#include <QStringList>
#include <QVariant>

#include <vcg/complex/algorithms/mesh_quality.h>

#include "remesh_layer.h"

namespace filter_ccdm {

/// Numbers for scripts, by name.
using Outputs = std::map<std::string, QVariant>;

/// A finished run, measured.
struct Measured {
    Measured(const Mesh &input, const Mesh &result, vcg::ccdm::Report report, double seconds, bool parallel);

    vcg::ccdm::Report report;
    double seconds;
    double diagonal; ///< of the input
    vcg::tri::MeshComparison figures;
};

/// What will be done, for the log before the run.
QStringList DescribePlan(const Mesh &input, const Settings &settings);

/// Quality before and after as a table, distance, topology, time.
QStringList DescribeRun(const Measured &run);

/// The numbers of the run that PyMeshLab returns.
Outputs OutputsOf(const Measured &run);

} // namespace filter_ccdm

#endif
