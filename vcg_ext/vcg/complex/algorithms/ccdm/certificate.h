// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_CERTIFICATE_H
#define VCG_CCDM_CERTIFICATE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/parameters.h>
#include <vcg/complex/algorithms/ccdm/patch_schedule.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>
#include <vcg/complex/algorithms/ccdm/thin_parts.h>

namespace vcg {
namespace ccdm {

/// Says of every triangle whose smallest angle is below the target which property of the input stands in the
/// way. A reason is given only where the input has the property at that triangle; it shows that no good
/// triangle could be expected there, not that none exists.
class Certifier
{
public:
    /// `target` in degrees. `orientable`: the input is; the bend of a surface that is not is not looked at.
    Certifier(const Model &model, const Remesh &remesh, ThinParts &thin, double target, bool orientable)
        : _model(model), _remesh(remesh), _thin(thin), _target(target * Pi / 180), _orientable(orientable)
    {
    }

    /// Positions are those of the remesh.
    AngleCertificate Run()
    {
        Workers alone(1);
        return Run(alone);
    }
    AngleCertificate Run(Workers &workers)
    {
        struct Found {
            double least = 180;
            std::vector<std::pair<int, double>> below; // triangles and their angles
        };
        const auto look = [&](int first, int last, Found &found) {
            for (int t = first; t < last; ++t) {
                const double angle = Smallest(t);
                found.least = std::min(found.least, angle * 180 / Pi);
                if (!(angle >= _target - Slack))
                    found.below.emplace_back(t, angle);
            }
        };
        AngleCertificate result;
        result.target = _target * 180 / Pi;
        result.reached = 180;
        for (const Found &f : Chunks::Collect<Found>(workers, _remesh.mesh.TriangleCount(), look)) {
            result.reached = std::min(result.reached, f.least);
            for (const auto &[t, angle] : f.below) {
                const Point c = Centroid(t);
                result.below.push_back({t, angle * 180 / Pi, {c[0], c[1], c[2]}, Reason(t)});
            }
        }
        return result;
    }

private:
    const Model &_model;
    const Remesh &_remesh;
    ThinParts &_thin;
    const double _target;
    const bool _orientable;

    static constexpr double Slack = 1e-9; // radians, for angles that are the target but for rounding
    /// Features that meet at a corner are neighbours up to this many spacings from it.
    static constexpr double CornerReach = 2;

    const Point &At(int v) const { return _remesh.position[v]; }
    Point Centroid(int t) const
    {
        const auto &v = _remesh.mesh.triangle[t].v;
        return (At(v[0]) + At(v[1]) + At(v[2])) / 3;
    }
    // The smallest angle, which lies opposite the shortest side, in radians.
    double Smallest(int t) const
    {
        const auto &v = _remesh.mesh.triangle[t].v;
        int k = 0;
        double least = SquaredNorm(At(v[1]) - At(v[2]));
        for (const int i : {1, 2}) {
            const double l = SquaredNorm(At(v[Next(i)]) - At(v[Prev(i)]));
            if (l < least) {
                least = l;
                k = i;
            }
        }
        return AngleBetween(At(v[Next(k)]) - At(v[k]), At(v[Prev(k)]) - At(v[k]));
    }
    static double AngleBetween(const Point &a, const Point &b) { return TurnBetween(a, b); }
    const FeatureCurve &Curve(int c) const { return _model.features.curve[c]; }
    const Point &Input(int v) const { return _model.surface.position[v]; }

    SmallAngleReason Reason(int t)
    {
        const double h = Spacing(t);
        if (AtNarrowCorner(t))
            return SmallAngleReason::InputCorner;
        if (TouchesCloseFeatures(t, h))
            return SmallAngleReason::CloseFeatures;
        if (OnThinPart(t, h))
            return SmallAngleReason::ThinPart;
        if (HasFewVertices(t, h))
            return SmallAngleReason::FewVertices;
        return SmallAngleReason::Unexplained;
    }

    double Spacing(int t) const
    {
        double sum = 0;
        for (const int v : _remesh.mesh.triangle[t].v) {
            const int face = _remesh.place[v].face;
            const Foot foot = _model.surface.NearestOn(face, At(v));
            sum += _model.surface.Interpolate({face, {foot.weight[0], foot.weight[1], foot.weight[2]}},
                                              _model.density.spacing);
        }
        return sum / 3;
    }

    int CornerOf(int v) const { return ReferenceCorner(_model, _remesh, v); }
    bool Ends(int curve, int corner) const
    {
        return Curve(curve).vertex.front() == corner || Curve(curve).vertex.back() == corner;
    }
    // Curves that a vertex lies on.
    std::vector<int> CurvesOf(int v) const
    {
        std::vector<int> curves;
        if (_remesh.place[v].kind == VertexKind::Curve)
            curves.push_back(_remesh.place[v].curve);
        if (_remesh.place[v].kind == VertexKind::Corner) {
            const int corner = CornerOf(v);
            for (std::size_t c = 0; c < _model.features.curve.size(); ++c)
                if (Ends(static_cast<int>(c), corner))
                    curves.push_back(static_cast<int>(c));
        }
        return curves;
    }

