// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_INITIAL_MESH_H
#define VCG_CCDM_INITIAL_MESH_H

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <vcg/complex/algorithms/ccdm/patch_schedule.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>
#include <vcg/complex/algorithms/ccdm/sampling.h>
#include <vcg/complex/algorithms/ccdm/vertex_removal.h>

namespace vcg {
namespace ccdm {

/// Connects samples into a mesh of the input's topology: they are inserted into a copy of the input's
/// triangulation (the mutual tessellation of [Tur92]), then the original vertices are removed
/// (paper, section 3.2). Feature edges stay chains of edges throughout.
class InitialMeshBuilder
{
public:
    /// Called with the share of the work done, in [0, 1]; false stops the build.
    using Progress = std::function<bool(double)>;

    InitialMeshBuilder(const Model &model, const SampleSet &samples)
        : _surface(model.surface), _features(model.features), _density(model.density), _samples(samples)
    {
    }

    /// The mesh of the samples. More vertices than samples remain where topology asks for them. False
    /// when `progress` stopped it.
    bool Build(Remesh &out, Workers &workers, const Progress &progress)
    {
        _mesh = _surface.mesh;
        for (int t = 0; t < _mesh.TriangleCount(); ++t)
            _mesh.triangle[t].label = t;
        _position = _surface.position;
        _originals = static_cast<int>(_position.size());
        _place.assign(_originals, Place());
        _kept.assign(_originals, 0);
        _home.assign(_originals, Home());
        for (int v = 0; v < _originals; ++v)
            _place[v].face = _mesh.incident[v];
        PlaceOriginals();
        InsertCurveSamples();
        InsertFaceSamples(workers);
        if (!progress(0.3))
            return false;
        const int wanted = static_cast<int>(std::count(_kept.begin(), _kept.end(), char(1)));
        VertexRemoval removal(_mesh, _position, _place, RegionOfEach(), workers);
        if (!removal.RemoveAll(_kept, wanted, [&](double x) { return progress(0.3 + 0.7 * x); }))
            return false;
        Finish(out, workers);
        return true;
    }
    /// The same on one thread.
    bool Build(Remesh &out, const Progress &progress)
    {
        Workers alone(1);
        return Build(out, alone, progress);
    }

private:
    // Barycentric home of an inserted vertex: a face with weights, or an edge with a fraction.
    struct Home {
        int face = -1;
        double w1 = 0, w2 = 0;
        int a = -1, b = -1;
        double t = 0;
    };
    struct Flat {
        double x, y;
    };

    const ReferenceSurface &_surface;
    const FeatureGraph &_features;
    const DensityField &_density;
    const SampleSet &_samples;
    Triangulation _mesh;
    std::vector<Point> _position;
    std::vector<Place> _place;
    std::vector<Home> _home;
    std::vector<char> _kept;
    int _originals = 0;

    void PlaceOriginals()
    {
        for (std::size_t i = 0; i < _features.curve.size(); ++i) {
            const FeatureCurve &c = _features.curve[i];
            for (int k = 0; k < c.Segments(); ++k) {
                Place &p = _place[c.vertex[k]];
                p.kind = VertexKind::Curve;
                p.curve = static_cast<int>(i);
                p.segment = k;
                p.s = c.arc[k];
                p.face = SideTriangle(c.side[k]);
            }
        }
        for (const int v : _features.corner) {
            _place[v].kind = VertexKind::Corner;
            _kept[v] = 1;
        }
    }

    int AddVertex(const Point &p, const Place &place, const Home &home)
    {
        _position.push_back(p);
        _place.push_back(place);
        _home.push_back(home);
        _kept.push_back(1);
        return static_cast<int>(_position.size()) - 1;
    }

    void InsertCurveSamples()
    {
        int curve = -1, segment = 0, previous = -1;
        for (const CurveSample &sample : _samples.onCurves) {
            const FeatureCurve &c = _features.curve[sample.curve];
            if (sample.curve != curve) {
                curve = sample.curve;
                segment = 0;
                previous = c.vertex[0];
            }
            const int k = c.SegmentAt(sample.s, segment);
            if (k != segment)
                previous = c.vertex[k];
            segment = k;
            const int a = c.vertex[k], b = c.vertex[k + 1];
            const double t = c.Fraction(k, sample.s), near = 1e-6;
            // A sample on an original vertex is that vertex, if no other sample took it.
            const int same = t < near ? a : t > 1 - near ? b : -1;
            if (same >= 0 && !_kept[same]) {
                _kept[same] = 1;
                continue;
            }
            const Side s = _mesh.FindEdge(previous, b);
            if (s == NoSide)
                continue;
            Place place;
            place.kind = VertexKind::Curve;
            place.curve = curve;
            place.s = sample.s;
            place.segment = k;
            place.face = SideTriangle(c.side[k]);
            Home home;
            home.a = a;
            home.b = b;
            home.t = t;
            const int v = AddVertex(_position[a] + (_position[b] - _position[a]) * t, place, home);
            _mesh.SplitEdge(s, v);
            previous = v;
        }
    }

