// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_REMESH_OBJ_READER_H
#define CCDM_REMESH_OBJ_READER_H

#include <string>

#include "mesh_type.h"

namespace ccdm_remesh {

/// Reads the positions and faces of an OBJ file, polygons as fans (vcglib's importer of 2020.09 loses a
/// face of many files). `fromPolygons` counts the triangles that come from larger faces. Returns what is
/// wrong with the file, or an empty string.
std::string ReadObj(const std::string &path, Mesh &mesh, int &fromPolygons);

} // namespace ccdm_remesh

#endif
