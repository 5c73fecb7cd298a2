// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "polygon_soup.h"
#include "text_cursor.h"

namespace ccdm_remesh {
namespace {

// The next line that is neither empty nor a comment.
bool NextData(TextLines &lines, std::string &line)
{
    while (lines.Next(line)) {
        line.erase(std::min(line.find('#'), line.size()));
        if (line.find_first_not_of(" \t\r") != std::string::npos)
            return true;
    }
    return false;
}

TextCursor CursorOf(const std::string &line)
{
    return TextCursor(line.c_str(), line.c_str() + line.size());
}

} // namespace

std::string ReadOff(const std::string &content, PolygonSoup &soup)
{
    TextLines lines(content);
    std::string line;
    if (!NextData(lines, line))
        return "it does not start with 'OFF'";
    TextCursor words = CursorOf(line);
    // Texture coordinates, colours and normals come behind the coordinates.
    const std::string keyword = words.Word();
    const std::size_t prefix = keyword.size() < 3 ? std::string::npos : keyword.size() - 3;
    if (prefix == std::string::npos || keyword.substr(prefix) != "OFF" || keyword.find_first_not_of("STCN") < prefix)
        return "it does not start with 'OFF'";
    if (words.AtEnd()) {
        if (!NextData(lines, line))
            return "it has no counts";
        words = CursorOf(line);
    }
    int vertices = -1, faces = -1;
    if (!words.Integer(vertices) || !words.Integer(faces))
        return "it has no counts";
    // A vertex takes at least six characters, a face at least four.
    if (vertices < 0 || faces < 0 || static_cast<std::size_t>(vertices) > content.size() / 6 ||
        static_cast<std::size_t>(faces) > content.size() / 4)
        return "the header promises more than the file holds";
    soup.point.reserve(static_cast<std::size_t>(vertices));
    for (int v = 0; v < vertices; ++v) {
        vcg::Point3d p;
        bool found = NextData(lines, line);
        words = CursorOf(line);
        for (int k = 0; k < 3 && found; ++k)
            found = words.Number(p[k]);
        if (!found)
            return "vertex " + std::to_string(v) + " is missing or has fewer than three coordinates";
        soup.point.push_back(p);
    }
    for (int f = 0; f < faces; ++f) {
        int corners = -1;
        bool found = NextData(lines, line);
        words = CursorOf(line);
        if (!found || !words.Integer(corners) || corners < 0)
            return "face " + std::to_string(f) + " is missing or has a wrong number of corners";
        for (int k = 0; k < corners; ++k) {
            int v = -1;
            if (!words.Integer(v))
                return "face " + std::to_string(f) + " has fewer corners than it says";
            soup.corner.push_back(v);
        }
        // Points and edges are no part of the surface.
        if (corners < 3)
            soup.corner.resize(soup.corner.size() - static_cast<std::size_t>(corners));
        else
            soup.ClosePolygon();
    }
    return "";
}

} // namespace ccdm_remesh
