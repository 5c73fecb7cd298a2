// SPDX-License-Identifier: GPL-3.0-or-later
#include "attribute_columns.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace filter_ccdm {

namespace {

// Numbers of the live elements.
template <class Container, class Read>
std::vector<double> Gather(const Container &elements, int width, const Read &read)
{
    std::vector<double> values;
    values.reserve(elements.size() * static_cast<std::size_t>(width));
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (elements[i].IsD())
            continue;
        values.resize(values.size() + static_cast<std::size_t>(width));
        read(i, &values[values.size() - static_cast<std::size_t>(width)]);
    }
    return values;
}

void ReadColor(const vcg::Color4b &color, double *to)
{
    for (int k = 0; k < 4; ++k)
        to[k] = color[k];
}

vcg::Color4b ColorOf(const double *x)
{
    const auto byte = [](double c) { return static_cast<unsigned char>(std::lround(std::clamp(c, 0.0, 255.0))); };
    return vcg::Color4b(byte(x[0]), byte(x[1]), byte(x[2]), byte(x[3]));
}

void ReadVertexColumns(const MeshModel &layer, std::vector<Column> &columns)
{
    const auto &vert = layer.cm.vert;
    if (layer.hasDataMask(MeshModel::MM_VERTCOLOR))
        columns.push_back({"vertex colour", Blend::Linear, 4,
                           Gather(vert, 4, [&](std::size_t i, double *to) { ReadColor(vert[i].cC(), to); }),
                           [](LayerContent &content) -> Column::Writer {
                               content.mask |= MeshModel::MM_VERTCOLOR;
                               return
                                   [&m = content.mesh](std::size_t i, const double *x) { m.vert[i].C() = ColorOf(x); };
                           }});
    if (layer.hasDataMask(MeshModel::MM_VERTQUALITY))
        columns.push_back({"vertex quality", Blend::Linear, 1,
                           Gather(vert, 1, [&](std::size_t i, double *to) { *to = static_cast<double>(vert[i].cQ()); }),
                           [](LayerContent &content) -> Column::Writer {
                               content.mask |= MeshModel::MM_VERTQUALITY;
                               return [&m = content.mesh](std::size_t i, const double *x) {
                                   m.vert[i].Q() = static_cast<CVertexO::QualityType>(*x);
                               };
                           }});
    if (layer.hasDataMask(MeshModel::MM_VERTRADIUS) && vert.IsRadiusEnabled())
        columns.push_back({"vertex radius", Blend::Linear, 1,
                           Gather(vert, 1, [&](std::size_t i, double *to) { *to = static_cast<double>(vert[i].cR()); }),
                           [](LayerContent &content) -> Column::Writer {
                               content.mask |= MeshModel::MM_VERTRADIUS;
                               content.mesh.vert.EnableRadius();
                               return [&m = content.mesh](std::size_t i, const double *x) {
                                   m.vert[i].R() = static_cast<CVertexO::RadiusType>(*x);
                               };
                           }});
    if (!layer.hasDataMask(MeshModel::MM_VERTTEXCOORD) || !vert.IsTexCoordEnabled())
        return;
    columns.push_back({"texture coordinates per vertex", Blend::Linear, 2,
                       Gather(vert, 2,
                              [&](std::size_t i, double *to) {
                                  to[0] = vert[i].cT().U();
                                  to[1] = vert[i].cT().V();
                              }),
                       [](LayerContent &content) -> Column::Writer {
                           content.mask |= MeshModel::MM_VERTTEXCOORD;
                           content.mesh.vert.EnableTexCoord();
                           return [&m = content.mesh](std::size_t i, const double *x) {
                               m.vert[i].T().U() = static_cast<float>(x[0]);
                               m.vert[i].T().V() = static_cast<float>(x[1]);
                           };
                       }});
    columns.push_back(
        {"", Blend::Nearest, 1, Gather(vert, 1, [&](std::size_t i, double *to) { *to = vert[i].cT().N(); }),
         [](LayerContent &content) -> Column::Writer {
             return [&m = content.mesh](std::size_t i, const double *x) { m.vert[i].T().N() = static_cast<short>(*x); };
         }});
}

