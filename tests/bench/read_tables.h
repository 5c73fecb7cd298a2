// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_TESTS_BENCH_READ_TABLES_H
#define CCDM_TESTS_BENCH_READ_TABLES_H

#include <stdexcept>
#include <string>

#include <vcg/complex/algorithms/ccdm/input_mesh.h>

#include "mesh_io.h"

/// A mesh file as the core's tables; a std::runtime_error says why it cannot be.
inline vcg::ccdm::MeshTables ReadTables(const std::string &path, bool needsQuality)
{
    ccdm_remesh::Mesh mesh;
    const auto read = ccdm_remesh::ReadMesh(path, mesh);
    if (!read.fault.empty() || (needsQuality && !read.hasQuality))
        throw std::runtime_error(path + ": " + (read.fault.empty() ? "no value per vertex" : read.fault));
    vcg::ccdm::MeshTables tables;
    for (const auto &v : mesh.vert) {
        tables.position.push_back(v.cP());
        if (needsQuality)
            tables.field.push_back(static_cast<double>(v.cQ()));
    }
    const auto *first = mesh.vert.data();
    for (const auto &f : mesh.face)
        tables.face.push_back(
            {static_cast<int>(f.cV(0) - first), static_cast<int>(f.cV(1) - first), static_cast<int>(f.cV(2) - first)});
    return tables;
}

#endif