    Point Along(const FeatureCurve &c, double s) const
    {
        const auto after = std::upper_bound(c.arc.begin(), c.arc.end(), c.OnCurve(s));
        return c.At(_model.surface.position, s, static_cast<int>(after - c.arc.begin()) - 1);
    }

    // Point of a curve at arc length r from the corner where it starts or ends.
    Point FromCorner(int curve, bool fromFront, double r) const
    {
        const FeatureCurve &c = Curve(curve);
        return Along(c, fromFront ? r : c.Length() - r);
    }

    // A triangle at a corner between two feature curves that meet there at less than the target, as seen over
    // the triangle's sides: whatever fills that sector has an angle below the target.
    bool AtNarrowCorner(int t) const
    {
        for (const int v : _remesh.mesh.triangle[t].v)
            if (_remesh.place[v].kind == VertexKind::Corner && InNarrowSector(t, v))
                return true;
        return false;
    }

    bool InNarrowSector(int t, int v) const
    {
        Star star;
        _remesh.mesh.GatherStar(v, star);
        const int count = star.Triangles();
        int first = 0;
        while (first < count && SideTriangle(star.corner[first]) != t)
            ++first;
        // From the triangle outwards to the spokes that are features.
        const auto angle = [&](int k) {
            return AngleBetween(At(star.outer[k]) - At(v), At(star.OuterAfter(k)) - At(v));
        };
        const auto feature = [&](int w) { return _remesh.mesh.Constrained(_remesh.mesh.FindEdge(v, w)); };
        double sector = angle(first);
        int low = first, high = first;
        for (int steps = 0; steps < count && !feature(star.outer[low]); ++steps) {
            low = low > 0 ? low - 1 : count - 1;
            sector += angle(low);
        }
        for (int steps = 0; steps < count && !feature(star.OuterAfter(high)); ++steps) {
            high = high + 1 < count ? high + 1 : 0;
            sector += angle(high);
        }
        if (sector >= 2 * _target) // wide enough for two good triangles
            return false;
        const int a = star.outer[low], b = star.OuterAfter(high);
        const double r = std::min(Norm(At(a) - At(v)), Norm(At(b) - At(v)));
        Point p, q;
        return OnSpoke(v, a, r, p) && OnSpoke(v, b, r, q) &&
               AngleBetween(p - Input(CornerOf(v)), q - Input(CornerOf(v))) < _target;
    }

    // The point of the input's curve along the spoke from corner v to w, at arc length r from v.
    bool OnSpoke(int v, int w, double r, Point &p) const
    {
        const int corner = CornerOf(v);
        for (const int c : CurvesOf(w)) {
            if (!Ends(c, corner))
                continue;
            const FeatureCurve &curve = Curve(c);
            bool front = curve.vertex.front() == corner;
            if (curve.vertex.front() == curve.vertex.back())
                front = _remesh.place[w].s < 0.5 * curve.Length();
            else if (_remesh.place[w].kind == VertexKind::Corner && !Ends(c, CornerOf(w)))
                continue;
            p = FromCorner(c, front, r);
            return true;
        }
        return false;
    }

    // The triangle has a vertex on a feature, and an edge there joins it with another feature, or with another
    // part of it, that is closer than the spacing.
    bool TouchesCloseFeatures(int t, double h) const
    {
        bool close = false;
        for (const int u : _remesh.mesh.triangle[t].v)
            if (_remesh.place[u].kind != VertexKind::Free && !close)
                _remesh.mesh.VisitSpokes(u, [&](int v, Side s) {
                    close = _remesh.place[v].kind != VertexKind::Free && JoinsCloseFeatures(u, v, s, h);
                    return !close;
                });
        return close;
    }

    bool JoinsCloseFeatures(int u, int v, Side s, double h) const
    {
        const std::vector<int> ofU = CurvesOf(u), ofV = CurvesOf(v);
        if (_remesh.mesh.Constrained(s)) {
            // Two corners closer together than the spacing allows.
            if (_remesh.place[u].kind == VertexKind::Corner && _remesh.place[v].kind == VertexKind::Corner)
                for (const int c : ofU)
                    if (std::find(ofV.begin(), ofV.end(), c) != ofV.end() &&
                        Curve(c).Length() < ThinParts::NarrowShare * h)
                        return true;
            return false;
        }
        for (const int a : ofU)
            for (const int b : ofV)
                if (a == b ? FoldsBack(a, u, v, h) : AreClose(a, u, b, v, h))
                    return true;
        return false;
    }

    double ArcOf(int curve, int v) const
    {
        if (_remesh.place[v].kind == VertexKind::Curve)
            return _remesh.place[v].s;
        return Curve(curve).vertex.front() == CornerOf(v) ? 0 : Curve(curve).Length();
    }

    // Two parts of one curve that are closer in space than the spacing, and far apart along the curve.
    bool FoldsBack(int curve, int u, int v, double h) const
    {
        const FeatureCurve &c = Curve(curve);
        double way = std::abs(ArcOf(curve, u) - ArcOf(curve, v));
        if (c.vertex.front() == c.vertex.back())
            way = std::min(way, c.Length() - way);
        const double d = Norm(At(u) - At(v));
        return d < h && way > CornerReach * h && way > 2.5 * d;
    }

