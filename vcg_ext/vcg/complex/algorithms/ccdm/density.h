// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_DENSITY_H
#define VCG_CCDM_DENSITY_H

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/reference_surface.h>

namespace vcg {
namespace ccdm {

/// Area of a vertex (a third of its star's) and sqrt(|K| + H^2) there. False at features and where
/// there is no area: no curvature is known then.
inline bool StarCurvature(const ReferenceSurface &surface, int v, const Star &star, double &area, double &curvature)
{
    const Point &x = surface.position[v];
    const int n = star.Triangles();
    auto spoke = [&](int k) { return Point(surface.position[star.outer[k]] - x); };
    auto cross = [&](int k) { return Cross(spoke(k), Point(surface.position[star.OuterAfter(k)] - x)); };
    double angle = 0, bend = 0;
    bool feature = !star.closed;
    area = 0;
    for (int k = 0; k < n; ++k) {
        const Point u = spoke(k), w = surface.position[star.OuterAfter(k)] - x, here = Cross(u, w);
        area += Norm(here) / 6;
        angle += std::atan2(Norm(here), Dot(u, w));
        if (k == 0 && !star.closed)
            continue;
        const Triangle &T = surface.mesh.triangle[SideTriangle(star.corner[k])];
        const int before = T.IndexOf(star.OuterAfter(k));
        feature = feature || T.Constrained(before);
        // Normals run consistently around the star, so the sign of a turn is that of its side.
        const Point back = cross(k == 0 ? n - 1 : k - 1);
        const double turn = std::atan2(Norm(Cross(back, here)), Dot(back, here)) * Norm(u) / 4;
        bend += Dot(w, back) > 0 ? -turn : turn;
    }
    if (feature || !(area > 0))
        return false;
    const double gauss = (2 * Pi - angle) / area, mean = bend / area;
    curvature = std::sqrt(std::abs(gauss) + mean * mean);
    return true;
}

/// Rounds to single precision: the last bits of what atan2 and pow return are not the same on every machine.
inline double RoundToFloat(double x)
{
    return static_cast<double>(static_cast<float>(x));
}

/// phi = sqrt(|K| + H^2) at each reference vertex (paper, section 3.2). K is the angle deficit over a
/// third of the star's area, H a quarter of the sum of turn * length over that area. Feature edges do
/// not count as curvature: their vertices take the mean of their neighbours. The field is smoothed
/// three times and clamped to its 2nd and 99.5th percentile by area and to a hundredth of the latter,
/// so that it is positive and no sliver owns the budget.
inline std::vector<double> CurvatureDensity(const ReferenceSurface &surface)
{
    const Triangulation &m = surface.mesh;
    const int count = m.VertexCount();
    std::vector<double> area(count, 0), phi(count, 0), smooth(count);
    std::vector<char> known(count, 0);
    Star star;
    for (int v = 0; v < count; ++v)
        if (m.incident[v] >= 0) {
            m.GatherStar(v, star);
            known[v] = static_cast<char>(StarCurvature(surface, v, star, area[v], phi[v]));
        }
    for (int round = 0; round < 3; ++round) {
        std::vector<char> reached = known;
        for (int v = 0; v < count; ++v) {
            double sum = known[v] ? area[v] * phi[v] : 0, weight = known[v] ? area[v] : 0;
            if (m.incident[v] >= 0)
                m.VisitSpokes(v, [&](int o, Side) {
                    if (known[o]) {
                        sum += area[o] * phi[o];
                        weight += area[o];
                    }
                    return true;
                });
            smooth[v] = weight > 0 ? sum / weight : 0;
            reached[v] = static_cast<char>(weight > 0);
        }
        phi.swap(smooth);
        known.swap(reached);
    }
    std::vector<std::pair<double, double>> sorted;
    double total = 0;
    for (int v = 0; v < count; ++v)
        if (known[v]) {
            sorted.emplace_back(phi[v], area[v]);
            total += area[v];
        }
    std::sort(sorted.begin(), sorted.end());
    auto percentile = [&](double share) {
        double sum = 0;
        for (const auto &s : sorted) {
            sum += s.second;
            if (sum >= share * total)
                return s.first;
        }
        return sorted.empty() ? 1.0 : sorted.back().first;
    };
    const double high = percentile(0.995), low = std::max(percentile(0.02), 0.01 * high);
    for (double &x : phi)
        x = high > 0 ? RoundToFloat(std::clamp(x, low, high)) : 1.0;
    return phi;
}

/// Density and what follows from it, at each reference vertex.
struct DensityField {
    std::vector<double> phi;     ///< wanted vertex density, up to a factor
    std::vector<double> rho;     ///< weight in the energy, phi^gamma
    std::vector<double> spacing; ///< wanted edge length h = sqrt(2 / (sqrt(3) n phi_hat))
    bool uniform = true;
};

/// Integral over the surface of a field that is linear on each face.
inline double Integral(const ReferenceSurface &surface, const std::vector<double> &field)
{
    double integral = 0;
    for (int t = 0; t < surface.FaceCount(); ++t) {
        const Triangle &T = surface.mesh.triangle[t];
        integral += Norm(surface.AreaVector(t)) * (field[T.v[0]] + field[T.v[1]] + field[T.v[2]]) / 3;
    }
    return integral;
}

/// Raises phi where the spacing h that follows from it would grow faster than `gradation` times the way
/// along the edges of the surface: neighbouring triangles of well graded meshes differ by little.
inline void LimitGradation(const ReferenceSurface &surface, int vertices, double gradation, std::vector<double> &phi)
{
    const Triangulation &m = surface.mesh;
    const double scale = 2 * Integral(surface, phi) / (std::sqrt(3.0) * vertices);
    using Entry = std::pair<double, int>; // spacing, vertex
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::vector<double> spacing(phi.size());
    for (std::size_t v = 0; v < phi.size(); ++v) {
        spacing[v] = std::sqrt(scale / phi[v]);
        if (m.incident[v] >= 0)
            queue.emplace(spacing[v], static_cast<int>(v));
    }
    while (!queue.empty()) {
        const auto [h, v] = queue.top();
        queue.pop();
        if (h > spacing[v])
            continue;
        const int from = v;
        m.VisitSpokes(from, [&](int o, Side) {
            const double most = spacing[from] + gradation * Norm(surface.position[o] - surface.position[from]);
            if (most < spacing[o]) {
                spacing[o] = most;
                phi[o] = scale / (most * most);
                queue.emplace(most, o);
            }
            return true;
        });
    }
}

/// Weights are above 0 even where phi^gamma is too small for single precision.
constexpr double LeastWeight = 1e-30;

/// h is the edge length of the equilateral triangulation with phi_hat n vertices per unit of area,
/// phi_hat being phi scaled to integrate to 1.
inline DensityField MakeDensityField(const ReferenceSurface &surface, std::vector<double> phi, bool uniform,
                                     double exponent, int vertices)
{
    DensityField d;
    d.uniform = uniform;
    d.phi = std::move(phi);
    const double integral = Integral(surface, d.phi);
    d.rho.resize(d.phi.size());
    d.spacing.resize(d.phi.size());
    for (std::size_t v = 0; v < d.phi.size(); ++v) {
        d.rho[v] = uniform ? 1.0 : std::max(RoundToFloat(std::pow(d.phi[v], exponent)), LeastWeight);
        d.spacing[v] = std::sqrt(2 * integral / (std::sqrt(3.0) * vertices * d.phi[v]));
    }
    return d;
}

} // namespace ccdm
} // namespace vcg

#endif
