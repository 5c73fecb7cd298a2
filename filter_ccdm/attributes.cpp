// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

using vcg::ccdm::Provenance;
using vcg::ccdm::SurfacePoint;

namespace filter_ccdm {

namespace {

// Vertex normals are the user's own when more than one in a hundred differs by more than this from what the faces
// give; MeshLab has normals in every layer and does not say where they come from.
constexpr double OwnNormalDegrees = 5;

using Normals = std::vector<vcg::Point3d>;

// The vertex normals that the hosts compute, of any length. In most cases they weight the faces' with the angles, for
// a mesh of arrays with the areas; for a file with polygons they add up those that the faces have, which are then the
// polygons'.
std::array<Normals, 3> ComputedNormals(const Mesh &input, const Normals &ofFaces)
{
    const Normals null(input.vert.size(), vcg::Point3d(0, 0, 0));
    std::array<Normals, 3> computed = {VertexNormals(input), null, null};
    for (std::size_t i = 0; i < input.face.size(); ++i) {
        const Face &f = input.face[i];
        const vcg::Point3d across = (f.cP(1) - f.cP(0)) ^ (f.cP(2) - f.cP(0));
        for (int k = 0; k < 3; ++k) {
            const auto v = static_cast<std::size_t>(input.IndexOf(f, k));
            computed[1][v] += across;
            computed[2][v] += ofFaces[i];
        }
    }
    return computed;
}

bool AreOwn(const Normals &normals, const std::array<Normals, 3> &computed)
{
    const double limit = std::cos(OwnNormalDegrees * std::acos(-1.0) / 180);
    std::size_t different = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const vcg::Point3d &n = normals[i];
        // Unused vertices, and the null normals of a mesh whose normals were never computed.
        if (n.SquaredNorm() > 0 && computed[0][i].SquaredNorm() > 0)
            different += std::none_of(computed.begin(), computed.end(), [&](const Normals &way) {
                const double length = way[i].Norm() * n.Norm();
                return length > 0 && n * way[i] >= limit * length;
            });
    }
    return 100 * different > normals.size();
}

Column NormalColumn(const std::vector<vcg::Point3d> &normals)
{
    Column column;
    column.name = "vertex normals";
    column.blend = Blend::Direction;
    column.width = 3;
    for (const vcg::Point3d &n : normals)
        column.values.insert(column.values.end(), {n[0], n[1], n[2]});
    column.open = [](LayerContent &content) -> Column::Writer {
        return [&m = content.mesh](std::size_t i, const double *x) {
            m.vert[i].N().Import(vcg::Point3d(x[0], x[1], x[2]));
        };
    };
    return column;
}

bool AnyHas(const std::vector<int> &flags, int bits)
{
    return std::any_of(flags.begin(), flags.end(), [bits](int x) { return (x & bits) != 0; });
}

constexpr int AllFaux = CFaceO::FAUX0 | CFaceO::FAUX1 | CFaceO::FAUX2;
constexpr int AllSelectedEdges = CFaceO::FACEEDGESEL0 | CFaceO::FACEEDGESEL1 | CFaceO::FACEEDGESEL2;

} // namespace

AttributeCarrier::AttributeCarrier(const MeshModel &layer, const Mesh &input, const Settings &settings)
    : _input(input), _all(settings.keepAttributes || settings.engine.selectedFacesOnly),
      _partial(settings.engine.selectedFacesOnly), _userEdges(settings.engine.useMarkedEdges)
{
    if (!_all)
        return;
    _columns = ReadColumns(layer);
    if (layer.hasDataMask(MeshModel::MM_WEDGTEXCOORD) && layer.cm.face.IsWedgeTexCoordEnabled())
        _texture = WedgeTexture(layer.cm, input);
    ReadElements(layer.cm);
    if (AreOwn(_vertexNormals, ComputedNormals(input, _faceNormals)))
        _columns.ofVertices.push_back(NormalColumn(_vertexNormals));
    NameTheRest(layer);
}

void AttributeCarrier::ReadElements(const CMeshO &layer)
{
    for (const CVertexO &v : layer.vert)
        if (!v.IsD()) {
            _vertexFlags.push_back(v.cFlags());
            _vertexNormals.push_back(vcg::Point3d::Construct(v.cN()));
        }
    for (const CFaceO &f : layer.face)
        if (!f.IsD()) {
            _faceFlags.push_back(f.cFlags());
            _faceNormals.push_back(vcg::Point3d::Construct(f.cN()));
        }
}

