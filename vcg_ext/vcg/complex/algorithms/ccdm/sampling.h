// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_SAMPLING_H
#define VCG_CCDM_SAMPLING_H

#include <algorithm>
#include <cmath>
#include <vector>

#include <vcg/complex/algorithms/ccdm/density.h>
#include <vcg/complex/algorithms/ccdm/feature_graph.h>

namespace vcg {
namespace ccdm {

/// A sample on a feature curve.
struct CurveSample {
    int curve;
    double s; ///< arc length
};

/// The vertices of the remesh before there is a mesh: corners (all of the graph's), curve samples in
/// order along each curve, and free points on faces.
struct SampleSet {
    std::vector<CurveSample> onCurves;
    std::vector<SurfacePoint> onFaces;
};

/// Fewest segments that keep the shape and the type of a curve. One that is closed, or ends where it starts, has three,
/// or four if they are to be `halved`, as three can slide together; one that is far from straight, or `twin` (another
/// curve joins the same corners), has two, any other one.
inline int FewestSegments(const FeatureCurve &c, const std::vector<Point> &position, bool twin, bool halved = false)
{
    if (c.vertex.front() == c.vertex.back())
        return halved ? 4 : 3;
    const double chord = Norm(position[c.vertex.front()] - position[c.vertex.back()]);
    return twin || c.Length() > 1.2 * chord ? 2 : 1;
}

/// Spaces samples along a curve evenly in the measure ds / h, as many as that measure holds, divided by
/// `stretch` and rounded [AdVDI03].
inline void SampleCurve(const DensityField &density, const FeatureCurve &c, int index, int fewest, double stretch,
                        std::vector<CurveSample> &out)
{
    std::vector<double> measure(c.vertex.size(), 0);
    for (int k = 0; k < c.Segments(); ++k)
        measure[k + 1] = measure[k] + c.InSpacings(k, density.spacing);
    const double total = measure.back();
    const int segments = std::max(fewest, static_cast<int>(std::lround(total / stretch)));
    int k = 0;
    for (int i = c.closed ? 0 : 1; i < segments; ++i) {
        const double want = total * i / segments;
        while (k + 1 < c.Segments() && measure[k + 1] < want)
            ++k;
        const double l = measure[k + 1] - measure[k];
        const double s = c.arc[k] + (l > 0 ? (want - measure[k]) / l : 0) * (c.arc[k + 1] - c.arc[k]);
        out.push_back({index, s});
    }
}

/// Widens the spacing where the vertices could not even be a quarter of those that it wants on the curves, as on a
/// needle: what follows takes time in proportion to the samples.
inline void WidenForCurves(const FeatureGraph &features, int vertices, std::vector<double> &spacing)
{
    double wanted = 0;
    for (const FeatureCurve &c : features.curve)
        wanted += c.InSpacings(spacing);
    const double factor = wanted / (4.0 * vertices);
    if (factor > 1)
        for (double &h : spacing)
            h *= factor;
}

/// Samples of all curves, `stretch` times as far apart as the density wants. `halved`: for segments that will be.
inline std::vector<CurveSample> SampleCurves(const ReferenceSurface &surface, const FeatureGraph &features,
                                             const DensityField &density, double stretch = 1, bool halved = false)
{
    std::vector<std::pair<int, int>> ends;
    for (const FeatureCurve &c : features.curve)
        ends.push_back(std::minmax(c.vertex.front(), c.vertex.back()));
    std::vector<std::pair<int, int>> sorted = ends;
    std::sort(sorted.begin(), sorted.end());
    std::vector<CurveSample> samples;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const FeatureCurve &c = features.curve[i];
        if (c.locked)
            continue;
        const auto range = std::equal_range(sorted.begin(), sorted.end(), ends[i]);
        SampleCurve(density, c, static_cast<int>(i),
                    FewestSegments(c, surface.position, range.second - range.first > 1, halved), stretch, samples);
    }
    return samples;
}

/// Samples of all curves, further apart than the density wants if there would be more than `most`; still more only if
/// the curves cannot do with fewer.
inline std::vector<CurveSample> SampleCurvesWithin(const ReferenceSurface &surface, const FeatureGraph &features,
                                                   const DensityField &density, int most, bool halved = false)
{
    std::vector<CurveSample> samples = SampleCurves(surface, features, density, 1, halved);
    if (static_cast<int>(samples.size()) <= most)
        return samples;
    const std::size_t fewest = SampleCurves(surface, features, density, 1e9, halved).size();
    // What the curves cannot keep to anyway is passed by a fifth more, or the long ones would starve as well.
    const std::size_t limit = static_cast<int>(fewest) <= most ? static_cast<std::size_t>(most) : fewest + fewest / 5;
    for (double stretch = 1.05; samples.size() > limit; stretch *= 1.05)
        samples = SampleCurves(surface, features, density, stretch, halved);
    return samples;
}

/// Draws points over the faces in proportion to phi * area (paper, section 3.2). The draws run
/// through the cumulated measure in equal strides, one random point a stride, so that every region
/// gets its share.
inline std::vector<SurfacePoint> SampleFaces(const ReferenceSurface &surface, const DensityField &density, int count,
                                             Random &random)
{
    std::vector<SurfacePoint> samples;
    std::vector<double> measure(surface.FaceCount());
    double total = 0;
    for (int t = 0; t < surface.FaceCount(); ++t) {
        const Triangle &T = surface.mesh.triangle[t];
        total += Norm(surface.AreaVector(t)) * (density.phi[T.v[0]] + density.phi[T.v[1]] + density.phi[T.v[2]]);
        measure[t] = total;
    }
    samples.reserve(count);
    int t = 0;
    for (int i = 0; i < count; ++i) {
        const double want = total * (i + random.Unit()) / count;
        while (t + 1 < surface.FaceCount() && measure[t] <= want)
            ++t;
        const double r = std::sqrt(random.Unit()), w = random.Unit();
        SurfacePoint p;
        p.face = t;
        p.weight[0] = 1 - r;
        p.weight[1] = r * (1 - w);
        p.weight[2] = r * w;
        samples.push_back(p);
    }
    return samples;
}

} // namespace ccdm
} // namespace vcg

#endif
