// SPDX-License-Identifier: GPL-3.0-or-later
#include "input_guard.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

namespace ccdm_remesh {
namespace {

// Size in bytes of a scalar PLY type; 0 if there is no such type.
std::uint64_t PlyTypeSize(const std::string &type)
{
    static const std::map<std::string, std::uint64_t> size = {
        {"char", 1},   {"int8", 1},    {"uchar", 1},  {"uint8", 1},  {"short", 2}, {"int16", 2},
        {"ushort", 2}, {"uint16", 2},  {"int", 4},    {"int32", 4},  {"uint", 4},  {"uint32", 4},
        {"float", 4},  {"float32", 4}, {"double", 8}, {"float64", 8}};
    const auto it = size.find(type);
    return it == size.end() ? 0 : it->second;
}

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::uint64_t leastBytes = 0; // a list counts as its length field alone
    bool coordinates[3] = {false, false, false};
    bool indices = false;
};

std::string CheckPlyCounts(const std::vector<PlyElement> &elements, std::uint64_t body)
{
    std::uint64_t least = 0;
    bool positions = false;
    for (const PlyElement &e : elements) {
        if (e.count > body || (e.count > 0 && e.leastBytes > body / e.count))
            return "the header promises more " + e.name + " elements than the file holds";
        least += e.count * e.leastBytes;
        if (e.name == "vertex")
            positions = e.coordinates[0] && e.coordinates[1] && e.coordinates[2];
        if (e.name == "face" && e.count > 0 && !e.indices)
            return "the faces have no vertex indices";
    }
    if (!positions)
        return "the vertices have no x, y and z";
    return least > body ? "the file is shorter than its header promises" : "";
}

std::string CheckPly(std::ifstream &in, std::uint64_t size)
{
    std::string line;
    if (!std::getline(in, line) || line.substr(0, 3) != "ply")
        return "it does not start with 'ply'";
    std::vector<PlyElement> elements;
    bool ascii = false;
    for (int lines = 0; std::getline(in, line); ++lines) {
        std::istringstream words(line);
        std::string word, type, name;
        words >> word;
        if (word == "end_header")
            return CheckPlyCounts(elements, size - static_cast<std::uint64_t>(in.tellg()));
        if (lines > 1000)
            break;
        if (word == "format") {
            words >> type;
            ascii = type == "ascii";
        } else if (word == "element") {
            PlyElement e;
            long long count = -1;
            words >> e.name >> count;
            if (count < 0 || count > INT32_MAX)
                return "the header gives a wrong number of " + e.name + " elements";
            e.count = static_cast<std::uint64_t>(count);
            elements.push_back(e);
        } else if (word == "property") {
            words >> type;
            const bool list = type == "list";
            std::string item;
            if (list)
                words >> type >> item;
            words >> name;
            if (elements.empty() || PlyTypeSize(type) == 0 || (list && PlyTypeSize(item) == 0))
                return "a property of the header cannot be understood: " + line;
            PlyElement &e = elements.back();
            // In text a value takes a digit and a separator.
            e.leastBytes += ascii ? 2 : PlyTypeSize(type);
            for (int k = 0; k < 3; ++k)
                e.coordinates[k] = e.coordinates[k] || (!list && name == std::string(1, static_cast<char>('x' + k)));
            e.indices = e.indices || (list && (name == "vertex_indices" || name == "vertex_index"));
        }
    }
    return "its header has no end";
}

// Next line that is neither empty nor a comment.
bool NextLine(std::ifstream &in, std::istringstream &words)
{
    std::string line;
    while (std::getline(in, line)) {
        line.erase(std::min(line.find('#'), line.size()));
        if (line.find_first_not_of(" \t\r") == std::string::npos)
            continue;
        words.clear();
        words.str(line);
        return true;
    }
    return false;
}

std::string CheckOff(std::ifstream &in, std::uint64_t size)
{
    std::istringstream words;
    std::string keyword;
    if (!NextLine(in, words) || !(words >> keyword) || keyword.find("OFF") == std::string::npos)
        return "it does not start with 'OFF'";
    long long vertices = -1, faces = -1, edges = 0;
    if (!(words >> vertices) && !(NextLine(in, words) && words >> vertices))
        return "it has no counts";
    if (!(words >> faces >> edges))
        return "it has no counts";
    // A vertex takes at least six characters, a face at least eight.
    if (vertices < 0 || faces < 0 || static_cast<std::uint64_t>(vertices) > size / 6 ||
        static_cast<std::uint64_t>(faces) > size / 8)
        return "the header promises more than the file holds";
    for (long long v = 0; v < vertices; ++v) {
        std::string x, y, z;
        if (!NextLine(in, words) || !(words >> x >> y >> z))
            return "vertex " + std::to_string(v) + " is missing or has fewer than three coordinates";
    }
    for (long long f = 0; f < faces; ++f) {
        long long corners = -1;
        if (!NextLine(in, words) || !(words >> corners) || corners < 1 || corners > vertices)
            return "face " + std::to_string(f) + " is missing or has a wrong number of corners";
        for (long long k = 0; k < corners; ++k) {
            long long v = -1;
            if (!(words >> v) || v < 0 || v >= vertices)
                return "face " + std::to_string(f) + " names a vertex that does not exist";
        }
    }
    return "";
}

std::string CheckStl(std::ifstream &in, std::uint64_t size)
{
    char head[84] = {};
    in.read(head, sizeof head);
    std::uint32_t triangles = 0;
    std::memcpy(&triangles, head + 80, 4);
    if (size >= 84 && size == 84 + 50ULL * triangles)
        return "";
    std::string start(head, head + 5);
    std::transform(start.begin(), start.end(), start.begin(), [](unsigned char c) { return std::tolower(c); });
    if (start != "solid")
        return "it is neither a text STL nor a binary one of the right length";
    in.clear();
    in.seekg(0);
    std::string word;
    int facets = 0, vertices = 0;
    while (in >> word) {
        facets += word == "facet";
        if (word != "vertex")
            continue;
        double x = 0, y = 0, z = 0;
        if (!(in >> x >> y >> z))
            return "vertex " + std::to_string(vertices) + " has a coordinate that is not a number";
        ++vertices;
    }
    if (facets == 0)
        return "it has no facets";
    return vertices == 3 * facets ? "" : "a facet has other than three vertices";
}

} // namespace

std::string FindFileFault(const std::string &path, const std::string &extension)
{
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    if (!in)
        return "it cannot be opened";
    const auto size = static_cast<std::int64_t>(in.tellg());
    in.seekg(0);
    char first = 0;
    if (size <= 0 || !in.get(first))
        return "it is empty or not a file";
    in.seekg(0);
    if (extension == "ply")
        return CheckPly(in, static_cast<std::uint64_t>(size));
    if (extension == "off")
        return CheckOff(in, static_cast<std::uint64_t>(size));
    return extension == "stl" ? CheckStl(in, static_cast<std::uint64_t>(size)) : "";
}

} // namespace ccdm_remesh
