// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_io.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>

#include <vcg/complex/algorithms/clean.h>
#include <wrap/io_trimesh/export_obj.h>
#include <wrap/io_trimesh/export_off.h>
#include <wrap/io_trimesh/export_ply.h>
#include <wrap/io_trimesh/export_stl.h>
#include <wrap/io_trimesh/import.h>

#include "input_guard.h"
#include "obj_reader.h"

namespace ccdm_remesh {
namespace {

namespace fs = std::filesystem;
using vcg::tri::io::Mask;

std::string Counted(int n, const char *one, const char *many)
{
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

// vcglib marks the diagonals of split polygons; the marks are of no use here.
int ClearPolygonMarks(Mesh &mesh)
{
    int marked = 0;
    for (Face &f : mesh.face) {
        bool any = false;
        for (int k = 0; k < 3; ++k) {
            any = any || f.IsF(k);
            f.ClearF(k);
        }
        marked += any;
    }
    return marked;
}

bool PointsIntoMesh(const Mesh &mesh)
{
    const Vertex *first = mesh.vert.data(), *last = first + mesh.vert.size();
    const auto inside = [&](const Vertex *v) { return v >= first && v < last; };
    return std::all_of(mesh.face.begin(), mesh.face.end(),
                       [&](const Face &f) { return inside(f.cV(0)) && inside(f.cV(1)) && inside(f.cV(2)); });
}

// By vcglib's importers. Returns what went wrong, or an empty string.
std::string Import(const std::string &path, Mesh &mesh, int &mask)
{
    using Importer = vcg::tri::io::Importer<Mesh>;
    const int error = Importer::Open(mesh, path.c_str(), mask);
    return error != 0 && Importer::ErrorCritical(error) ? Importer::ErrorMsg(error) : "";
}

int Export(const std::string &path, const std::string &extension, Mesh &mesh)
{
    if (extension == "ply")
        return vcg::tri::io::ExporterPLY<Mesh>::Save(mesh, path.c_str(), true);
    if (extension == "off")
        return vcg::tri::io::ExporterOFF<Mesh>::Save(mesh, path.c_str());
    if (extension == "obj")
        return vcg::tri::io::ExporterOBJ<Mesh>::Save(mesh, path.c_str(), 0);
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
    r.fault = FindFileFault(path, extension);
    if (!r.fault.empty())
        return r;
    int fromPolygons = 0, mask = 0;
    try {
        r.fault = extension == "obj" ? ReadObj(path, mesh, fromPolygons) : Import(path, mesh, mask);
    } catch (const std::exception &e) {
        r.fault = e.what();
    }
    if (!r.fault.empty())
        return r;
    if (!PointsIntoMesh(mesh)) {
        r.fault = "a face names a vertex that does not exist";
        return r;
    }
    r.hasQuality = (mask & Mask::IOM_VERTQUALITY) != 0;
    fromPolygons += ClearPolygonMarks(mesh);
    if (fromPolygons > 0)
        r.notes.push_back(Counted(fromPolygons, "triangle comes", "triangles come") + " from polygons that were split");
    if (extension == "stl")
        vcg::tri::Clean<Mesh>::RemoveDuplicateVertex(mesh);
    return r;
}

std::string WriteAtomically(const std::string &path, const std::function<std::string(const std::string &)> &write)
{
    const fs::path target(path);
    // The extension stays, because exporters go by it.
    fs::path temporary = target.parent_path();
    for (int k = 0;; ++k) {
        const std::string name =
            "." + target.stem().string() + ".part" + std::to_string(k) + target.extension().string();
        temporary = target.parent_path() / name;
        std::error_code ignored;
        if (!fs::exists(temporary, ignored))
            break;
    }
    std::string fault;
    try {
        fault = write(temporary.string());
    } catch (const std::exception &e) {
        fault = e.what();
    }
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
