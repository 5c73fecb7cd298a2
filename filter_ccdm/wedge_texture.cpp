// SPDX-License-Identifier: GPL-3.0-or-later
#include "wedge_texture.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <vcg/complex/algorithms/ccdm/disjoint_sets.h>

using vcg::ccdm::SurfacePoint;

namespace filter_ccdm {

WedgeTexture::WedgeTexture(const CMeshO &layer, const Mesh &input)
{
    _wedges.reserve(input.face.size());
    for (const CFaceO &f : layer.face) {
        if (f.IsD())
            continue;
        std::array<Coordinates, 3> wedges;
        for (int k = 0; k < 3; ++k)
            wedges[static_cast<std::size_t>(k)] = {f.cWT(k).U(), f.cWT(k).V(), f.cWT(k).N()};
        _wedges.push_back(wedges);
    }
    FindCharts(input);
}

// Charts are the faces that hang together without a seam.
void WedgeTexture::FindCharts(const Mesh &input)
{
    double low = 0, high = 0;
    for (const auto &wedges : _wedges)
        for (const Coordinates &c : wedges)
            for (const double x : {c.u, c.v})
                if (std::isfinite(x)) {
                    low = std::min(low, x);
                    high = std::max(high, x);
                }
    // Exporters round; nobody sees a step of a hundred-thousandth of the texture.
    const double tolerance = 1e-5 * (high - low);
    const auto same = [&](const Coordinates &a, const Coordinates &b) {
        return a.texture == b.texture && std::abs(a.u - b.u) <= tolerance && std::abs(a.v - b.v) <= tolerance;
    };

    struct Use {
        int a, b; // vertices, a < b
        EdgeSide side;
    };
    std::vector<Use> use;
    use.reserve(3 * input.face.size());
    for (std::size_t f = 0; f < input.face.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto [a, b] =
                std::minmax({input.IndexOf(input.face[f], k), input.IndexOf(input.face[f], (k + 1) % 3)});
            use.push_back({a, b, {static_cast<int>(f), k}});
        }
    std::sort(use.begin(), use.end(), [](const Use &x, const Use &y) {
        return std::tie(x.a, x.b, x.side.face, x.side.edge) < std::tie(y.a, y.b, y.side.face, y.side.edge);
    });

    vcg::ccdm::DisjointSets charts(input.face.size());
    const auto wedge = [&](const EdgeSide &s, int vertex) {
        const int k =
            input.IndexOf(input.face[static_cast<std::size_t>(s.face)], s.edge) == vertex ? s.edge : (s.edge + 1) % 3;
        return _wedges[static_cast<std::size_t>(s.face)][static_cast<std::size_t>(k)];
    };
    for (std::size_t i = 1; i < use.size(); ++i) {
        const Use &x = use[i - 1], &y = use[i];
        if (x.a != y.a || x.b != y.b)
            continue;
        if (same(wedge(x.side, x.a), wedge(y.side, x.a)) && same(wedge(x.side, x.b), wedge(y.side, x.b)))
            charts.Join(x.side.face, y.side.face);
        else
            _seam.push_back({x.side, y.side});
    }
    _chart.resize(input.face.size());
    for (std::size_t f = 0; f < _chart.size(); ++f)
        _chart[f] = charts.SetOf(static_cast<int>(f));
}

bool WedgeTexture::IsRemeshed(const std::array<EdgeSide, 2> &sides, const Mesh &input, bool selectedOnly)
{
    return !selectedOnly || std::all_of(sides.begin(), sides.end(), [&](const EdgeSide &s) {
        return input.face[static_cast<std::size_t>(s.face)].IsS();
    });
}

int WedgeTexture::SeamCount(const Mesh &input, bool selectedOnly) const
{
    return static_cast<int>(std::count_if(_seam.begin(), _seam.end(), [&](const std::array<EdgeSide, 2> &sides) {
        return IsRemeshed(sides, input, selectedOnly);
    }));
}

int WedgeTexture::SeamCorners(const Mesh &input, bool selectedOnly) const
{
    std::vector<int> degree(input.vert.size(), 0);
    for (const auto &sides : _seam) {
        if (!IsRemeshed(sides, input, selectedOnly))
            continue;
        const Face &f = input.face[static_cast<std::size_t>(sides[0].face)];
        for (const int k : {sides[0].edge, (sides[0].edge + 1) % 3})
            ++degree[static_cast<std::size_t>(input.IndexOf(f, k))];
    }
    return static_cast<int>(std::count_if(degree.begin(), degree.end(), [](int d) { return d != 0 && d != 2; }));
}

void WedgeTexture::MarkSeams(Mesh &input) const
{
    for (const auto &sides : _seam)
        for (const EdgeSide &s : sides)
            input.face[static_cast<std::size_t>(s.face)].SetFaceEdgeS(s.edge);
}

WedgeTexture::Coordinates WedgeTexture::At(const SurfacePoint &p) const
{
    const auto &wedges = _wedges[static_cast<std::size_t>(p.face)];
    Coordinates c;
    c.texture = wedges[0].texture;
    for (std::size_t k = 0; k < 3; ++k)
        if (p.weight[k] != 0) {
            c.u += p.weight[k] * wedges[k].u;
            c.v += p.weight[k] * wedges[k].v;
        }
    return c;
}

// The coordinates of a face at a point beside it, as if the face went on.
WedgeTexture::Coordinates WedgeTexture::Continued(int face, const Mesh &input, const vcg::Point3d &p) const
{
    const Face &f = input.face[static_cast<std::size_t>(face)];
    const vcg::Point3d a = f.cP(1) - f.cP(0), b = f.cP(2) - f.cP(0), normal = a ^ b, d = p - f.cP(0);
    const double area = normal.SquaredNorm();
    SurfacePoint at;
    at.face = face;
    if (area > 0) {
        at.weight[1] = ((d ^ b) * normal) / area;
        at.weight[2] = ((a ^ d) * normal) / area;
        at.weight[0] = 1 - at.weight[1] - at.weight[2];
    }
    return At(at);
}

int WedgeTexture::Carry(const vcg::ccdm::Provenance &provenance, const Mesh &input, const Mesh &result,
                        LayerContent &content) const
{
    content.mask |= MeshModel::MM_WEDGTEXCOORD;
    content.mesh.face.EnableWedgeTexCoord();
    int crossed = 0;
    for (std::size_t f = 0; f < result.face.size(); ++f) {
        std::array<Coordinates, 3> wedges;
        const int under = provenance.face[f];
        if (static_cast<int>(f) < provenance.keptFaces) {
            wedges = _wedges[static_cast<std::size_t>(under)];
        } else {
            std::array<SurfacePoint, 3> at;
            for (int k = 0; k < 3; ++k)
                at[static_cast<std::size_t>(k)] =
                    provenance.Corner(static_cast<int>(f), k, result.IndexOf(result.face[f], k));
            const auto chart = [&](std::size_t k) { return _chart[static_cast<std::size_t>(at[k].face)]; };
            const bool whole = chart(0) == chart(1) && chart(1) == chart(2);
            crossed += !whole;
            for (std::size_t k = 0; k < 3; ++k)
                wedges[k] = whole ? At(at[k]) : Continued(under, input, result.face[f].cP(static_cast<int>(k)));
        }
        CFaceO &to = content.mesh.face[f];
        for (int k = 0; k < 3; ++k) {
            const Coordinates &c = wedges[static_cast<std::size_t>(k)];
            to.WT(k).U() = static_cast<float>(c.u);
            to.WT(k).V() = static_cast<float>(c.v);
            to.WT(k).N() = c.texture;
        }
    }
    return crossed;
}

} // namespace filter_ccdm
