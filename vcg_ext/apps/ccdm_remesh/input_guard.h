// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_REMESH_INPUT_GUARD_H
#define CCDM_REMESH_INPUT_GUARD_H

#include <string>

namespace ccdm_remesh {

/// Looks at a mesh file before vcglib's importer does, which trusts the counts in headers and some
/// indices. `extension` is lower case, without the dot: ply, off, stl, or another, of which only the
/// existence is looked at.
/// Returns what is wrong with the file, or an empty string.
std::string FindFileFault(const std::string &path, const std::string &extension);

} // namespace ccdm_remesh

#endif
