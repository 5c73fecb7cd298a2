// SPDX-License-Identifier: GPL-3.0-or-later
// make_sample_meshes DIR [--large]: writes the sample meshes as binary PLY with single-precision positions.
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string>

#include "support/shapes.h"

namespace {

bool Write(const std::string &path, const shapes::Shape &s)
{
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(s.points.size()) +
                        "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                        std::to_string(s.faces.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    const auto append = [&](const void *data, std::size_t size) {
        bytes.append(static_cast<const char *>(data), size);
    };
    for (const shapes::P &p : s.points)
        for (const double x : p) {
            // Rounded to a grid far finer than any detail, so that the last bit of a sine does not show.
            const auto value = static_cast<float>(std::round(x * 65536) / 65536);
            append(&value, sizeof value);
        }
    for (const shapes::F &f : s.faces) {
        bytes.push_back(3);
        for (const int v : f)
            append(&v, sizeof v);
    }
    std::ofstream out(path, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out)
        std::cerr << "make_sample_meshes: " << path << " could not be written\n";
    return static_cast<bool>(out);
}

} // namespace

int main(int argc, char **argv)
{
    if (argc < 2 || argc > 3 || (argc == 3 && std::strcmp(argv[2], "--large") != 0)) {
        std::cerr << "usage: make_sample_meshes DIR [--large]\n";
        return 2;
    }
    const std::string dir = std::string(argv[1]) + "/";
    if (argc == 3)
        return Write(dir + "bumpy_large.ply", shapes::Bumpy(6)) ? 0 : 1;
    const bool done = Write(dir + "sphere.ply", shapes::Sphere(4)) && Write(dir + "bumpy.ply", shapes::Bumpy(5)) &&
                      Write(dir + "high_genus.ply", shapes::HighGenus(3)) &&
                      Write(dir + "cad_part.ply", shapes::CadPart()) &&
                      Write(dir + "twisted_bar.ply", shapes::TwistedBar(80, 3)) &&
                      Write(dir + "plate.ply", shapes::Plate(48)) && Write(dir + "bust.ply", shapes::Bust(5, 0.012)) &&
                      Write(dir + "klein_bottle.ply", shapes::KleinBottle(80, 48)) &&
                      Write(dir + "two_components.ply", shapes::TwoComponents());
    return done ? 0 : 1;
}
