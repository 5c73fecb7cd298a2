// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_CCDM_HOST_API_H
#define FILTER_CCDM_HOST_API_H

// What differs between MeshLab's versions, in one place. Macros where moc has to see a plain name. CMake says
// which of the two interfaces the host has: CCDM_HOST_API is 2020 (2020.09) or 2022 (2022.02 to 2025.07).
#if CCDM_HOST_API == 2020
#include <common/interfaces.h>
#define CCDM_FILTER_BASE MeshFilterInterface
#define CCDM_FILTER_IID MESH_FILTER_INTERFACE_IID
#define CCDM_ACTION QAction
#define CCDM_ARITY FILTER_ARITY
#define CCDM_ADVANCED
#elif CCDM_HOST_API == 2022
#include <common/mlexception.h>
#include <common/plugins/interfaces/filter_plugin.h>
#define CCDM_FILTER_BASE FilterPlugin
#define CCDM_FILTER_IID FILTER_PLUGIN_IID
#define CCDM_ACTION const QAction
#define CCDM_ARITY FilterArity
#define CCDM_ADVANCED , true // the last argument of a parameter that the dialog folds away
#else
#error "CCDM_HOST_API must be 2020 or 2022"
#endif

namespace filter_ccdm {

inline void DeleteLayer(MeshDocument &document, MeshModel &layer)
{
#if CCDM_HOST_API == 2020
    document.delMesh(&layer);
#else
    document.delMesh(static_cast<unsigned int>(layer.id()));
#endif
}

} // namespace filter_ccdm

#endif