    // Position in the plane of a reference face, in units of its first two sides.
    Flat In(int face, int v) const
    {
        const Triangle &R = _surface.mesh.triangle[face];
        auto corner = [&](int original) {
            const int i = R.IndexOf(original);
            return Flat{i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
        };
        if (v < _originals)
            return corner(v);
        const Home &h = _home[v];
        if (h.face >= 0)
            return {h.w1, h.w2};
        const Flat a = corner(h.a), b = corner(h.b);
        return {a.x + (b.x - a.x) * h.t, a.y + (b.y - a.y) * h.t};
    }

    static double Orient(const Flat &a, const Flat &b, const Flat &c)
    {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    }

    // Barycentric weights of p in triangle t of the tessellation of `face`.
    std::array<double, 3> WeightsIn(int t, int face, const Flat &p) const
    {
        const Triangle &T = _mesh.triangle[t];
        const Flat a = In(face, T.v[0]), b = In(face, T.v[1]), c = In(face, T.v[2]);
        const double area = Orient(a, b, c);
        if (area == 0)
            return {-1, -1, -1};
        return {Orient(p, b, c) / area, Orient(a, p, c) / area, Orient(a, b, p) / area};
    }

    static int Least(const std::array<double, 3> &w)
    {
        return static_cast<int>(std::min_element(w.begin(), w.end()) - w.begin());
    }

    // Triangle of the tessellation of `face` that holds p: a walk towards p, and a search of all
    // triangles of the face if rounding sends it around in circles.
    int Locate(int start, int face, const Flat &p) const
    {
        int t = start;
        for (int step = 0; step < 1000; ++step) {
            const auto w = WeightsIn(t, face, p);
            const int e = Least(w);
            if (w[e] >= 0)
                return t;
            const Side mate = _mesh.triangle[t].n[e];
            if (mate == NoSide || _mesh.triangle[SideTriangle(mate)].label != face)
                break;
            t = SideTriangle(mate);
        }
        std::vector<int> all(1, start);
        int best = start;
        double bestWeight = -1e300;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto w = WeightsIn(all[i], face, p);
            const double least = w[Least(w)];
            if (least > bestWeight) {
                bestWeight = least;
                best = all[i];
            }
            for (const Side mate : _mesh.triangle[all[i]].n)
                if (mate != NoSide && _mesh.triangle[SideTriangle(mate)].label == face &&
                    std::find(all.begin(), all.end(), SideTriangle(mate)) == all.end())
                    all.push_back(SideTriangle(mate));
        }
        return best;
    }

    void InsertFaceSamples(Workers &workers)
    {
        // Face by face, and along a curve inside each face, so that every walk is short.
        std::vector<std::pair<std::uint64_t, int>> order(_samples.onFaces.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            const SurfacePoint &p = _samples.onFaces[i];
            order[i] = {MortonCode(Point(p.weight[1], p.weight[2], 0)), static_cast<int>(i)};
        }
        SortInParts(workers, order, [&](const auto &a, const auto &b) {
            const int fa = _samples.onFaces[a.second].face, fb = _samples.onFaces[b.second].face;
            return fa != fb ? fa < fb : a < b;
        });
        int face = -1, hint = -1;
        for (const auto &item : order) {
            const SurfacePoint &p = _samples.onFaces[item.second];
            if (p.face != face) {
                face = p.face;
                hint = face; // the record of a face keeps a part of it
            }
            hint = InsertInFace(hint, face, {p.weight[1], p.weight[2]});
        }
    }