    // Vertex u of curve a and v of curve b: one of them is closer to the other curve than the spacing.
    bool AreClose(int a, int u, int b, int v, double h) const
    {
        // A vertex on both curves joins nothing.
        for (const int k : CurvesOf(u))
            if (k == b)
                return false;
        for (const int k : CurvesOf(v))
            if (k == a)
                return false;
        const double s = ArcOf(a, u), r = ArcOf(b, v);
        return IsNear(u, a, s, b, r, h) || IsNear(v, b, r, a, s, h);
    }

    // Vertex v, at arc length s of curve a, is closer to curve b near `hint` than the spacing, and not for their
    // meeting at a corner close by, unless they do so at less than the target.
    bool IsNear(int v, int a, double s, int b, double hint, double h) const
    {
        const FeatureCurve &c = Curve(a), &d = Curve(b);
        const auto [distance, foot] = Nearest(At(v), d, hint);
        if (distance >= h)
            return false;
        for (const bool first : {true, false})
            for (const bool second : {true, false}) {
                const int corner = first ? c.vertex.front() : c.vertex.back();
                if (corner != (second ? d.vertex.front() : d.vertex.back()))
                    continue;
                const double r = std::max(first ? s : c.Length() - s, second ? foot : d.Length() - foot);
                if (r <= CornerReach * h && AngleBetween(FromCorner(a, first, r) - Input(corner),
                                                         FromCorner(b, second, r) - Input(corner)) >= _target)
                    return false;
            }
        return true;
    }

    // Distance of p from a curve, downhill from arc length s, and the arc length of its foot.
    std::pair<double, double> Nearest(const Point &p, const FeatureCurve &c, double s) const
    {
        const auto squared = [&](int k) {
            return SegmentSquaredDistance(p, Input(c.vertex[k]), Input(c.vertex[k + 1]) - Input(c.vertex[k]));
        };
        const auto after = std::upper_bound(c.arc.begin(), c.arc.end(), s);
        const int start = std::clamp(static_cast<int>(after - c.arc.begin()) - 1, 0, c.Segments() - 1);
        int best = start;
        double least = squared(start);
        for (const int step : {-1, 1})
            for (int k = start + step; k >= 0 && k < c.Segments(); k += step) {
                const double d = squared(k);
                if (d > least)
                    break;
                least = d;
                best = k;
            }
        const Point &from = Input(c.vertex[best]);
        const Point along = Input(c.vertex[best + 1]) - from;
        const double l = SquaredNorm(along);
        const double share = l > 0 ? std::clamp(Dot(p - from, along) / l, 0.0, 1.0) : 0;
        return {std::sqrt(least), c.arc[best] + (c.arc[best + 1] - c.arc[best]) * share};
    }

    // A reference face and point below p, a point of triangle t, on the sheet of the triangle.
    std::pair<int, Point> Below(int t, const Point &p) const
    {
        std::pair<int, Foot> best = {-1, Foot()};
        for (const int v : _remesh.mesh.triangle[t].v)
            for (const int face : ReferenceFacesAt(_model, _remesh, v)) {
                const auto found = _model.surface.Project(face, At(v), p, 0);
                if (best.first < 0 || found.second.squaredDistance < best.second.squaredDistance)
                    best = found;
            }
        return {best.first, best.second.point};
    }

    bool OnThinPart(int t, double h)
    {
        const auto [face, p] = Below(t, Centroid(t));
        return _thin.ThicknessAt(face, p, h, 1).has_value();
    }

    // The surface, or a feature curve that the triangle touches, has a radius of curvature below the spacing.
    bool HasFewVertices(int t, double h)
    {
        const auto &T = _remesh.mesh.triangle[t].v;
        for (const int v : T) {
            if (_remesh.place[v].kind != VertexKind::Curve)
                continue;
            const FeatureCurve &c = Curve(_remesh.place[v].curve);
            const double s = _remesh.place[v].s, l = std::min(0.5 * h, 0.25 * c.Length());
            const Point at = Along(c, s), before = at - Along(c, s - l), after = Along(c, s + l) - at;
            // Two chords of length l on a circle of radius R turn by l / R.
            if (SquaredNorm(before) > 0 && SquaredNorm(after) > 0 && AngleBetween(before, after) * h > l)
                return true;
        }
        if (!_orientable)
            return false;
        std::array<Point, 3> where, normal;
        const Point c = Centroid(t);
        for (int k = 0; k < 3; ++k) {
            const auto [face, p] = Below(t, At(T[k]) * 0.75 + c * 0.25);
            where[k] = p;
            normal[k] = _thin.MeanNormal(face, p, h / 3);
        }
        for (int k = 0; k < 3; ++k) {
            const double way = Norm(where[Next(k)] - where[k]);
            // Of points that lie close together the turn says little.
            if (way > 0.25 * h && AngleBetween(normal[k], normal[Next(k)]) * h > way)
                return true;
        }
        return false;
    }
};

} // namespace ccdm
} // namespace vcg

#endif
