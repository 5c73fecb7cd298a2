// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes as a mesh file; the first one is the format's. Read, written and read again; remeshed in between.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include <vcg/complex/algorithms/ccdm_remeshing.h>

#include "fuzz/targets.h"
#include "mesh_io.h"

namespace fuzz {
namespace {

using ccdm_remesh::Mesh;

// A file of this process, in memory where there is such a file system.
class ScratchFile
{
public:
    explicit ScratchFile(const char *extension)
    {
        static const std::string folder = std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : "/tmp";
        path = folder + "/ccdm_fuzz_" + std::to_string(getpid()) + "." + extension;
    }
    ~ScratchFile() { std::remove(path.c_str()); }
    ScratchFile(const ScratchFile &) = delete;
    ScratchFile &operator=(const ScratchFile &) = delete;

    std::string path;
};

// The writers are for results of the remesher.
bool IsFinite(const Mesh &mesh)
{
    return std::all_of(mesh.vert.begin(), mesh.vert.end(), [](const ccdm_remesh::Vertex &v) {
        return std::isfinite(v.cP()[0]) && std::isfinite(v.cP()[1]) && std::isfinite(v.cP()[2]);
    });
}

// Written and read again, a mesh is the same.
void GoThereAndBack(const Mesh &mesh, const char *extension)
{
    const ScratchFile file(extension);
    const std::string fault = ccdm_remesh::WriteMesh(file.path, mesh);
    const bool single = std::strcmp(extension, "stl") == 0; // has neither numbers nor double precision
    if (!fault.empty()) {
        Expect(single, "a mesh could not be written");
        return;
    }
    Mesh again;
    Expect(ccdm_remesh::ReadMesh(file.path, again).fault.empty(), "a written file could not be read");
    Expect(again.FN() == mesh.FN(), "faces were lost in a file");
    Expect(single || again.VN() == mesh.VN(), "vertices were lost in a file");
    for (int v = 0; v < mesh.VN() && !single && std::strcmp(extension, "off") != 0; ++v)
        Expect(again.vert[v].cP() == mesh.vert[v].cP(), "a coordinate changed in a file");
}

// Calls use(mesh, extension) if the bytes are a file that can be read and has faces.
template <class Use>
void ReadBytes(const std::uint8_t *data, std::size_t size, const Use &use)
{
    if (size == 0)
        return;
    constexpr const char *extensions[] = {"ply", "off", "obj", "stl"};
    const char *extension = extensions[data[0] % 4];
    const ScratchFile file(extension);
    std::ofstream(file.path, std::ios::binary)
        .write(reinterpret_cast<const char *>(data + 1), static_cast<std::streamsize>(size - 1));
    Mesh mesh;
    if (ccdm_remesh::ReadMesh(file.path, mesh).fault.empty() && mesh.FN() > 0)
        use(mesh, extension);
}

} // namespace

void RunReaders(const std::uint8_t *data, std::size_t size)
{
    ReadBytes(data, size, [](const Mesh &mesh, const char *extension) {
        if (IsFinite(mesh))
            GoThereAndBack(mesh, extension);
    });
}

void RunFile(const std::uint8_t *data, std::size_t size)
{
    ReadBytes(data, size, [&](const Mesh &mesh, const char *extension) {
        vcg::ccdm::Params params;
        params.vertexCount = 4 + data[0] / 16;
        params.globalIterations = 0;
        params.threads = 1;
        Mesh result;
        const vcg::ccdm::Report report = vcg::tri::CCDMRemeshing<Mesh>::Do(mesh, result, params);
        Expect(report.status == vcg::ccdm::Status::Done || !report.message.empty(), "a refusal without a reason");
        if (report.status == vcg::ccdm::Status::Done)
            GoThereAndBack(result, extension);
    });
}

} // namespace fuzz
