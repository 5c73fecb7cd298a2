// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_REMESH_MESH_IO_H
#define CCDM_REMESH_MESH_IO_H

#include <string>
#include <vector>

#include "mesh_type.h"

namespace ccdm_remesh {

/// Lower-case extension of a path without the dot.
std::string ExtensionOf(const std::string &path);

/// Whether files of this extension are read and written: ply, off, obj, stl.
bool IsMeshExtension(const std::string &extension);

/// "1 vertex", "2 vertices".
inline std::string Counted(int n, const char *one, const char *many)
{
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

struct ReadResult {
    std::string fault;              ///< why the file could not be read; empty when it was
    std::vector<std::string> notes; ///< what was done to the mesh on the way in
    bool hasQuality = false;        ///< the file has a value per vertex
};

/// Reads a mesh. Polygons are split into triangles; an STL's equal corners are joined.
ReadResult ReadMesh(const std::string &path, Mesh &mesh);

/// Writes a mesh in the format that the extension of `path` names; refuses STL, which has single precision,
/// for a mesh that this would spoil. Returns what went wrong, or an empty string.
std::string WriteMesh(const std::string &path, const Mesh &mesh);

} // namespace ccdm_remesh

#endif
