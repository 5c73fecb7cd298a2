// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_REMESH_MESH_IO_H
#define CCDM_REMESH_MESH_IO_H

#include <functional>
#include <string>
#include <vector>

#include "mesh_type.h"

namespace ccdm_remesh {

/// Lower-case extension of a path without the dot.
std::string ExtensionOf(const std::string &path);

/// Whether files of this extension are read and written: ply, off, obj, stl.
bool IsMeshExtension(const std::string &extension);

struct ReadResult {
    std::string fault;              ///< why the file could not be read; empty when it was
    std::vector<std::string> notes; ///< what was done to the mesh on the way in
    bool hasQuality = false;        ///< the file has a value per vertex
};

/// Reads a mesh. Polygons are split into triangles; an STL's equal corners are joined.
ReadResult ReadMesh(const std::string &path, Mesh &mesh);

/// Whether two paths lead to one file, which need not be there yet.
bool IsSameFile(const std::string &a, const std::string &b);

/// Why no file can be written at `path`, as far as making one beside it tells; empty if one can. Nothing is left.
std::string FindWriteFault(const std::string &path);

/// Writes a file under a temporary name beside `path`, by `write(temporary path)`, and renames it when
/// that returns an empty string. A symbolic link stays and gets its target written; what is no regular file
/// (a device, a pipe) is written to as it is. Returns what went wrong, or an empty string; nothing is left
/// behind then.
std::string WriteAtomically(const std::string &path, const std::function<std::string(const std::string &)> &write);

/// Writes a mesh in the format that the extension of `path` names; refuses STL, which has single precision,
/// for a mesh that this would spoil. Returns what went wrong, or an empty string.
std::string WriteMesh(const std::string &path, Mesh &mesh);

} // namespace ccdm_remesh

#endif
