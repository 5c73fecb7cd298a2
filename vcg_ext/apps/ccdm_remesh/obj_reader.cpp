// SPDX-License-Identifier: GPL-3.0-or-later
#include <climits>
#include <cstdlib>

#include "polygon_soup.h"
#include "text_cursor.h"

namespace ccdm_remesh {
namespace {

// Next line; a backslash at its end joins it with the one after it.
bool NextLine(TextLines &lines, std::string &line)
{
    if (!lines.Next(line))
        return false;
    std::string more;
    while (!line.empty() && line.back() == '\\' && lines.Next(more)) {
        line.back() = ' ';
        line += more;
    }
    return true;
}

// The first index of "v/t/n", from 1 or back from the last point; 0 if there is none.
long FirstIndex(const std::string &word)
{
    char *end = nullptr;
    const long index = std::strtol(word.c_str(), &end, 10);
    return *end == 0 || *end == '/' ? index : 0;
}

} // namespace

std::string ReadObj(const std::string &content, PolygonSoup &soup)
{
    TextLines lines(content);
    std::string line;
    while (NextLine(lines, line)) {
        const auto fault = [&](const char *what) { return "line " + std::to_string(lines.number) + " " + what; };
        TextCursor words(line.c_str(), line.c_str() + line.size());
        const std::string keyword = words.Word();
        if (keyword == "v") {
            vcg::Point3d p;
            for (int k = 0; k < 3; ++k)
                if (!words.Number(p[k]))
                    return fault("has fewer than three coordinates");
            if (soup.point.size() == INT_MAX)
                return "it has more vertices than can be numbered";
            soup.point.push_back(p);
        } else if (keyword == "f") {
            const std::size_t first = soup.corner.size();
            for (std::string word = words.Word(); !word.empty() && word[0] != '#'; word = words.Word()) {
                const long index = FirstIndex(word);
                if (index == 0)
                    return fault("has a face that cannot be understood");
                const long v = index > 0 ? index - 1 : static_cast<long>(soup.point.size()) + index;
                soup.corner.push_back(v < 0 || v > INT_MAX ? -1 : static_cast<int>(v));
            }
            if (soup.corner.size() < first + 3)
                return fault("has a face of fewer than three corners");
            soup.ClosePolygon();
        }
    }
    return soup.point.empty() ? "it has no vertices" : "";
}

} // namespace ccdm_remesh
