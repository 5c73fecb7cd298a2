// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_REMESH_PLATFORM_H
#define CCDM_REMESH_PLATFORM_H

#include <cstdio>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace ccdm_remesh {

/// Whether a stream goes to a terminal.
inline bool IsTerminal(std::FILE *stream)
{
#ifdef _WIN32
    return _isatty(_fileno(stream)) != 0;
#else
    return isatty(fileno(stream)) != 0;
#endif
}

} // namespace ccdm_remesh

#endif
