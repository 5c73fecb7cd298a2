// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_io.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include <vcg/complex/algorithms/clean.h>

#include "polygon_soup.h"

namespace ccdm_remesh {
namespace {

namespace fs = std::filesystem;

// The whole of a regular file; a device might have no end.
std::string Load(const std::string &path, std::string &content)
{
    std::error_code error;
    if (fs::exists(path, error) && !fs::is_regular_file(path, error))
        return "it is not a file"; // to open a pipe may take for ever
    std::ifstream in(path, std::ios::binary);
    const auto size = fs::file_size(path, error);
    if (!in || error)
        return "it cannot be opened";
    if (size == 0)
        return "it is empty";
    content.resize(size);
    in.read(content.data(), static_cast<std::streamsize>(size));
    return in ? "" : "it cannot be read to its end";
}

std::string Parse(const std::string &extension, const std::string &content, PolygonSoup &soup)
{
    if (extension == "ply")
        return ReadPly(content, soup);
    if (extension == "off")
        return ReadOff(content, soup);
    return extension == "obj" ? ReadObj(content, soup) : ReadStl(content, soup);
}

// Polygons are split. Returns how many triangles come from those of more than three corners.
int Fill(const PolygonSoup &soup, Mesh &mesh)
{
    std::vector<std::array<int, 3>> triangle;
    std::vector<vcg::Point3d> corner;
    int fromPolygons = 0;
    for (std::size_t k = 0; k < soup.PolygonCount(); ++k) {
        const int *c = soup.corner.data() + soup.Begin(k), *end = soup.corner.data() + soup.end[k];
        if (end - c == 3) {
            triangle.push_back({c[0], c[1], c[2]});
            continue;
        }
        corner.clear();
        for (const int *at = c; at != end; ++at)
            corner.push_back(soup.point[*at]);
        for (const auto &t : SplitPolygon(corner)) {
            triangle.push_back({c[t[0]], c[t[1]], c[t[2]]});
            ++fromPolygons;
        }
    }
    auto v = vcg::tri::Allocator<Mesh>::AddVertices(mesh, soup.point.size());
    for (std::size_t k = 0; k < soup.point.size(); ++k, ++v) {
        v->P() = soup.point[k];
        if (!soup.quality.empty())
            v->Q() = static_cast<float>(soup.quality[k]);
    }
    auto f = vcg::tri::Allocator<Mesh>::AddFaces(mesh, triangle.size());
    for (const auto &t : triangle) {
        for (int k = 0; k < 3; ++k)
            f->V(k) = &mesh.vert[t[k]];
        ++f;
    }
    return fromPolygons;
}

} // namespace

std::string ExtensionOf(const std::string &path)
{
    std::string e = fs::path(path).extension().string();
    if (!e.empty())
        e.erase(0, 1);
    std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return std::tolower(c); });
    return e;
}

bool IsMeshExtension(const std::string &extension)
{
    return extension == "ply" || extension == "off" || extension == "obj" || extension == "stl";
}

ReadResult ReadMesh(const std::string &path, Mesh &mesh)
{
    ReadResult r;
    const std::string extension = ExtensionOf(path);
    if (!IsMeshExtension(extension)) {
        r.fault = "its format is not known (ply, off, obj and stl are)";
        return r;
    }
    PolygonSoup soup;
    std::string content;
    r.fault = Load(path, content);
    if (r.fault.empty())
        r.fault = Parse(extension, content, soup);
    if (r.fault.empty())
        r.fault = CheckIndices(soup);
    if (!r.fault.empty())
        return r;
    content = std::string();
    r.hasQuality = !soup.quality.empty();
    const int fromPolygons = Fill(soup, mesh);
    if (fromPolygons > 0)
        r.notes.push_back(Counted(fromPolygons, "triangle comes", "triangles come") + " from polygons that were split");
    if (extension == "stl")
        vcg::tri::Clean<Mesh>::RemoveDuplicateVertex(mesh);
    return r;
}

} // namespace ccdm_remesh
