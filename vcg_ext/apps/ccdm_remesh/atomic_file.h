// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_REMESH_ATOMIC_FILE_H
#define CCDM_REMESH_ATOMIC_FILE_H

#include <string>

namespace ccdm_remesh {

/// Whether two paths lead to one file, which need not be there yet.
bool IsSameFile(const std::string &a, const std::string &b);

/// Why no file can be written at `path`, as far as making one beside it tells; empty if one can. Nothing is left.
std::string FindWriteFault(const std::string &path);

/// Writes a file under a temporary name beside `path`, and renames it when it is complete. A symbolic link stays and
/// gets its target written; what is no regular file (a device, a pipe) is written to as it is. Returns what went
/// wrong, or an empty string; nothing is left behind then.
std::string WriteAtomically(const std::string &path, const std::string &content);

} // namespace ccdm_remesh

#endif
