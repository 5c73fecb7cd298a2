// SPDX-License-Identifier: GPL-3.0-or-later
// The one file with calls that a platform may lack.
#include "host_process.h"

#include <cstring>

#if defined(__unix__) || defined(__APPLE__)
#include <dlfcn.h>
#endif

namespace filter_ccdm {

bool IsPyMeshLab(vcg::CallBackPos *progress)
{
#if defined(__unix__) || defined(__APPLE__)
    // The module that the callback lives in: pmeshlab.cpython-311-x86_64-linux-gnu.so.
    Dl_info module = {};
    if (progress == nullptr || dladdr(reinterpret_cast<void *>(progress), &module) == 0 || module.dli_fname == nullptr)
        return false;
    const char *slash = std::strrchr(module.dli_fname, '/');
    const char *name = slash == nullptr ? module.dli_fname : slash + 1;
    return std::strncmp(name, "pmeshlab", std::strlen("pmeshlab")) == 0;
#else
    (void)progress;
    return false;
#endif
}

} // namespace filter_ccdm
