// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_CCDM_ATTRIBUTE_COLUMNS_H
#define FILTER_CCDM_ATTRIBUTE_COLUMNS_H

#include <cstddef>
#include <functional>
#include <vector>

#include <QString>
#include <QStringList>

#include "layer_content.h"

namespace filter_ccdm {

/// How the value of a vertex that lies on a face comes from those of the face's vertices.
enum class Blend {
    Linear,    ///< interpolated
    Direction, ///< interpolated and brought to unit length
    Nearest    ///< that of the vertex with the largest weight
};

/// One attribute of the vertices or of the faces of a layer: a copy, in double precision, which holds all that the
/// hosts' types can express.
struct Column {
    /// Stores the numbers of one element.
    using Writer = std::function<void(std::size_t element, const double *numbers)>;

    QString name; ///< for the log; empty: the one before says it
    Blend blend = Blend::Linear;
    int width = 1;              ///< numbers of an element
    std::vector<double> values; ///< `width` for each element of the layer that is not deleted, in order
    /// Makes room for the attribute in a layer's new content.
    std::function<Writer(LayerContent &content)> open;

    const double *At(int element) const { return &values[static_cast<std::size_t>(element) * width]; }
};

/// The attributes of a layer that are numbers. Not here: normals, flags, texture coordinates per wedge.
struct Columns {
    std::vector<Column> ofVertices, ofFaces;
    QStringList others; ///< attributes that cannot be carried
};

Columns ReadColumns(const MeshModel &layer);

} // namespace filter_ccdm

#endif
