// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_CENTROID_RULES_H
#define VCG_CCDM_CENTROID_RULES_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <vcg/complex/algorithms/ccdm/relocation.h>

namespace vcg {
namespace ccdm {

/// Twice the area of triangle k of the star of v; with a density, times the sum of its weights at the corners.
inline double TriangleMass(const Remesh &remesh, bool uniform, const LocalStar &star, int v, int k)
{
    const double area = Norm(star.cross[k]);
    return uniform ? area : area * (remesh.rho[v] + remesh.rho[star.id[k]] + remesh.rho[star.id[k + 1]]);
}

/// Centroid of the star, weighted with the density: the paper's relocation (section 2.1, equation 3).
struct PatchCentroid {
    static constexpr double Pull = 0.5; ///< share of the displacement that momentum bears; measured
    const Remesh &remesh;
    bool uniform;

    Point operator()(const LocalStar &star, int v) const
    {
        Point sum(0, 0, 0);
        double mass = 0;
        for (int k = 0; k < star.triangles; ++k) {
            const double m = TriangleMass(remesh, uniform, star, v, k);
            sum += (star.spoke[k] + star.spoke[k + 1]) * m;
            mass += m;
        }
        return mass > 0 ? sum / (3 * mass) : Point(0, 0, 0);
    }
};

/// Random step of at most lambda times the mean edge length in the tangent plane: equation (4).
/// Each vertex draws from a sequence of its own, so that the order of the vertices does not matter.
struct Perturbation {
    double lambda;
    std::uint64_t seed;

    Point operator()(const LocalStar &star, int v) const
    {
        Random random(seed + static_cast<std::uint64_t>(v) * 0xd1b54a32d192ed03ULL);
        const double u = random.Unit();
        // A direction by a point of the unit disc: no sine, whose last bit is not the same everywhere.
        double x = 1, y = 0, squared = 1;
        for (int i = 0; i < 32; ++i) {
            x = 2 * random.Unit() - 1;
            y = 2 * random.Unit() - 1;
            squared = x * x + y * y;
            if (squared <= 1 && squared > 1e-6)
                break;
        }
        const double size = lambda * star.radius * u / std::sqrt(squared);
        return Relocator::TangentStep(star, size * x, size * y);
    }
};

/// Centroid of the Voronoi cell, weighted with the density. The cell is put together from the Delaunay
/// star: between the spokes u and w it is the quadrilateral of the vertex, the middles of the spokes and
/// the circumcentre, cut in two signed triangles at the latter. Where that reaches over a feature edge, it
/// is clipped there.
struct CellCentroid {
    static constexpr double Pull = 2.15; ///< as for PatchCentroid
    const Remesh &remesh;
    bool uniform;

