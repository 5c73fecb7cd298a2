// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_CCDM_HOST_API_H
#define FILTER_CCDM_HOST_API_H

// What differs between MeshLab's versions, in one place. Macros where moc has to see a plain name.
#include <common/interfaces.h>

#define CCDM_FILTER_BASE MeshFilterInterface
#define CCDM_FILTER_IID MESH_FILTER_INTERFACE_IID

#endif
