// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_REMESHING_H
#define VCG_CCDM_REMESHING_H

#include <algorithm>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include <vcg/complex/complex.h>

#include <vcg/complex/algorithms/ccdm/selection.h>

namespace vcg {
namespace tri {

/// Isotropic surface remeshing by constrained centroidal Delaunay meshes.
///
/// Takes any 2-manifold triangle mesh (any genus, with or without boundary, orientable or not,
/// self-intersecting or not) and gives a mesh of well-shaped triangles with the wanted number of
/// vertices, the same topology and the same sharp features. Its vertices lie on the input, unless
/// Params::approximation above 0.5 takes them off it.
/// Works on any vcg TriMesh type; no adjacency of it is used, and flags and quality only where the parameters ask for
/// them.
template <class MeshType>
class CCDMRemeshing
{
public:
    /// What a run is told.
    using Params = ccdm::Params;

    /// What a run achieved.
    using Report = ccdm::Report;

    /// Where on the input the elements of a result lie; faces and vertices of the input are named by their places in
    /// its vectors.
    using Provenance = ccdm::Provenance;

    /// Remeshes `input` into `output`, which is replaced when the status is Done and left alone
    /// otherwise. Read are positions, and, when the parameters ask for them, vertex quality
    /// (DensityKind::Quality), face-edge selection (useMarkedEdges) and face selection (selectedFacesOnly).
    /// Deleted elements are skipped. The output has positions and faces only: attributes are looked up on the
    /// input with `provenance`, which is filled when the status is Done and may be null.
    /// Where memory runs out, std::bad_alloc comes out, and output and provenance are left alone too.
    /// `progress` gets positions 0 to 100, never falling, and the phase's name; returning false cancels.
    static Report Do(const MeshType &input, MeshType &output, const Params &params, CallBackPos *progress = nullptr,
                     Provenance *provenance = nullptr)
    {
        const auto advance = [progress](int at, const char *phase) {
            return progress == nullptr || progress(at, phase);
        };
        ccdm::MeshTables result;
        Provenance of;
        Provenance *wanted = provenance == nullptr ? nullptr : &of;
        const ccdm::MeshTables tables = Import(input, params);
        Report report = params.selectedFacesOnly
                            ? ccdm::SelectionRemesher(params, advance).Run(tables, Selected(input), result, wanted)
                            : ccdm::TargetSearch(params, advance).Run(tables, result, wanted);
        if (report.status != ccdm::Status::Done)
            return report;
        if (provenance != nullptr)
            SkipDeleted(input, of);
        Export(result, output);
        if (provenance != nullptr)
            *provenance = std::move(of);
        return report;
    }

    /// Remeshes in place; the mesh is untouched unless the status is Done.
    static Report Do(MeshType &mesh, const Params &params, CallBackPos *progress = nullptr)
    {
        return Do(mesh, mesh, params, progress);
    }

private:
    using CoordType = typename MeshType::CoordType;
    using ScalarType = typename MeshType::ScalarType;

    // Of a vertex in the tables; -1 if it is deleted or none of the mesh's, which the remesher refuses.
    static int IndexOf(const MeshType &m, const typename MeshType::VertexType *v, const std::vector<int> &index)
    {
        const auto *first = m.vert.data();
        const std::less<> before; // the pointers may belong to different arrays
        return v == nullptr || before(v, first) || !before(v, first + m.vert.size()) ? -1 : index[v - first];
    }