    Point operator()(const LocalStar &star, int v) const
    {
        Point sum(0, 0, 0);
        double mass = 0;
        for (int k = 0; k < star.triangles; ++k) {
            const Point &u = star.spoke[k], &w = star.spoke[k + 1];
            const double m2 = SquaredNorm(star.cross[k]);
            if (!(m2 > 0))
                continue;
            const double uu = star.squared[k], ww = star.squared[k + 1], uw = Dot(u, w), m = std::sqrt(m2);
            if (uw < 0 && star.Wall(k)) {
                // The bisectors of the spokes meet the edge from u to w at the shares s and t of its length.
                const double s = 0.5 * uu / (uu - uw), t = 1 - 0.5 * ww / (ww - uw);
                const Point p = u * (1 - s) + w * s, q = u * (1 - t) + w * t;
                const double rho =
                    uniform ? 1.0 : (remesh.rho[v] + remesh.rho[star.id[k]] + remesh.rho[star.id[k + 1]]) / 3;
                const double first = 0.5 * s * m * rho, middle = (t - s) * m * rho, last = 0.5 * (1 - t) * m * rho;
                sum += (u * 0.5 + p) * first + (p + q) * middle + (q + w * 0.5) * last;
                mass += first + middle + last;
                continue;
            }
            // The circumcentre is a u + b w; signed areas of the two parts.
            const double scale = 0.5 / m2, a = ww * (uu - uw) * scale, b = uu * (ww - uw) * scale;
            const double areaU = 0.5 * b * m, areaW = 0.5 * a * m;
            if (uniform) {
                const double area = areaU + areaW;
                sum += u * (0.5 * areaU + a * area) + w * (0.5 * areaW + b * area);
                mass += area;
                continue;
            }
            const Point centre = u * a + w * b;
            const double r = remesh.rho[v], ru = 0.5 * (r + remesh.rho[star.id[k]]),
                         rw = 0.5 * (r + remesh.rho[star.id[k + 1]]);
            const double rc = std::max(r + 2 * a * (ru - r) + 2 * b * (rw - r), 0.1 * r);
            sum += (u * (0.5 * (r + 2 * ru + rc)) + centre * (r + ru + 2 * rc)) * (0.25 * areaU);
            sum += (w * (0.5 * (r + 2 * rw + rc)) + centre * (r + rw + 2 * rc)) * (0.25 * areaW);
            mass += ((r + ru + rc) * areaU + (r + rw + rc) * areaW) / 3;
        }
        return mass > 0 ? sum / (3 * mass) : Point(0, 0, 0);
    }
};

/// Mean of the circumcentres of the star's triangles by area, weighted with the density: the relocation of
/// optimal Delaunay triangulations (Alliez et al. 2005, "Variational tetrahedral meshing", section 3).
struct MeanCircumcentre {
    static constexpr double Pull = 0.5; ///< as for PatchCentroid
    const Remesh &remesh;
    bool uniform;

    Point operator()(const LocalStar &star, int v) const
    {
        Point sum(0, 0, 0);
        double mass = 0;
        for (int k = 0; k < star.triangles; ++k) {
            const Point &u = star.spoke[k], &w = star.spoke[k + 1];
            const double m2 = SquaredNorm(star.cross[k]);
            if (!(m2 > 0))
                continue;
            const double uu = SquaredNorm(u), ww = SquaredNorm(w), uw = Dot(u, w);
            const double m = TriangleMass(remesh, uniform, star, v, k);
            sum += u * (m * ww * (uu - uw) / (2 * m2)) + w * (m * uu * (ww - uw) / (2 * m2));
            mass += m;
        }
        return mass > 0 ? sum / mass : Point(0, 0, 0);
    }
};

/// For vertices of feature curves: half way between the centroid of the star and, where the density is
/// uniform, the middle of the two neighbours on the curve, which spreads the error of the chords evenly.
struct CurveCentroid {
    PatchCentroid patch;

    Point operator()(const LocalStar &star, int v) const
    {
        Point sum(0, 0, 0);
        int neighbours = 0;
        for (int k = 0; k < star.spokes; ++k)
            if (star.sectorStart[k] != 0) {
                sum += star.spoke[k];
                ++neighbours;
            }
        const Point centroid = patch(star, v);
        return patch.uniform && neighbours == 2 ? Point(centroid * 0.5 + sum * 0.25) : centroid;
    }
};

/// Momentum on a relocation rule (Polyak's heavy ball): the step is the rule's pull times its
/// displacement plus momentum times the vertex's last step. Vertices of curves, where that would overshoot, have a rule
/// of their own.
template <class Rule>
struct HeavyBall {
    // Along smooth modes a step grows to pull / (1 - momentum) of the rule's. Measured for the cell centroid: with 4.5
    // two thirds of the sweeps are needed that 3.75 needs, however it is shared between momentum and pull; from 4.7 on
    // the vertices do not come to rest and angles are lost.
    static constexpr double Momentum = 0.52;
    Rule rule;
    CurveCentroid onCurves;
    const std::vector<Point> &position;
    std::vector<Point> &last; ///< positions before the last step

    Point operator()(const LocalStar &star, int v) const
    {
        if (star.onCurve)
            return onCurves(star, v);
        const Point x = position[v];
        const Point step = rule(star, v) * Rule::Pull + (x - last[v]) * Momentum;
        last[v] = x;
        return step;
    }
};

} // namespace ccdm
} // namespace vcg

#endif