void ReadFaceColumns(const MeshModel &layer, std::vector<Column> &columns)
{
    const auto &face = layer.cm.face;
    if (layer.hasDataMask(MeshModel::MM_FACECOLOR) && face.IsColorEnabled())
        columns.push_back({"face colour", Blend::Nearest, 4,
                           Gather(face, 4, [&](std::size_t i, double *to) { ReadColor(face[i].cC(), to); }),
                           [](LayerContent &content) -> Column::Writer {
                               content.mask |= MeshModel::MM_FACECOLOR;
                               content.mesh.face.EnableColor();
                               return
                                   [&m = content.mesh](std::size_t i, const double *x) { m.face[i].C() = ColorOf(x); };
                           }});
    if (layer.hasDataMask(MeshModel::MM_FACEQUALITY) && face.IsQualityEnabled())
        columns.push_back({"face quality", Blend::Nearest, 1,
                           Gather(face, 1, [&](std::size_t i, double *to) { *to = static_cast<double>(face[i].cQ()); }),
                           [](LayerContent &content) -> Column::Writer {
                               content.mask |= MeshModel::MM_FACEQUALITY;
                               content.mesh.face.EnableQuality();
                               return [&m = content.mesh](std::size_t i, const double *x) {
                                   m.face[i].Q() = static_cast<CFaceO::QualityType>(*x);
                               };
                           }});
}

// A type of custom attributes as numbers.
template <class T>
struct Numbers {
    static constexpr int Width = 1;
    // Whole numbers may be labels.
    static constexpr Blend How = std::is_floating_point_v<T> ? Blend::Linear : Blend::Nearest;
    static void Read(const T &value, double *to) { *to = static_cast<double>(value); }
    static T From(const double *x) { return static_cast<T>(*x); }
};

template <class S>
struct Numbers<vcg::Point3<S>> {
    static constexpr int Width = 3;
    static constexpr Blend How = Blend::Linear;
    static void Read(const vcg::Point3<S> &value, double *to)
    {
        for (int k = 0; k < 3; ++k)
            to[k] = static_cast<double>(value[k]);
    }
    static vcg::Point3<S> From(const double *x)
    {
        return vcg::Point3<S>(static_cast<S>(x[0]), static_cast<S>(x[1]), static_cast<S>(x[2]));
    }
};

template <class T, bool OfVertices, class Container>
bool ReadIfA(const vcg::PointerToAttribute &attribute, const Container &elements, std::vector<Column> &columns)
{
    if (attribute._type != std::type_index(typeid(T)))
        return false;
    const vcg::SimpleTempDataBase &data = *attribute._handle;
    Column column;
    column.name = QString("custom attribute \"%1\"").arg(QString::fromStdString(attribute._name));
    column.blend = Numbers<T>::How;
    column.width = Numbers<T>::Width;
    column.values = Gather(elements, column.width, [&](std::size_t i, double *to) {
        Numbers<T>::Read(*static_cast<const T *>(data.At(i)), to);
    });
    column.open = [name = attribute._name](LayerContent &content) -> Column::Writer {
        if constexpr (OfVertices)
            return [&to = content.AddVertexAttribute<T>(name)](std::size_t i, const double *x) {
                to[i] = Numbers<T>::From(x);
            };
        else
            return [&to = content.AddFaceAttribute<T>(name)](std::size_t i, const double *x) {
                to[i] = Numbers<T>::From(x);
            };
    };
    columns.push_back(std::move(column));
    return true;
}

template <bool OfVertices, class Container>
void ReadCustom(const std::set<vcg::PointerToAttribute> &attributes, const Container &elements,
                std::vector<Column> &columns, QStringList &others)
{
    for (const vcg::PointerToAttribute &attribute : attributes) {
        if (attribute._name.empty())
            continue; // a filter's scratch data
        // Padded ones come from a file of another type size and are not read here.
        const bool read = attribute._padding == 0 && (ReadIfA<float, OfVertices>(attribute, elements, columns) ||
                                                      ReadIfA<double, OfVertices>(attribute, elements, columns) ||
                                                      ReadIfA<vcg::Point3f, OfVertices>(attribute, elements, columns) ||
                                                      ReadIfA<vcg::Point3d, OfVertices>(attribute, elements, columns) ||
                                                      ReadIfA<int, OfVertices>(attribute, elements, columns) ||
                                                      ReadIfA<short, OfVertices>(attribute, elements, columns) ||
                                                      ReadIfA<char, OfVertices>(attribute, elements, columns) ||
                                                      ReadIfA<unsigned char, OfVertices>(attribute, elements, columns));
        if (!read)
            others << QString("custom attribute \"%1\" (its type is not known)")
                          .arg(QString::fromStdString(attribute._name));
    }
}

} // namespace

Columns ReadColumns(const MeshModel &layer)
{
    Columns columns;
    ReadVertexColumns(layer, columns.ofVertices);
    ReadCustom<true>(layer.cm.vert_attr, layer.cm.vert, columns.ofVertices, columns.others);
    ReadFaceColumns(layer, columns.ofFaces);
    ReadCustom<false>(layer.cm.face_attr, layer.cm.face, columns.ofFaces, columns.others);
    return columns;
}

} // namespace filter_ccdm