    static ccdm::MeshTables Import(const MeshType &m, const Params &params)
    {
        ccdm::MeshTables tables;
        const bool field = params.density == ccdm::DensityKind::Quality && HasPerVertexQuality(m);
        std::vector<int> index(m.vert.size(), -1);
        for (std::size_t i = 0; i < m.vert.size(); ++i) {
            const auto &v = m.vert[i];
            if (v.IsD())
                continue;
            index[i] = static_cast<int>(tables.position.size());
            tables.position.push_back(ccdm::Point(v.cP()[0], v.cP()[1], v.cP()[2]));
            if (field)
                tables.field.push_back(static_cast<double>(v.cQ()));
        }
        for (const auto &f : m.face) {
            if (f.IsD())
                continue;
            std::array<int, 3> corner;
            unsigned bits = 0;
            for (int k = 0; k < 3; ++k) {
                corner[k] = IndexOf(m, f.cV(k), index);
                // vcg's edge k runs from corner k to the next: opposite the one after that.
                if (params.useMarkedEdges && f.IsFaceEdgeS(k))
                    bits |= 1U << ((k + 2) % 3);
            }
            tables.face.push_back(corner);
            if (params.useMarkedEdges)
                tables.marked.push_back(static_cast<std::uint8_t>(bits));
        }
        return tables;
    }

    static std::vector<char> Selected(const MeshType &m)
    {
        std::vector<char> selected;
        for (const auto &f : m.face)
            if (!f.IsD())
                selected.push_back(static_cast<char>(f.IsS()));
        return selected;
    }

    // From numbers that count live elements only.
    static void SkipDeleted(const MeshType &m, Provenance &p)
    {
        const auto live = [](const auto &elements) {
            std::vector<int> index;
            for (std::size_t i = 0; i < elements.size(); ++i)
                if (!elements[i].IsD())
                    index.push_back(static_cast<int>(i));
            return index;
        };
        const std::vector<int> vertex = live(m.vert), face = live(m.face);
        for (int &v : p.sameVertex)
            v = v < 0 ? v : vertex[v];
        for (int &f : p.face)
            f = face[f];
        for (ccdm::SurfacePoint &at : p.vertex)
            at.face = at.face < 0 ? at.face : face[at.face];
        for (Provenance::SideCorner &c : p.onSides)
            c.at.face = face[c.at.face];
    }

    // All that takes memory comes before the mesh is touched.
    static void Export(const ccdm::MeshTables &tables, MeshType &m)
    {
        auto vert = Like(m.vert, tables.position.size());
        auto face = Like(m.face, tables.face.size());
        for (std::size_t v = 0; v < vert.size(); ++v)
            for (int k = 0; k < 3; ++k)
                vert[v].P()[k] = static_cast<ScalarType>(tables.position[v][k]);
        for (std::size_t f = 0; f < face.size(); ++f)
            for (int k = 0; k < 3; ++k)
                face[f].V(k) = &vert[tables.face[f][k]];
        ResizeAll(m.vert_attr, std::max(m.vert.size(), vert.size()));
        ResizeAll(m.face_attr, std::max(m.face.size(), face.size()));

        m.Clear();
        Replace(m.vert, vert);
        Replace(m.face, face);
        m.vn = static_cast<int>(m.vert.size());
        m.fn = static_cast<int>(m.face.size());
        ResizeAll(m.vert_attr, m.vert.size());
        ResizeAll(m.face_attr, m.face.size());
    }

    // vcg's containers of optional components, whose elements know them.
    template <class Container, class = void>
    struct IsOptional : std::false_type {
    };
    template <class Container>
    struct IsOptional<Container, std::void_t<decltype(&Container::_updateOVP)>> : std::true_type {
    };

    // New elements, with the optional components that a container has enabled.
    template <class Container>
    static Container Like(const Container &old, std::size_t size)
    {
        if constexpr (IsOptional<Container>::value) {
            Container c(old);
            c.clear();
            c.resize(size);
            return c;
        } else {
            return Container(size);
        }
    }

    // The elements stay where they are.
    template <class Container>
    static void Replace(Container &old, Container &by)
    {
        old = std::move(by);
        if constexpr (IsOptional<Container>::value)
            old._updateOVP(old.begin(), old.end());
    }

    // Attributes that the caller has added.
    template <class Attributes>
    static void ResizeAll(const Attributes &attributes, std::size_t size)
    {
        for (const auto &a : attributes)
            a._handle->Resize(size);
    }
};

} // namespace tri
} // namespace vcg

#endif
