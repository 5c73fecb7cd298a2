// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_CCDM_HOST_PROCESS_H
#define FILTER_CCDM_HOST_PROCESS_H

#include <cstring> // which vcglib's header leaves out

#include <wrap/callback.h>

namespace filter_ccdm {

/// Whether a progress callback is PyMeshLab's, which must not be called: it is shared by all of its threads
/// without a lock.
bool IsPyMeshLab(vcg::CallBackPos *progress);

} // namespace filter_ccdm

#endif
