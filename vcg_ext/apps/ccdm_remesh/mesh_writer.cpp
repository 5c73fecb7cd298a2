// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>

#include "atomic_file.h"
#include "byte_order.h"
#include "mesh_io.h"

namespace ccdm_remesh {
namespace {

// Coordinates with as many digits as it takes to read the same numbers back.
class Text
{
public:
    std::string text;

    template <class Number>
    void Add(Number x)
    {
        std::array<char, 32> digits = {};
        text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr);
    }
    void Add(const char *prefix, const vcg::Point3d &p)
    {
        text += prefix;
        for (int k = 0; k < 3; ++k) {
            text += k == 0 ? "" : " ";
            Add(p[k]);
        }
        text += '\n';
    }
    void Add(const char *prefix, const Mesh &mesh, const Face &f, std::size_t first)
    {
        text += prefix;
        for (int k = 0; k < 3; ++k) {
            text += ' ';
            Add(vcg::tri::Index(mesh, f.cV(k)) + first);
        }
        text += '\n';
    }
};

std::string ToObj(const Mesh &mesh)
{
    Text t;
    t.text = "# " + Counted(mesh.VN(), "vertex", "vertices") + ", " + Counted(mesh.FN(), "face", "faces") + "\n";
    for (const Vertex &v : mesh.vert)
        t.Add("v ", v.cP());
    for (const Face &f : mesh.face)
        t.Add("f", mesh, f, 1);
    return t.text;
}

std::string ToOff(const Mesh &mesh)
{
    Text t;
    t.text = "OFF\n" + std::to_string(mesh.VN()) + " " + std::to_string(mesh.FN()) + " 0\n";
    for (const Vertex &v : mesh.vert)
        t.Add("", v.cP());
    for (const Face &f : mesh.face)
        t.Add("3", mesh, f, 0);
    return t.text;
}

std::string ToPly(const Mesh &mesh)
{
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.VN()) +
                        "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                        std::to_string(mesh.FN()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    bytes.reserve(bytes.size() + 24 * mesh.vert.size() + 13 * mesh.face.size());
    for (const Vertex &v : mesh.vert)
        for (int k = 0; k < 3; ++k)
            AppendLittleEndian(bytes, v.cP()[k]);
    for (const Face &f : mesh.face) {
        bytes += '\3';
        for (int k = 0; k < 3; ++k)
            AppendLittleEndian(bytes, static_cast<std::int32_t>(vcg::tri::Index(mesh, f.cV(k))));
    }
    return bytes;
}

std::string ToStl(const Mesh &mesh)
{
    std::string bytes = "ccdm_remesh";
    bytes.resize(80, ' ');
    bytes.reserve(84 + 50 * mesh.face.size());
    AppendLittleEndian(bytes, static_cast<std::uint32_t>(mesh.FN()));
    for (const Face &f : mesh.face) {
        const vcg::Point3d normal = vcg::TriangleNormal(f).Normalize();
        for (const vcg::Point3d &p : {normal, f.cP(0), f.cP(1), f.cP(2)})
            for (int k = 0; k < 3; ++k)
                AppendLittleEndian(bytes, static_cast<float>(p[k]));
        AppendLittleEndian(bytes, std::uint16_t(0));
    }
    return bytes;
}

// What single precision, and corners that are one vertex where they are at one place, would spoil; empty if nothing.
std::string FindStlFault(const Mesh &mesh)
{
    std::vector<vcg::Point3f> corner;
    for (const Vertex &v : mesh.vert)
        corner.push_back(vcg::Point3f::Construct(v.cP()));
    int collapsed = 0, joined = 0;
    for (const Face &f : mesh.face) {
        std::array<vcg::Point3d, 3> p;
        for (int k = 0; k < 3; ++k)
            p[k] = vcg::Point3d::Construct(corner[vcg::tri::Index(mesh, f.cV(k))]);
        const vcg::Point3d exact = vcg::TriangleNormal(f).Normalize();
        const vcg::Point3d single = ((p[1] - p[0]) ^ (p[2] - p[0])).Normalize();
        // Also false for infinities.
        collapsed += exact.SquaredNorm() > 0 && !(exact * single > 0);
    }
    std::sort(corner.begin(), corner.end());
    for (std::size_t k = 1; k < corner.size(); ++k)
        joined += corner[k] == corner[k - 1];
    if (collapsed == 0 && joined == 0)
        return "";
    return "STL has single precision and joins what is at one place, which would collapse or turn over " +
           Counted(collapsed, "triangle", "triangles") + " and join " + Counted(joined, "vertex", "vertices") +
           " to others; ply, off and obj keep the mesh";
}

std::string ContentOf(const std::string &extension, const Mesh &mesh)
{
    if (extension == "ply")
        return ToPly(mesh);
    if (extension == "off")
        return ToOff(mesh);
    return extension == "obj" ? ToObj(mesh) : ToStl(mesh);
}

} // namespace

std::string WriteMesh(const std::string &path, const Mesh &mesh)
{
    const std::string extension = ExtensionOf(path);
    const std::string spoilt = extension == "stl" ? FindStlFault(mesh) : "";
    return spoilt.empty() ? WriteAtomically(path, ContentOf(extension, mesh)) : spoilt;
}

} // namespace ccdm_remesh
