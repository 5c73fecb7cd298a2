// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_REMESH_POLYGON_SOUP_H
#define CCDM_REMESH_POLYGON_SOUP_H

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <vcg/space/point3.h>

namespace ccdm_remesh {

/// What a mesh file holds, before anything is made of it.
struct PolygonSoup {
    std::vector<vcg::Point3d> point;
    std::vector<double> quality;  ///< one for each point, or empty
    std::vector<int> corner;      ///< point indices of the polygons, one polygon after the other
    std::vector<std::size_t> end; ///< of each polygon in `corner`

    std::size_t PolygonCount() const { return end.size(); }
    std::size_t Begin(std::size_t polygon) const { return polygon == 0 ? 0 : end[polygon - 1]; }
    /// Closes a polygon of the corners that were added since the last one.
    void ClosePolygon() { end.push_back(corner.size()); }
};

/// Readers of a whole file's content, which is never trusted: what it holds takes memory, not what it promises.
/// Each returns what is wrong with it, or an empty string. Indices are checked by CheckIndices().
std::string ReadPly(const std::string &content, PolygonSoup &soup);
std::string ReadOff(const std::string &content, PolygonSoup &soup);
std::string ReadObj(const std::string &content, PolygonSoup &soup);
/// Every facet has points of its own.
std::string ReadStl(const std::string &content, PolygonSoup &soup);

/// Whether every polygon has three corners or more, all of them points.
std::string CheckIndices(const PolygonSoup &soup);

/// Splits a polygon, given by its corners' points, into triangles of places in it: ears are cut off, the one with
/// the largest smallest angle first, so that a polygon which is not convex is covered just once.
std::vector<std::array<int, 3>> SplitPolygon(const std::vector<vcg::Point3d> &corner);

} // namespace ccdm_remesh

#endif
