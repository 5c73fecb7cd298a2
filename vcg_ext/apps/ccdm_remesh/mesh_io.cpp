// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_io.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <exception>
#include <filesystem>
#include <fstream>

#include <vcg/complex/algorithms/clean.h>
#include <wrap/io_trimesh/export_off.h>
#include <wrap/io_trimesh/export_ply.h>
#include <wrap/io_trimesh/export_stl.h>

#include "polygon_soup.h"

namespace ccdm_remesh {
namespace {

namespace fs = std::filesystem;

std::string Counted(int n, const char *one, const char *many)
{
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

// The whole of a regular file; a device might have no end.
std::string Load(const std::string &path, std::string &content)
{
    std::error_code error;
    const auto size = fs::file_size(path, error);
    std::ifstream in(path, std::ios::binary);
    if (!in || !fs::exists(path))
        return "it cannot be opened";
    if (error || !fs::is_regular_file(path) || size == 0)
        return "it is empty or not a file";
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
    std::vector<std::array<double, 3>> corner;
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
        v->P() = vcg::Point3d(soup.point[k][0], soup.point[k][1], soup.point[k][2]);
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

// Coordinates with as many digits as it takes to read the same numbers back.
int ExportObj(const std::string &path, const Mesh &mesh)
{
    std::string text =
        "# " + Counted(mesh.VN(), "vertex", "vertices") + ", " + Counted(mesh.FN(), "face", "faces") + "\n";
    const auto add = [&](auto x) {
        std::array<char, 32> digits = {};
        text += ' ';
        text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr);
    };
    for (const Vertex &v : mesh.vert) {
        text += 'v';
        for (int k = 0; k < 3; ++k)
            add(v.cP()[k]);
        text += '\n';
    }
    for (const Face &f : mesh.face) {
        text += 'f';
        for (int k = 0; k < 3; ++k)
            add(vcg::tri::Index(mesh, f.cV(k)) + 1);
        text += '\n';
    }
    std::ofstream out(path, std::ios::binary);
    out << text;
    out.close();
    return out ? 0 : 1;
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

int Export(const std::string &path, const std::string &extension, Mesh &mesh)
{
    if (extension == "ply")
        return vcg::tri::io::ExporterPLY<Mesh>::Save(mesh, path.c_str(), true);
    if (extension == "off")
        return vcg::tri::io::ExporterOFF<Mesh>::Save(mesh, path.c_str());
    if (extension == "obj")
        return ExportObj(path, mesh);
    return vcg::tri::io::ExporterSTL<Mesh>::Save(mesh, path.c_str(), true);
}

// Least size in bytes of a complete file: the exporters do not see a full disk.
std::uintmax_t LeastSize(const std::string &extension, const Mesh &mesh)
{
    const auto v = static_cast<std::uintmax_t>(mesh.VN()), f = static_cast<std::uintmax_t>(mesh.FN());
    if (extension == "ply")
        return 24 * v + 13 * f;
    if (extension == "stl")
        return 84 + 50 * f;
    return 6 * v + 8 * f;
}

// Where a chain of symbolic links leads, even if there is no file yet.
fs::path Destination(fs::path path)
{
    std::error_code error;
    for (int k = 0; k < 40 && fs::is_symlink(path, error); ++k) {
        const fs::path next = fs::read_symlink(path, error);
        if (error)
            break;
        path = path.parent_path() / next;
    }
    return path;
}

bool IsDevice(const fs::path &path)
{
    std::error_code ignored;
    return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored) && !fs::is_directory(path, ignored);
}

// A name beside the target that is free. The extension stays, because exporters go by it.
fs::path TemporaryFor(const fs::path &target)
{
    for (int k = 0;; ++k) {
        const std::string name =
            "." + target.stem().string() + ".part" + std::to_string(k) + target.extension().string();
        fs::path temporary = target.parent_path() / name;
        std::error_code ignored;
        if (!fs::exists(temporary, ignored))
            return temporary;
    }
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

bool IsSameFile(const std::string &a, const std::string &b)
{
    std::error_code error;
    if (fs::equivalent(a, b, error))
        return true;
    const auto full = [&](const std::string &path) {
        return fs::weakly_canonical(fs::absolute(Destination(path), error), error);
    };
    const fs::path whole = full(a);
    return !whole.empty() && whole == full(b);
}

std::string FindWriteFault(const std::string &path)
{
    if (IsDevice(path))
        return "";
    const fs::path target = Destination(path);
    std::error_code ignored;
    if (fs::is_directory(target, ignored))
        return "it is a folder";
    const fs::path folder = target.parent_path().empty() ? "." : target.parent_path();
    if (!fs::is_directory(folder, ignored))
        return "its folder does not exist";
    const fs::path temporary = TemporaryFor(target);
    const bool made = static_cast<bool>(std::ofstream(temporary));
    fs::remove(temporary, ignored);
    return made ? "" : "no file can be made in its folder";
}

std::string WriteAtomically(const std::string &path, const std::function<std::string(const std::string &)> &write)
{
    const bool device = IsDevice(path);
    const fs::path target = device ? fs::path(path) : Destination(path);
    const fs::path temporary = device ? target : TemporaryFor(target);
    std::string fault;
    try {
        fault = write(temporary.string());
    } catch (const std::exception &e) {
        fault = e.what();
    }
    if (device)
        return fault;
    std::error_code error;
    if (fault.empty())
        fs::rename(temporary, target, error);
    if (error)
        fault = error.message();
    if (!fault.empty())
        fs::remove(temporary, error);
    return fault;
}

std::string WriteMesh(const std::string &path, Mesh &mesh)
{
    const std::string extension = ExtensionOf(path);
    std::string spoilt = extension == "stl" ? FindStlFault(mesh) : "";
    if (!spoilt.empty())
        return spoilt;
    return WriteAtomically(path, [&](const std::string &temporary) -> std::string {
        // Exporters fail without a reason where the file cannot be made.
        if (!std::ofstream(temporary))
            return "the file cannot be made there";
        if (Export(temporary, extension, mesh) != 0)
            return "the exporter failed";
        std::error_code error;
        const auto size = fs::file_size(temporary, error);
        return error || size < LeastSize(extension, mesh) ? "the file could not be written to its end" : "";
    });
}

} // namespace ccdm_remesh
