// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CCDM_TESTS_EXAMPLES_DART_SAMPLER_H
#define CCDM_TESTS_EXAMPLES_DART_SAMPLER_H

#include <algorithm>
#include <vector>

#include <vcg/complex/algorithms/ccdm/front_sampler.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>

namespace examples {

/// A sampler: throws darts in proportion to the density and keeps those that are not within 0.7 spacings of a kept one
/// (Cook 1986); if too few are left, the first of the others are taken back.
class DartSampler
{
public:
    explicit DartSampler(const vcg::ccdm::Model &model) : _model(model) {}

    /// Exactly `count` points on faces.
    std::vector<vcg::ccdm::SurfacePoint> Run(const std::vector<vcg::ccdm::CurveSample> &onCurves, int count,
                                             vcg::ccdm::Random &random) const
    {
        const std::vector<double> &spacing = _model.density.spacing;
        vcg::ccdm::PointBuckets kept(*std::min_element(spacing.begin(), spacing.end()), onCurves.size() + count);
        const auto isFree = [&](const vcg::ccdm::Point &p, double h) {
            bool free = true;
            kept.Near(p, 0.7 * h, h, [&](int, double) { return free = false; });
            return free;
        };
        for (const vcg::ccdm::CurveSample &s : onCurves) {
            const vcg::ccdm::FeatureCurve &c = _model.features.curve[s.curve];
            kept.Add(c.At(_model.surface.position, s.s, 0), spacing[c.vertex[c.SegmentAt(s.s)]]);
        }
        for (const int v : _model.features.corner)
            kept.Add(_model.surface.position[v], spacing[v]);

        std::vector<vcg::ccdm::SurfacePoint> samples, refused;
        for (int round = 0; round < Rounds; ++round)
            for (const vcg::ccdm::SurfacePoint &p : SampleFaces(_model.surface, _model.density, count, random)) {
                const vcg::ccdm::Point at = _model.surface.At(p);
                const double h = _model.surface.Interpolate(p, spacing);
                if (static_cast<int>(samples.size()) == count || !isFree(at, h)) {
                    refused.push_back(p);
                    continue;
                }
                samples.push_back(p);
                kept.Add(at, h);
            }
        for (std::size_t k = 0; static_cast<int>(samples.size()) < count; ++k)
            samples.push_back(refused[k]);
        return samples;
    }

private:
    static constexpr int Rounds = 10;

    const vcg::ccdm::Model &_model;
};

} // namespace examples

#endif
