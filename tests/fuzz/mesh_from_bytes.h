// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_TESTS_FUZZ_MESH_FROM_BYTES_H
#define CCDM_TESTS_FUZZ_MESH_FROM_BYTES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <vcg/complex/algorithms/ccdm/input_mesh.h>

#include "fuzz/bytes.h"

/// Small meshes that are mostly sound surfaces of every kind, in awkward places and with a few faults.
namespace fuzz {

using vcg::ccdm::MeshTables;
using vcg::ccdm::Point;

/// A grid of quads whose opposite sides are glued straight, turned over, or not at all: a sheet, a cylinder, a
/// Moebius strip, a torus, a Klein bottle or a projective plane, with some quads left out.
inline void AddSheet(Bytes &in, MeshTables &m)
{
    const int nu = in.Between(1, 6), nv = in.Between(1, 6), gluing = in.Below(9), holes = in.Below(8);
    const int glueU = gluing % 3, glueV = gluing / 3, base = static_cast<int>(m.position.size());
    const auto vertex = [&](int i, int j) {
        if (i == nu && glueU > 0) {
            i = 0;
            j = glueU == 2 ? nv - j : j;
        }
        if (j == nv && glueV > 0) {
            j = 0;
            i = glueV == 2 ? (nu - i) % (glueU > 0 ? nu : nu + 1) : i;
        }
        return base + i * (nv + 1) + j;
    };
    for (int k = 0; k < (nu + 1) * (nv + 1); ++k)
        m.position.push_back(Point(k / (nv + 1), k % (nv + 1), 0));
    for (int i = 0; i < nu; ++i)
        for (int j = 0; j < nv; ++j) {
            if (holes > 4 && in.Below(holes) == 0)
                continue;
            const std::array<int, 4> q = {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)};
            if (in.Flag()) {
                m.face.push_back({q[0], q[1], q[2]});
                m.face.push_back({q[0], q[2], q[3]});
            } else {
                m.face.push_back({q[0], q[1], q[3]});
                m.face.push_back({q[1], q[2], q[3]});
            }
        }
}

/// A tetrahedron or an octahedron.
inline void AddSolid(Bytes &in, MeshTables &m)
{
    const int base = static_cast<int>(m.position.size());
    if (in.Flag()) {
        for (const auto &p : {Point(0, 0, 0), Point(4, 0, 0), Point(0, 4, 0), Point(0, 0, 4)})
            m.position.push_back(p);
        for (const auto &f : {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{1, 2, 3}, std::array{0, 3, 2}})
            m.face.push_back({base + f[0], base + f[1], base + f[2]});
        return;
    }
    for (int k = 0; k < 6; ++k) {
        Point p(2, 2, 2);
        p[k / 2] += k % 2 == 0 ? 2 : -2;
        m.position.push_back(p);
    }
    for (int x = 0; x < 2; ++x)
        for (int y = 2; y < 4; ++y)
            for (int z = 4; z < 6; ++z) {
                std::array<int, 3> f = {base + x, base + y, base + z};
                if ((x + y + z) % 2 != 0)
                    std::swap(f[1], f[2]);
                m.face.push_back(f);
            }
}

/// Divides a face at a vertex inside of it, or an edge of it and of its neighbours at a vertex on it.
inline void Divide(Bytes &in, MeshTables &m)
{
    if (m.face.empty())
        return;
    const std::array<int, 3> f = m.face[in.Next() % m.face.size()];
    const int v = static_cast<int>(m.position.size()), k = in.Below(4);
    if (k == 3) {
        m.position.push_back((m.position[f[0]] + m.position[f[1]] + m.position[f[2]]) / 3);
        const auto at = std::find(m.face.begin(), m.face.end(), f);
        *at = {f[0], f[1], v};
        m.face.push_back({f[1], f[2], v});
        m.face.push_back({f[2], f[0], v});
        return;
    }
    const int a = f[k], b = f[(k + 1) % 3];
    m.position.push_back((m.position[a] + m.position[b]) / 2);
    const std::size_t before = m.face.size();
    for (std::size_t t = 0; t < before; ++t)
        for (int i = 0; i < 3; ++i) {
            std::array<int, 3> &g = m.face[t];
            if (!((g[i] == a && g[(i + 1) % 3] == b) || (g[i] == b && g[(i + 1) % 3] == a)))
                continue;
            std::array<int, 3> other = g;
            other[i] = v;
            g[(i + 1) % 3] = v;
            m.face.push_back(other);
            break;
        }
}

/// Spoils something, or just moves a vertex on the grid, which makes folds, needles and coincidences.
inline void Disturb(Bytes &in, MeshTables &m)
{
    if (m.face.empty())
        return;
    auto anyVertex = [&] { return static_cast<int>(in.Next() % m.position.size()); };
    std::array<int, 3> &face = m.face[in.Next() % m.face.size()];
    switch (in.Below(16)) {
    case 0:
        std::swap(face[0], face[1]);
        break;
    case 1:
        m.face.push_back(face);
        break;
    case 2:
        face[in.Below(3)] = anyVertex();
        break;
    case 3: {
        const int a = anyVertex(), b = anyVertex();
        for (auto &f : m.face)
            std::replace(f.begin(), f.end(), a, b);
        break;
    }
    case 4:
        m.position[anyVertex()] = m.position[anyVertex()];
        break;
    case 5: {
        // A copy of a corner: the seam of a mesh that is to be sewn together.
        int &corner = face[in.Below(3)];
        m.position.push_back(Point(m.position[corner]));
        corner = static_cast<int>(m.position.size()) - 1;
        break;
    }
    case 6:
        m.face.erase(m.face.begin() + in.Next() % static_cast<int>(m.face.size()));
        break;
    case 7:
        m.position[anyVertex()][in.Below(3)] += std::ldexp(1.0, -in.Below(60));
        break;
    case 8:
        Divide(in, m);
        break;
    case 9:
        if (in.Below(16) == 0)
            m.position[anyVertex()][0] = in.Flag() ? std::numeric_limits<double>::quiet_NaN() : 1e300;
        break;
    default:
        m.position[anyVertex()] = Point(in.Below(8), in.Below(8), in.Below(8));
    }
}

/// At most a few hundred faces.
inline MeshTables MeshFromBytes(Bytes &in)
{
    MeshTables m;
    for (int parts = in.Below(8) == 0 ? 2 : 1; parts > 0; --parts)
        in.Below(3) == 0 ? AddSolid(in, m) : AddSheet(in, m);
    const int placing = in.Below(4);
    for (Point &p : m.position)
        if (placing == 0)
            p = Point(in.Below(8), in.Below(8), in.Below(8));
        else if (placing == 1)
            p[2] = in.Below(8);
        else if (placing == 2 && in.Below(4) == 0)
            p[in.Below(3)] += in.Below(3) - 1;
    for (int steps = in.Below(24); steps > 0 && !in.Empty(); --steps)
        in.Below(3) == 0 ? Divide(in, m) : Disturb(in, m);
    const int scale = in.Below(8);
    for (Point &p : m.position)
        p = scale == 0 ? p * 1e-9 : scale == 1 ? p + Point(1e7, 1e7, 1e7) : p;
    return m;
}

} // namespace fuzz

#endif