    int InsertInFace(int hint, int face, Flat p)
    {
        const int t = Locate(hint, face, p);
        const auto w = WeightsIn(t, face, p);
        if (!(w[Least(w)] > 1e-4)) {
            // Too near a side or outside by rounding: a little towards the middle.
            const Triangle &T = _mesh.triangle[t];
            const Flat a = In(face, T.v[0]), b = In(face, T.v[1]), c = In(face, T.v[2]);
            std::array<double, 3> q;
            double sum = 0;
            for (int i = 0; i < 3; ++i)
                sum += q[i] = std::clamp(w[i], 0.01, 1.0);
            p.x = (q[0] * a.x + q[1] * b.x + q[2] * c.x) / sum;
            p.y = (q[0] * a.y + q[1] * b.y + q[2] * c.y) / sum;
        }
        Place place;
        place.face = face;
        Home home;
        home.face = face;
        home.w1 = p.x;
        home.w2 = p.y;
        SurfacePoint at;
        at.face = face;
        at.weight[0] = 1 - p.x - p.y;
        at.weight[1] = p.x;
        at.weight[2] = p.y;
        const int v = AddVertex(_surface.At(at), place, home);
        const int t1 = _mesh.TriangleCount();
        _mesh.SplitTriangle(t, v);
        std::vector<Side> &suspect = _suspect;
        suspect.assign({MakeSide(t, 0), MakeSide(t1, 1), MakeSide(t1 + 1, 2)});
        // Delaunay inside the face (Lawson); each flip takes an edge away from v's link, so it ends.
        while (!suspect.empty()) {
            const Side s = suspect.back();
            suspect.pop_back();
            const Side m = _mesh.Mate(s);
            if (m == NoSide || _mesh.triangle[SideTriangle(m)].label != face || !FlipHelps(s, face))
                continue;
            _mesh.Flip(s);
            _mesh.VisitSpokes(v, [&](int, Side x) {
                const int u = SideTriangle(x);
                if (u == SideTriangle(s) || u == SideTriangle(m))
                    suspect.push_back(MakeSide(u, _mesh.triangle[u].IndexOf(v)));
                return true;
            });
        }
        return _mesh.incident[v];
    }
    std::vector<Side> _suspect;

    bool FlipHelps(Side s, int face) const
    {
        const int a = _mesh.Opposite(s), b = _mesh.Opposite(_mesh.Mate(s)), p = _mesh.Tail(s), q = _mesh.Head(s);
        const Flat fa = In(face, a), fb = In(face, b), fp = In(face, p), fq = In(face, q);
        const double sign = Orient(fa, fp, fq) > 0 ? 1 : -1, tiny = 1e-13;
        if (sign * Orient(fa, fp, fb) <= tiny || sign * Orient(fa, fb, fq) <= tiny)
            return false;
        const Point &A = _position[a], &B = _position[b], &P = _position[p], &Q = _position[q];
        const Point ap = P - A, aq = Q - A, bp = P - B, bq = Q - B;
        // cot + cot < 0: the opposite angles sum to more than pi.
        return Dot(ap, aq) * Norm(Cross(bp, bq)) + Dot(bp, bq) * Norm(Cross(ap, aq)) <
               -1e-10 * std::sqrt(SquaredNorm(ap) * SquaredNorm(aq) * SquaredNorm(bp) * SquaredNorm(bq));
    }

    // The input's vertices are numbered along a space-filling curve; what is inserted goes with its face.
    std::vector<int> RegionOfEach() const
    {
        std::vector<int> region(_position.size());
        for (std::size_t v = 0; v < region.size(); ++v)
            region[v] = Regions::Of(static_cast<int>(v) < _originals ? static_cast<int>(v)
                                                                     : _surface.mesh.triangle[_place[v].face].v[0]);
        return region;
    }

    void Finish(Remesh &out, Workers &workers)
    {
        std::vector<int> alive;
        std::vector<Point> where;
        for (int v = 0; v < _mesh.VertexCount(); ++v)
            if (_mesh.incident[v] >= 0) {
                alive.push_back(v);
                where.push_back(_position[v]);
            }
        std::vector<int> order = SpatialOrder(where, workers);
        for (int &k : order)
            k = alive[k];
        _mesh.Compact(order);
        const std::size_t count = order.size();
        out.position.resize(count);
        out.place.resize(count);
        out.rho.resize(count);
        Chunks::For(workers, static_cast<int>(count), [&](int first, int last, int) {
            for (int k = first; k < last; ++k) {
                const int v = order[k];
                out.position[k] = _position[v];
                out.place[k] = _place[v];
                SurfacePoint p;
                p.face = _place[v].face;
                const Foot foot = _surface.NearestOn(p.face, _position[v]);
                std::copy(foot.weight, foot.weight + 3, p.weight);
                out.rho[k] = _surface.Interpolate(p, _density.rho);
            }
        });
        for (Triangle &T : _mesh.triangle)
            T.label = -1;
        out.mesh = std::move(_mesh);
    }
};

} // namespace ccdm
} // namespace vcg

#endif
