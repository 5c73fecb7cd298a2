// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>

#include "byte_order.h"
#include "polygon_soup.h"
#include "text_cursor.h"

namespace ccdm_remesh {
namespace {

constexpr std::size_t HeaderSize = 84, FacetSize = 50;

void AddCorner(PolygonSoup &soup, const vcg::Point3d &p)
{
    soup.corner.push_back(static_cast<int>(soup.point.size()));
    soup.point.push_back(p);
}

std::string ReadBinary(const std::string &content, std::size_t facets, PolygonSoup &soup)
{
    // Three indices for each facet.
    if (facets > INT32_MAX / 3)
        return "it has more facets than can be numbered";
    for (std::size_t f = 0; f < facets; ++f) {
        const char *at = content.data() + HeaderSize + f * FacetSize + 12; // behind the normal
        for (int k = 0; k < 3; ++k, at += 12)
            AddCorner(soup,
                      {FromLittleEndian<float>(at), FromLittleEndian<float>(at + 4), FromLittleEndian<float>(at + 8)});
        soup.ClosePolygon();
    }
    return "";
}

std::string ReadText(const std::string &content, PolygonSoup &soup)
{
    TextCursor words(content.c_str(), content.c_str() + content.size());
    std::size_t facets = 0;
    while (!words.AtEnd()) {
        const std::string word = words.Word();
        facets += word == "facet";
        if (word == "vertex") {
            vcg::Point3d p;
            for (int k = 0; k < 3; ++k)
                if (!words.Number(p[k]))
                    return "vertex " + std::to_string(soup.point.size()) + " has a coordinate that is not a number";
            AddCorner(soup, p);
        } else if (word == "endloop") {
            if (soup.corner.size() != 3 * (soup.PolygonCount() + 1))
                return "a facet has other than three vertices";
            soup.ClosePolygon();
        }
    }
    if (facets == 0)
        return "it has no facets";
    return soup.PolygonCount() == facets && soup.corner.size() == 3 * facets ? "" : "its last facet has no end";
}

} // namespace

std::string ReadStl(const std::string &content, PolygonSoup &soup)
{
    // The length tells, as a binary file may begin with "solid" too.
    if (content.size() >= HeaderSize) {
        const std::size_t facets = FromLittleEndian<std::uint32_t>(content.data() + HeaderSize - 4);
        if (content.size() == HeaderSize + FacetSize * facets)
            return ReadBinary(content, facets, soup);
    }
    std::string start = content.substr(0, 5);
    std::transform(start.begin(), start.end(), start.begin(), [](unsigned char c) { return std::tolower(c); });
    return start == "solid" ? ReadText(content, soup) : "it is neither a text STL nor a binary one of the right length";
}

} // namespace ccdm_remesh