void AttributeCarrier::NameTheRest(const MeshModel &layer)
{
    _notCarried = _columns.others;
    if (layer.hasDataMask(MeshModel::MM_VERTCURV))
        _notCarried << "curvature";
    if (layer.hasDataMask(MeshModel::MM_VERTCURVDIR | MeshModel::MM_FACECURVDIR))
        _notCarried << "curvature directions";
    const QString where = _partial ? " of the remeshed faces" : "";
    if (AnyHas(_faceFlags, AllFaux))
        _notCarried << "polygons" + where;
    if (AnyHas(_faceFlags, AllSelectedEdges))
        _notCarried << "edge selection" + where;
    if (layer.cm.en > 0)
        _notCarried << "edges";
}

void AttributeCarrier::MarkFeatures(Mesh &input, vcg::ccdm::Params &params)
{
    if (!_userEdges)
        for (Face &f : input.face)
            for (int k = 0; k < 3; ++k)
                f.ClearFaceEdgeS(k);
    const int seams = _texture.SeamCount(_input, _partial);
    if (seams == 0)
        return;
    // Every vertex where seams meet has to stay. Charts of a triangle each, for example, would keep all of the old
    // mesh; then the texture coordinates have to go.
    const int corners = _texture.SeamCorners(_input, _partial), budget = VertexBudget(_input, params);
    if (corners > budget / 2 && !_partial) {
        _notCarried << QString("texture coordinates per wedge (their seams meet in %1 vertices, too many for a mesh of "
                               "about %2)")
                           .arg(corners)
                           .arg(budget);
        _texture = WedgeTexture();
        return;
    }
    _texture.MarkSeams(input);
    params.useMarkedEdges = true;
    _notes << QString("%1 seam edges of the texture coordinates were kept as features").arg(seams);
}

bool AttributeCarrier::Any() const
{
    return _partial || !_columns.ofVertices.empty() || !_columns.ofFaces.empty() || !_texture.Empty() ||
           AnyHas(_vertexFlags, CVertexO::SELECTED) || AnyHas(_faceFlags, CFaceO::SELECTED);
}

void AttributeCarrier::Carry(const Provenance &provenance, const Mesh &result, LayerContent &content)
{
    if (!Any())
        return;
    CarryVertices(provenance, content);
    CarryFaces(provenance, content);
    if (!_texture.Empty())
        _crossed = _texture.Carry(provenance, _input, result, content);
    if (_partial)
        RestoreKept(provenance, result, content);
}

int AttributeCarrier::NearestVertex(const SurfacePoint &at) const
{
    const Face &f = _input.face[static_cast<std::size_t>(at.face)];
    return _input.IndexOf(f, static_cast<int>(std::max_element(at.weight, at.weight + 3) - at.weight));
}

void AttributeCarrier::Value(const Column &column, const Provenance &provenance, std::size_t vertex, double *to) const
{
    const int same = provenance.sameVertex[vertex];
    const SurfacePoint &at = provenance.vertex[vertex];
    if (same >= 0 || column.blend == Blend::Nearest) {
        const double *from = column.At(same >= 0 ? same : NearestVertex(at));
        std::copy(from, from + column.width, to);
        return;
    }
    std::fill(to, to + column.width, 0.0);
    const Face &f = _input.face[static_cast<std::size_t>(at.face)];
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < column.width && at.weight[k] != 0; ++i)
            to[i] += at.weight[k] * column.At(_input.IndexOf(f, k))[i];
    const double length = std::sqrt(std::inner_product(to, to + column.width, to, 0.0));
    for (int i = 0; i < column.width && column.blend == Blend::Direction && length > 0; ++i)
        to[i] /= length;
}

void AttributeCarrier::CarryVertices(const Provenance &provenance, LayerContent &content) const
{
    CMeshO &m = content.mesh;
    std::array<double, 4> numbers = {};
    for (const Column &column : _columns.ofVertices) {
        const Column::Writer write = column.open(content);
        for (std::size_t v = 0; v < m.vert.size(); ++v) {
            Value(column, provenance, v, numbers.data());
            write(v, numbers.data());
        }
    }
    for (std::size_t v = 0; v < m.vert.size(); ++v) {
        const int same = provenance.sameVertex[v];
        const SurfacePoint &at = provenance.vertex[v];
        if ((_vertexFlags[static_cast<std::size_t>(same >= 0 ? same : NearestVertex(at))] & CVertexO::SELECTED) != 0)
            m.vert[v].SetS();
    }
}

