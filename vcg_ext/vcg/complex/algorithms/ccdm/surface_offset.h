// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_SURFACE_OFFSET_H
#define VCG_CCDM_SURFACE_OFFSET_H

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <vcg/complex/algorithms/ccdm/patch_schedule.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>

namespace vcg {
namespace ccdm {

/// Takes the free vertices off the surface, along their normals, to where the integral of the squared
/// distance between the triangles and the surface is least: chords of a sphere then lie partly inside it,
/// partly outside. Vertices of features and boundaries stay.
class SurfaceOffset
{
public:
    SurfaceOffset(const Model &model, Remesh &remesh, Workers &workers)
        : _model(model), _remesh(remesh), _workers(workers)
    {
    }

    /// Goes `share` of the way, in [0, 1].
    void Run(double share)
    {
        const std::vector<Point> start = _remesh.position;
        for (int round = 0; round < Rounds; ++round) {
            FindNormals();
            Assemble();
            Solve();
            for (int v = 0; v < _remesh.VertexCount(); ++v)
                _remesh.position[v] += _normal[v] * _offset[v];
        }
        for (int v = 0; v < _remesh.VertexCount(); ++v)
            _remesh.position[v] = start[v] + (_remesh.position[v] - start[v]) * share;
        TakeBackTurns(start);
    }

private:
    static constexpr int Rounds = 3;
    static constexpr int Sweeps = 12;
    /// Largest offset in one round, as a share of the mean length of the vertex's edges.
    static constexpr double Most = 0.25;

    /// One triangle's part of the normal equations.
    struct Element {
        double mass[3][3];
        double load[3];
    };

    const Model &_model;
    Remesh &_remesh;
    Workers &_workers;
    std::vector<Point> _normal;    // unit, or zero for a vertex that stays
    std::vector<double> _reach;    // mean edge length
    std::vector<double> _offset;   // along the normal
    std::vector<Element> _element; // of each triangle

    Point AreaVector(int t, const std::vector<Point> &x) const
    {
        const Triangle &T = _remesh.mesh.triangle[t];
        return Cross(x[T.v[1]] - x[T.v[0]], x[T.v[2]] - x[T.v[0]]) * 0.5;
    }

    void FindNormals()
    {
        _normal.assign(_remesh.VertexCount(), Point(0, 0, 0));
        _reach.assign(_remesh.VertexCount(), 0);
        Chunks::For(_workers, _remesh.VertexCount(), [&](int first, int last, int) {
            Star star;
            for (int v = first; v < last; ++v) {
                if (_remesh.place[v].kind != VertexKind::Free)
                    continue;
                _remesh.mesh.GatherStar(v, star);
                const Point &x = _remesh.position[v];
                Point sum(0, 0, 0);
                for (int k = 0; k < star.Triangles(); ++k) {
                    const Point u = _remesh.position[star.outer[k]] - x;
                    sum += Cross(u, _remesh.position[star.OuterAfter(k)] - x);
                    _reach[v] += Norm(u) / star.Triangles();
                }
                const double length = Norm(sum);
                if (length > 0)
                    _normal[v] = sum / length;
            }
        });
    }

    // Six points of a triangle and their weights (Dunavant 1985, degree 4).
    void Assemble()
    {
        static constexpr double a[2] = {0.445948490915965, 0.091576213509771};
        static constexpr double weight[2] = {0.223381589678011, 0.109951743655322};
        _element.resize(_remesh.mesh.triangle.size());
        Chunks::For(_workers, _remesh.mesh.TriangleCount(), [&](int first, int last, int) {
            for (int t = first; t < last; ++t) {
                const Triangle &T = _remesh.mesh.triangle[t];
                Element &e = _element[t];
                e = Element();
                const Point areaVector = AreaVector(t, _remesh.position);
                const double area = Norm(areaVector);
                if (!(area > 0))
                    continue;
                const Point n = areaVector / area;
                int home = T.v[0];
                double facing[3];
                for (int i = 0; i < 3; ++i) {
                    facing[i] = Dot(n, _normal[T.v[i]]);
                    if (_remesh.place[T.v[i]].kind == VertexKind::Free)
                        home = T.v[i];
                }
                for (int g = 0; g < 6; ++g) {
                    std::array<double, 3> share = {a[g / 3], a[g / 3], a[g / 3]};
                    share[g % 3] = 1 - 2 * a[g / 3];
                    const Point p = _remesh.position[T.v[0]] * share[0] + _remesh.position[T.v[1]] * share[1] +
                                    _remesh.position[T.v[2]] * share[2];
                    const auto foot =
                        _model.surface.Project(_remesh.place[home].face, _remesh.position[home], p, 0).second;
                    const double gap = Dot(foot.point - p, n) * area * weight[g / 3];
                    for (int i = 0; i < 3; ++i)
                        e.load[i] += gap * share[i] * facing[i];
                }
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j)
                        e.mass[i][j] = area * facing[i] * facing[j] / (i == j ? 6 : 12);
            }
        });
    }

    // Gauss and Seidel's sweeps: the matrix is a mass matrix, so a few are enough.
    void Solve()
    {
        _offset.assign(_remesh.VertexCount(), 0);
        for (int sweep = 0; sweep < Sweeps; ++sweep)
            for (int v = 0; v < _remesh.VertexCount(); ++v) {
                double mass = 0, load = 0;
                _remesh.mesh.VisitSpokes(v, [&](int, Side s) {
                    // Each triangle of a star is met at one of its spokes at least: every one counts half.
                    for (const Side side : {s, _remesh.mesh.Mate(s)}) {
                        if (side == NoSide)
                            continue;
                        const int t = SideTriangle(side);
                        const Triangle &T = _remesh.mesh.triangle[t];
                        const int i = T.IndexOf(v);
                        const Element &e = _element[t];
                        mass += 0.5 * e.mass[i][i];
                        load += 0.5 * e.load[i];
                        for (int j = 0; j < 3; ++j)
                            if (j != i)
                                load -= 0.5 * e.mass[i][j] * _offset[T.v[j]];
                    }
                    return true;
                });
                _offset[v] = mass > 0 ? std::clamp(load / mass, -Most * _reach[v], Most * _reach[v]) : 0.0;
            }
    }

    // A vertex goes back to where it was if a triangle would turn by more than 60 degrees.
    void TakeBackTurns(const std::vector<Point> &start)
    {
        for (bool changed = true; changed;) {
            changed = false;
            for (int t = 0; t < _remesh.mesh.TriangleCount(); ++t) {
                const Point before = AreaVector(t, start), after = AreaVector(t, _remesh.position);
                if (Dot(before, after) >= 0.5 * std::sqrt(SquaredNorm(before) * SquaredNorm(after)))
                    continue;
                for (const int v : _remesh.mesh.triangle[t].v) {
                    changed = changed || _remesh.position[v] != start[v];
                    _remesh.position[v] = start[v];
                }
            }
        }
    }
};

} // namespace ccdm
} // namespace vcg

#endif
