// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_CCDM_LAYER_CONTENT_H
#define FILTER_CCDM_LAYER_CONTENT_H

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "remesh_layer.h"

namespace filter_ccdm {

/// The new content of a layer, built beside the old one. Until Commit() the layer is as it was, and Commit()
/// allocates nothing, so there is no half-way state.
class LayerContent
{
public:
    /// Positions, faces, box and unit normals of `result`, for `target`.
    LayerContent(const Mesh &result, MeshModel &target);

    /// To be completed with optional components; each that is enabled is to be named in `mask`.
    CMeshO mesh;
    /// MeshModel's bits of the data that the content has beside positions, faces and normals.
    int mask = 0;

    /// A custom attribute of the new vertices, by their indices.
    template <class T>
    vcg::SimpleTempData<CMeshO::VertContainer, T> &AddVertexAttribute(const std::string &name)
    {
        return Add<T>(_ofVertices, _target.cm.vert, mesh.vert.size(), name);
    }

    /// The same for the new faces.
    template <class T>
    vcg::SimpleTempData<CMeshO::FaceContainer, T> &AddFaceAttribute(const std::string &name)
    {
        return Add<T>(_ofFaces, _target.cm.face, mesh.face.size(), name);
    }

    /// Puts the content into the layer. The layer keeps its name, its transform and its textures.
    void Commit() noexcept;

private:
    using Attributes = std::set<vcg::PointerToAttribute>;

    MeshModel &_target;
    Attributes _ofVertices, _ofFaces;
    std::vector<std::unique_ptr<vcg::SimpleTempDataBase>> _owned;

    // An attribute is tied to the container that it was made for, so it is made for the layer's from the start.
    template <class T, class Container>
    vcg::SimpleTempData<Container, T> &Add(Attributes &attributes, Container &container, std::size_t size,
                                           const std::string &name)
    {
        auto data = std::make_unique<vcg::SimpleTempData<Container, T>>(container);
        vcg::SimpleTempData<Container, T> &made = *data;
        made.Resize(size);
        vcg::PointerToAttribute entry;
        entry._handle = data.get();
        entry._name = name;
        entry._sizeof = sizeof(T);
        entry._padding = 0;
        entry._type = typeid(T);
        entry.n_attr = _target.cm.attrn + static_cast<int>(_owned.size()) + 1;
        _owned.push_back(std::move(data));
        attributes.insert(entry);
        return made;
    }

    static void Replace(Attributes &old, Attributes &fresh) noexcept;
};

} // namespace filter_ccdm

#endif
