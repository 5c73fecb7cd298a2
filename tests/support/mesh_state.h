// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_TESTS_SUPPORT_MESH_STATE_H
#define CCDM_TESTS_SUPPORT_MESH_STATE_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <vcg/complex/allocate.h>

/// Whether a mesh is as it was.
namespace mesh_state {

/// Every byte of the elements, and where they lie. Of meshes without optional components.
template <class MeshType>
std::string Bytes(const MeshType &m)
{
    const auto raw = [](const auto &elements) {
        const auto *data = elements.data();
        std::string bytes = std::to_string(reinterpret_cast<std::uintptr_t>(data));
        return bytes.append(reinterpret_cast<const char *>(data), elements.size() * sizeof(*data));
    };
    return raw(m.vert) + raw(m.face) + std::to_string(m.VN()) + " " + std::to_string(m.FN());
}

/// Positions and faces: what two results share that are equal.
struct Geometry {
    std::vector<std::array<double, 3>> position;
    std::vector<std::array<std::size_t, 3>> face;

    bool operator==(const Geometry &o) const { return position == o.position && face == o.face; }
};

template <class MeshType>
Geometry GeometryOf(const MeshType &m)
{
    Geometry g;
    for (const auto &v : m.vert)
        g.position.push_back({v.cP()[0], v.cP()[1], v.cP()[2]});
    for (const auto &f : m.face)
        g.face.push_back({vcg::tri::Index(m, f.cV(0)), vcg::tri::Index(m, f.cV(1)), vcg::tri::Index(m, f.cV(2))});
    return g;
}

} // namespace mesh_state

#endif