void AttributeCarrier::CarryFaces(const Provenance &provenance, LayerContent &content) const
{
    CMeshO &m = content.mesh;
    for (const Column &column : _columns.ofFaces) {
        const Column::Writer write = column.open(content);
        for (std::size_t f = 0; f < m.face.size(); ++f)
            write(f, column.At(provenance.face[f]));
    }
    for (std::size_t f = 0; f < m.face.size(); ++f)
        if ((_faceFlags[static_cast<std::size_t>(provenance.face[f])] & CFaceO::SELECTED) != 0)
            m.face[f].SetS();
}

// Flags and normals of what was not remeshed. A polygon that has lost a triangle to the remesher is a polygon no more:
// an edge inside of polygons stays one only where both of its faces are there still.
void AttributeCarrier::RestoreKept(const Provenance &provenance, const Mesh &result, LayerContent &content) const
{
    CMeshO &m = content.mesh;
    std::map<std::pair<int, int>, int> inside;
    const auto edge = [&](const Face &f, int k) {
        return std::minmax({result.IndexOf(f, k), result.IndexOf(f, (k + 1) % 3)});
    };
    const auto kept = static_cast<std::size_t>(provenance.keptFaces);
    for (std::size_t f = 0; f < kept; ++f) {
        const auto source = static_cast<std::size_t>(provenance.face[f]);
        m.face[f].Flags() = _faceFlags[source];
        m.face[f].N().Import(_faceNormals[source]);
        for (int k = 0; k < 3; ++k)
            if (m.face[f].IsF(k))
                ++inside[edge(result.face[f], k)];
    }
    for (std::size_t f = 0; f < kept && !inside.empty(); ++f)
        for (int k = 0; k < 3; ++k) {
            if (m.face[f].IsF(k) && inside[edge(result.face[f], k)] < 2)
                m.face[f].ClearF(k);
            if (m.face[f].IsF(k))
                content.mask |= MeshModel::MM_POLYGONAL;
        }

    std::vector<char> atNewFace(m.vert.size(), 0);
    for (std::size_t f = kept; f < m.face.size(); ++f)
        for (int k = 0; k < 3; ++k)
            atNewFace[static_cast<std::size_t>(result.IndexOf(result.face[f], k))] = 1;
    for (std::size_t v = 0; v < static_cast<std::size_t>(provenance.keptVertices); ++v) {
        const auto source = static_cast<std::size_t>(provenance.sameVertex[v]);
        m.vert[v].Flags() = _vertexFlags[source];
        if (atNewFace[v] == 0)
            m.vert[v].N().Import(_vertexNormals[source]);
    }
}

QStringList AttributeCarrier::Describe() const
{
    if (!_all)
        return {"carried: nothing, as asked for"};
    QStringList carried;
    for (const auto *columns : {&_columns.ofVertices, &_columns.ofFaces})
        for (const Column &column : *columns)
            if (!column.name.isEmpty())
                carried << column.name;
    if (AnyHas(_vertexFlags, CVertexO::SELECTED))
        carried << "vertex selection";
    if (AnyHas(_faceFlags, CFaceO::SELECTED))
        carried << "face selection";
    if (!_texture.Empty())
        carried << "texture coordinates per wedge";
    QStringList lines = {"carried: " + (carried.isEmpty() ? QString("nothing, there is nothing") : carried.join(", "))};
    if (!_notCarried.isEmpty())
        lines << "not carried: " + _notCarried.join(", ");
    lines << _notes;
    if (_crossed > 0)
        lines << QString("%1 triangles touch two charts of the texture, where seams bend or run close together within "
                         "the spacing; each continues the chart under its centroid")
                     .arg(_crossed);
    return lines;
}

void CopySettings(const MeshModel &from, MeshModel &to)
{
    to.cm.Tr = from.cm.Tr;
    to.cm.shot = from.cm.shot;
    if (!to.hasDataMask(MeshModel::MM_WEDGTEXCOORD | MeshModel::MM_VERTTEXCOORD))
        return;
    to.cm.textures = from.cm.textures;
    to.cm.normalmaps = from.cm.normalmaps;
#if CCDM_HOST_API != 2020
    for (const auto &[name, image] : from.getTextures())
        to.addTexture(name, image);
#endif
}

} // namespace filter_ccdm
