// SPDX-License-Identifier: GPL-3.0-or-later
#include "obj_reader.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <vector>

namespace ccdm_remesh {
namespace {

// Next word of a line as a number; false if it is none. Words end at blanks; `rest` moves behind it.
bool NextNumber(const char *&rest, double &x)
{
    char *end = nullptr;
    x = std::strtod(rest, &end);
    if (end == rest)
        return false;
    rest = end;
    return true;
}

const char *SkipBlanks(const char *p)
{
    while (*p == ' ' || *p == '\t' || *p == '\r')
        ++p;
    return p;
}

// Next line; a backslash at its end joins it with the one after it. `number` counts the lines of the file.
bool NextLine(std::ifstream &in, std::string &line, long long &number)
{
    if (!std::getline(in, line))
        return false;
    ++number;
    std::string more;
    for (;;) {
        if (!line.empty() && line.back() == '\r')
            line.pop_back();
        if (line.empty() || line.back() != '\\' || !std::getline(in, more))
            return true;
        ++number;
        line.back() = ' ';
        line += more;
    }
}

// The first index of "v/t/n", from 1 or back from the last vertex; what follows it is skipped.
bool NextIndex(const char *&rest, long long &index)
{
    char *end = nullptr;
    index = std::strtoll(rest, &end, 10);
    if (end == rest)
        return false;
    rest = end;
    while (*rest != 0 && *rest != ' ' && *rest != '\t' && *rest != '\r')
        ++rest;
    return true;
}

} // namespace

std::string ReadObj(const std::string &path, Mesh &mesh, int &fromPolygons)
{
    std::ifstream in(path);
    if (!in)
        return "it cannot be opened";
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<long long, 3>> faces;
    std::vector<long long> corners;
    std::string line;
    fromPolygons = 0;
    for (long long number = 0; NextLine(in, line, number);) {
        const auto fault = [&](const char *what) { return "line " + std::to_string(number) + " " + what; };
        const char *rest = SkipBlanks(line.c_str());
        const bool blank = rest[0] != 0 && (rest[1] == ' ' || rest[1] == '\t');
        if (blank && rest[0] == 'v') {
            ++rest;
            std::array<double, 3> p;
            for (double &x : p)
                if (!NextNumber(rest, x))
                    return fault("has fewer than three coordinates");
            points.push_back(p);
        } else if (blank && rest[0] == 'f') {
            corners.clear();
            for (rest = SkipBlanks(rest + 1); *rest != 0 && *rest != '#'; rest = SkipBlanks(rest)) {
                long long index = 0;
                if (!NextIndex(rest, index) || index == 0)
                    return fault("has a face that cannot be understood");
                corners.push_back(index > 0 ? index - 1 : static_cast<long long>(points.size()) + index);
            }
            if (corners.size() < 3)
                return fault("has a face of fewer than three corners");
            for (std::size_t k = 2; k < corners.size(); ++k)
                faces.push_back({corners[0], corners[k - 1], corners[k]});
            if (corners.size() > 3)
                fromPolygons += static_cast<int>(corners.size()) - 2;
        }
    }
    if (points.empty())
        return "it has no vertices";
    for (const auto &f : faces)
        for (const long long v : f)
            if (v < 0 || v >= static_cast<long long>(points.size()))
                return "a face names a vertex that does not exist";
    auto v = vcg::tri::Allocator<Mesh>::AddVertices(mesh, points.size());
    for (const auto &p : points) {
        v->P() = vcg::Point3d(p[0], p[1], p[2]);
        ++v;
    }
    auto f = vcg::tri::Allocator<Mesh>::AddFaces(mesh, faces.size());
    for (const auto &face : faces) {
        for (int k = 0; k < 3; ++k)
            f->V(k) = &mesh.vert[static_cast<std::size_t>(face[k])];
        ++f;
    }
    return "";
}

} // namespace ccdm_remesh
