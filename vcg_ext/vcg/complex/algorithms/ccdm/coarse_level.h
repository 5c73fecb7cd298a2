// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_COARSE_LEVEL_H
#define VCG_CCDM_COARSE_LEVEL_H

#include <algorithm>
#include <iterator>
#include <vector>

#include <vcg/complex/algorithms/ccdm/angle_polish.h>
#include <vcg/complex/algorithms/ccdm/parallel.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>
#include <vcg/complex/algorithms/ccdm/sampling.h>

namespace vcg {
namespace ccdm {

/// A mesh of about a quarter of the vertices, at twice the spacing, which is optimised first and then quartered
/// (refinement.h): whom it serves, how large it is, and whether to trust what became of it. Measured: a second such
/// level is hardly faster than one, and the few irregular vertices that come out then strain the mesh.
class CoarseLevel
{
public:
    CoarseLevel(const Model &model, Workers &workers) : _model(model), _reference(model.surface.mesh), _workers(workers)
    {
    }

    /// Whether a result of so many vertices gains by it. Creases are better met at full resolution, unless they are a
    /// few in a surface that has none otherwise; and so are boundaries with more corners than the coarse level has
    /// edges for.
    bool Serves(int vertices) const
    {
        if (vertices / 4 < LeastCoarse)
            return false;
        double creases = 0, missing = 0;
        for (const FeatureCurve &c : _model.features.curve) {
            if (c.locked)
                return false;
            const double length = c.InSpacings(_model.density.spacing);
            if (c.OnBoundary(_reference))
                missing += std::max(0.0, 1 - length / 2);
            else
                creases += length;
        }
        return std::max(creases, missing) <= MostOnFeatures * vertices;
    }

    /// Its vertices, for a result of `vertices` and the Euler characteristic `euler`; `onCurves` are its samples there.
    /// Quartered, V vertices become at most 4 V - 3 chi - B, of which B are edges on boundaries.
    int Vertices(int vertices, int euler, const std::vector<CurveSample> &onCurves) const
    {
        const std::vector<FeatureCurve> &curve = _model.features.curve;
        int boundary = 0;
        for (const FeatureCurve &c : curve)
            boundary += c.OnBoundary(_reference) && !c.closed;
        for (const CurveSample &s : onCurves)
            boundary += curve[s.curve].OnBoundary(_reference);
        return (vertices + 3 * euler + boundary) / 4;
    }

    /// Whether the result may lack thin parts, which the coarse level can lose: an angle is smaller than it should
    /// leave of `target`, in degrees, or a triangle spans a gap.
    bool MayLackParts(const Remesh &remesh, double target) const
    {
        // Next to creases that are close together the target is often out of reach, with and without a coarse level.
        const std::vector<FeatureCurve> &curve = _model.features.curve;
        const bool creases =
            std::any_of(curve.begin(), curve.end(), [&](const FeatureCurve &c) { return !c.OnBoundary(_reference); });
        const double least = target - AngleSlack;
        return SmallestFreeAngle(remesh) < (creases ? std::min(least, AngleAtCreases) : least) ||
               GapsSpanned(remesh) > 0;
    }

    /// Whether `other`, made without the coarse level, is to be taken in place of `remesh`, with it, which may lack
    /// parts: it spans half the gaps at most or, where there are none, has a larger smallest angle.
    bool IsSurpassed(const Remesh &remesh, const Remesh &other) const
    {
        const int gaps = GapsSpanned(remesh), left = GapsSpanned(other);
        return gaps > 0 ? 2 * left <= gaps : left == 0 && SmallestFreeAngle(other) > SmallestFreeAngle(remesh);
    }

private:
    static constexpr int LeastCoarse = 1000; // vertices
    /// Length of the creases in spacings, and missing edges of boundaries, for each vertex. Measured: on scans at 0.009
    /// it raises the angles by 0.3 degrees; on CAD parts at 0.03 it does nothing for them, at 0.04 it lowers them by
    /// 0.3.
    static constexpr double MostOnFeatures = 0.01;
    /// Degrees. Measured at creases: for a scan with one triangle between 23 and 26 degrees the second attempt cost 1.4
    /// times the time and 0.3 degrees of the average.
    static constexpr double AngleSlack = 0.05, AngleAtCreases = 20;
    /// Distance of a triangle's middle from the surface, in spacings. Measured: noise as high as the spacing comes to
    /// 0.66; fingers and strands of hair that have become one, to 0.75 and more.
    static constexpr double Gap = 0.7;

    const Model &_model;
    const Triangulation &_reference;
    Workers &_workers;

    // The triangles whose middle lies far off the surface around their corners: what they join are two parts.
    int GapsSpanned(const Remesh &remesh) const
    {
        const Triangulation &m = remesh.mesh;
        const auto spans = [&](int t) { return SpansGap(remesh, m.triangle[t]); };
        return static_cast<int>(Chunks::Where(_workers, m.TriangleCount(), spans).size());
    }

    bool SpansGap(const Remesh &remesh, const Triangle &T) const
    {
        const std::vector<Point> &x = remesh.position;
        const Point middle = (x[T.v[0]] + x[T.v[1]] + x[T.v[2]]) / 3;
        bool free = false;
        for (const int v : T.v) {
            const Place &place = remesh.place[v];
            const double gap = Gap * Spacing(place.face);
            // The corner itself is a point of the surface: nearly all triangles are too small to span anything.
            if (SquaredNorm(middle - x[v]) < gap * gap)
                return false;
            // Those of features are at home on one side of them.
            if (place.kind != VertexKind::Free)
                continue;
            free = true;
            if (_model.surface.Project(place.face, x[v], middle, 0).second.squaredDistance < gap * gap)
                return false;
        }
        return free;
    }

    // The largest at the corners of a face of the reference surface.
    double Spacing(int face) const
    {
        const std::vector<double> &h = _model.density.spacing;
        const Triangle &T = _reference.triangle[face];
        return std::max({h[T.v[0]], h[T.v[1]], h[T.v[2]]});
    }

    // In degrees, of the triangles that no feature touches.
    double SmallestFreeAngle(const Remesh &remesh) const
    {
        const std::vector<Point> &x = remesh.position;
        struct Least {
            double angle = Pi;
        };
        const auto look = [&](int first, int last, Least &least) {
            for (int t = first; t < last; ++t) {
                const Triangle &T = remesh.mesh.triangle[t];
                const bool free = std::all_of(std::begin(T.v), std::end(T.v),
                                              [&](int v) { return remesh.place[v].kind == VertexKind::Free; });
                if (free)
                    least.angle = std::min(least.angle, SmallestAngle(x[T.v[0]], x[T.v[1]], x[T.v[2]]));
            }
        };
        double least = Pi;
        for (const Least &part : Chunks::Collect<Least>(_workers, remesh.mesh.TriangleCount(), look))
            least = std::min(least, part.angle);
        return least * 180 / Pi;
    }
};

} // namespace ccdm
} // namespace vcg

#endif
