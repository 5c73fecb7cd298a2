// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_REMESH_PLATFORM_H
#define CCDM_REMESH_PLATFORM_H

#include <csignal>
#include <cstdio>

#ifdef _WIN32
#include <io.h>
#else
#include <fcntl.h>
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

/// Opens the standard streams that the caller has closed: else the next file to be opened takes the place of one, and
/// gets what is printed.
inline void OpenStandardStreams()
{
#ifndef _WIN32
    // Each takes the lowest number that is free.
    int file = 0;
    while (file >= 0 && file <= STDERR_FILENO)
        file = open("/dev/null", O_RDWR);
    if (file >= 0)
        close(file);
#endif
}

/// Has `stop` called where the run is asked to end, except for signals that the caller ignores. What cannot be written
/// is told to the one who writes, and ends nothing.
inline void CatchSignals(void (*stop)(int))
{
    const auto catchOne = [stop](int s) {
        if (std::signal(s, stop) == SIG_IGN)
            std::signal(s, SIG_IGN);
    };
    catchOne(SIGINT);
    catchOne(SIGTERM);
#ifndef _WIN32
    catchOne(SIGHUP);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
#endif
}

} // namespace ccdm_remesh

#endif
