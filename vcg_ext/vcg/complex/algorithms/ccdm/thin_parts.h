// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_THIN_PARTS_H
#define VCG_CCDM_THIN_PARTS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vcg/complex/algorithms/ccdm/disjoint_sets.h>
#include <vcg/complex/algorithms/ccdm/parameters.h>
#include <vcg/complex/algorithms/ccdm/patch_schedule.h>
#include <vcg/complex/algorithms/ccdm/remesh.h>
#include <vcg/complex/algorithms/ccdm/spaced_points.h>

namespace vcg {
namespace ccdm {

/// Finds where the wanted spacing is larger than the thickness of the surface or than the distance between two
/// of its features, so that no mesh of that spacing can be good there. Looks at samples as dense as the
/// spacing; changes nothing.
class ThinParts
{
public:
    /// A place counts as narrow when it is narrower than this many spacings: about 2 sin(20 degrees), below which
    /// one edge across and two of the spacing make an angle under 40 degrees.
    static constexpr double NarrowShare = 0.7;

    ThinParts(const Model &model, Workers &workers)
        : _model(model), _surface(model.surface), _mesh(model.surface.mesh), _sample(LaySamples(model, workers)),
          _grid(Points(_sample), Spacings(_sample)), _normals(BoundNormals(workers)), _flooding(workers)
    {
    }
    explicit ThinParts(const Model &model) : ThinParts(model, *std::make_unique<Workers>(1)) {}

    /// The narrow places, the narrowest in units of the spacing first; one entry for each connected part. With no
    /// more workers than the constructor was given.
    std::vector<NarrowPlace> Find(Workers &workers)
    {
        std::vector<NarrowPlace> places = OnePerPart(ThinSamples(workers));
        const std::vector<NarrowPlace> features = OnePerPart(CloseFeatures());
        places.insert(places.end(), features.begin(), features.end());
        std::stable_sort(places.begin(), places.end(), Narrower);
        return places;
    }

    std::vector<NarrowPlace> Find()
    {
        Workers alone(1);
        return Find(alone);
    }

    /// Thickness of the surface at a point of a face, if it is less than `share` spacings: another sheet lies
    /// behind it, or it bends around on itself within the spacing. A gap outside is no thin part, and a surface
    /// that has no inside has none.
    std::optional<double> ThicknessAt(int face, const Point &p, double spacing, double share)
    {
        return ThicknessAt(face, p, spacing, share, _flooding[0]);
    }

    /// Unit normal averaged over the surface within `reach` of a point of a face, without crossing a feature.
    Point MeanNormal(int face, const Point &p, double reach)
    {
        Point sum(0, 0, 0);
        Flood(face, p, reach, false, _flooding[0], [&](int t) {
            const Point n = _surface.AreaVector(t);
            const double size = Norm(n), most = reach * reach;
            sum += n * (size > most ? most / size : 1);
            return true;
        });
        return Normalized(sum);
    }

private:
    struct Sample {
        Point point, normal;
        double spacing;
        int face;
    };
    struct CurveSpot {
        Point point;
        double spacing, s;
        int curve, segment;
    };
    // Scratch of a worker.
    struct Flooding {
        std::vector<int> stamp, queue; // stamp: of the faces that were seen
        int tick = 0;
    };

    const Model &_model;
    const ReferenceSurface &_surface;
    const Triangulation &_mesh;
    const std::vector<Sample> _sample;
    const SpacedPoints _grid;
    const std::vector<Bounds> _normals; // of the samples of each cell
    PerWorker<Flooding> _flooding;
    std::once_flag _outwardKnown;
    std::vector<signed char> _outward; // 1: the face's normal points outwards, -1: inwards, 0: there is no outside

    static constexpr double Opposed = -0.7;
    static constexpr double SamplesPerSquare = 4; // samples in a square of the spacing
    static constexpr int MostSamples = 1000000;
    static constexpr double BentRound = 0.4;
    static constexpr int MostFaces = 5000; // of a flood
    static constexpr double CornerReach = 2;

    std::vector<NarrowPlace> ThinSamples(Workers &workers)
    {
        // Every other sample is asked, all answer.
        const int asked = (static_cast<int>(_sample.size()) + 1) / 2;
        std::vector<std::vector<NarrowPlace>> found(Chunks::Count(asked));
        workers.For(Chunks::Count(asked), [&](int chunk, int worker) {
            for (int i = chunk * Chunks::Size; i < std::min(asked, (chunk + 1) * Chunks::Size); ++i) {
                const Sample &s = _sample[2 * static_cast<std::size_t>(i)];
                if (const auto width = ThicknessAt(s.face, s.point, s.spacing, NarrowShare, _flooding[worker]))
                    found[chunk].push_back(Place(NarrowKind::ThinPart, s.point, *width, s.spacing));
            }
        });
        std::vector<NarrowPlace> all;
        for (const std::vector<NarrowPlace> &places : found)
            all.insert(all.end(), places.begin(), places.end());
        return all;
    }

    std::vector<Bounds> BoundNormals(Workers &workers) const
    {
        std::vector<Bounds> normals(_grid.CellCount());
        Chunks::For(workers, _grid.CellCount(), [&](int first, int last, int) {
            for (int c = first; c < last; ++c)
                _grid.VisitCell(c, [&](int i) { normals[c].Add(_sample[i].normal); });
        });
        return normals;
    }

    // Whether a cell may have a normal that is opposed to n.
    bool MayOppose(int cell, const Point &n) const
    {
        const Bounds &b = _normals[cell];
        double least = 0;
        for (int k = 0; k < 3; ++k)
            least += std::min(n[k] * b.low[k], n[k] * b.high[k]);
        return least <= Opposed + 1e-9;
    }

    std::optional<double> ThicknessAt(int face, const Point &p, double spacing, double share, Flooding &flooding)
    {
        const Point n = Normalized(_surface.AreaVector(face));
        if (!(SquaredNorm(n) > 0))
            return {};
        int other = -1;
        double width = 0, nearest = spacing * spacing;
        const auto look = [&](int i) {
            const Sample &s = _sample[i];
            const Point d = s.point - p;
            const double away = SquaredNorm(d);
            if (away >= nearest || s.face == face || Dot(n, s.normal) > Opposed)
                return;
            const double ahead = Dot(d, n), behind = Dot(d, s.normal);
            const double gap = std::max(std::abs(ahead), std::abs(behind));
            if (gap >= share * spacing || Outside(face, ahead) || Outside(s.face, -behind))
                return;
            nearest = away;
            other = i;
            width = gap;
        };
        _grid.VisitCellsNear(p, spacing, [&](int cell) {
            if (MayOppose(cell, n))
                _grid.VisitCell(cell, look);
        });
        if (other < 0 || !Apart(face, _sample[other].face, p, spacing, flooding))
            return {};
        return width;
    }

    template <class Item>
    static std::vector<Point> Points(const std::vector<Item> &items)
    {
        std::vector<Point> p;
        p.reserve(items.size());
        for (const Item &i : items)
            p.push_back(i.point);
        return p;
    }
    template <class Item>
    static std::vector<double> Spacings(const std::vector<Item> &items)
    {
        std::vector<double> h;
        h.reserve(items.size());
        for (const Item &i : items)
            h.push_back(i.spacing);
        return h;
    }

    // In equal strides of the area in units of the squared spacing, at random places of their faces.
    static std::vector<Sample> LaySamples(const Model &model, Workers &workers)
    {
        const ReferenceSurface &surface = model.surface;
        const std::vector<double> &h = model.density.spacing;
        std::vector<double> measure(surface.FaceCount());
        double total = 0;
        for (int t = 0; t < surface.FaceCount(); ++t) {
            const auto &v = surface.mesh.triangle[t].v;
            const double mean = (h[v[0]] + h[v[1]] + h[v[2]]) / 3;
            total += Norm(surface.AreaVector(t)) / (mean * mean);
            measure[t] = total;
        }
        const int count = static_cast<int>(std::clamp(SamplesPerSquare * total, 1.0, static_cast<double>(MostSamples)));
        std::vector<Sample> samples(count);
        Random random(1);
        int face = 0;
        for (int i = 0; i < count; ++i) {
            const double want = total * (i + 0.5) / count;
            while (face + 1 < surface.FaceCount() && measure[face] < want)
                ++face;
            samples[i].face = face;
            samples[i].point[0] = random.Unit();
            samples[i].point[1] = random.Unit();
        }
        Chunks::For(workers, count, [&](int first, int last, int) {
            for (int i = first; i < last; ++i) {
                const int t = samples[i].face;
                const double r = std::sqrt(samples[i].point[0]), w = samples[i].point[1];
                const SurfacePoint p = {t, {1 - r, r * (1 - w), r * w}};
                samples[i] = {surface.At(p), Normalized(surface.AreaVector(t)), surface.Interpolate(p, h), t};
            }
        });
        const auto flat = [](const Sample &s) { return !(SquaredNorm(s.normal) > 0); };
        samples.erase(std::remove_if(samples.begin(), samples.end(), flat), samples.end());
        return samples;
    }

    static NarrowPlace Place(NarrowKind kind, const Point &p, double width, double spacing)
    {
        return {kind, {p[0], p[1], p[2]}, width, spacing};
    }
    static bool Narrower(const NarrowPlace &a, const NarrowPlace &b)
    {
        return a.width * b.spacing < b.width * a.spacing;
    }

    // Calls visit(face) for the faces that are connected with `from` within `reach` of p until it returns false.
    template <class Visit>
    void Flood(int from, const Point &p, double reach, bool acrossFeatures, Flooding &flooding,
               const Visit &visit) const
    {
        auto &[stamp, queue, tick] = flooding;
        if (stamp.empty())
            stamp.assign(_surface.FaceCount(), 0);
        ++tick;
        queue.assign(1, from);
        stamp[from] = tick;
        for (std::size_t k = 0; k < queue.size() && k < MostFaces; ++k) {
            if (!visit(queue[k]))
                return;
            const Triangle &T = _mesh.triangle[queue[k]];
            for (int e = 0; e < 3; ++e) {
                const Side link = T.n[e];
                if (link == NoSide || (T.Constrained(e) && !acrossFeatures) || stamp[SideTriangle(link)] == tick)
                    continue;
                stamp[SideTriangle(link)] = tick;
                if (_surface.NearestOn(SideTriangle(link), p).squaredDistance <= reach * reach)
                    queue.push_back(SideTriangle(link));
            }
        }
    }

    // Whether two opposed faces belong to different sheets, or to one that bends round within the spacing. Where
    // the way between them is short but crosses a feature, they are the sides of a rim or a wedge.
    bool Apart(int a, int b, const Point &p, double spacing, Flooding &flooding) const
    {
        bool met = false;
        Point sum(0, 0, 0);
        double area = 0;
        Flood(a, p, spacing, false, flooding, [&](int t) {
            const Point n = _surface.AreaVector(t);
            const double size = Norm(n), most = spacing * spacing;
            // Large faces do not lie in the ball.
            const double weight = size > most ? most / size : 1;
            sum += n * weight;
            area += size * weight;
            met = met || t == b;
            return true;
        });
        if (met)
            return Norm(sum) < BentRound * area;
        Flood(a, p, 1.5 * spacing, true, flooding, [&](int t) {
            met = t == b;
            return !met;
        });
        return !met;
    }

    // Whether what lies `ahead` of a face, along its normal, is outside; what has no inside is all outside.
    bool Outside(int face, double ahead)
    {
        std::call_once(_outwardKnown, [this] { FindOutside(); });
        return _outward[face] == 0 || ahead * _outward[face] > 0;
    }

    // By the volume that each component encloses, if it is orientable and encloses some; an open one not quite.
    void FindOutside()
    {
        _outward.assign(_surface.FaceCount(), 0);
        std::vector<char> seen(_surface.FaceCount(), 0);
        std::vector<int> part;
        for (int t0 = 0; t0 < _surface.FaceCount(); ++t0) {
            if (seen[t0])
                continue;
            seen[t0] = 1;
            part.assign(1, t0);
            bool sided = true, closed = true;
            double volume = 0, area = 0;
            Point sum(0, 0, 0), moment(0, 0, 0);
            for (std::size_t k = 0; k < part.size(); ++k) {
                const Triangle &T = _mesh.triangle[part[k]];
                const Point n = _surface.AreaVector(part[k]);
                const Point &x = _surface.position[T.v[0]];
                volume += Dot(n, x);
                sum += n;
                moment += x * Norm(n);
                area += Norm(n);
                for (int e = 0; e < 3; ++e) {
                    const Side s = MakeSide(part[k], e), mate = _mesh.Mate(s);
                    if (mate == NoSide) {
                        closed = false;
                        continue;
                    }
                    sided = sided && _mesh.Coherent(s);
                    if (!seen[SideTriangle(mate)]) {
                        seen[SideTriangle(mate)] = 1;
                        part.push_back(SideTriangle(mate));
                    }
                }
            }
            if (area > 0)
                volume -= Dot(sum, moment / area); // as seen from the centroid
            if (sided && std::abs(volume) > (closed ? 1e-9 : 3e-3) * std::pow(area, 1.5))
                for (const int t : part)
                    _outward[t] = static_cast<signed char>(volume > 0 ? 1 : -1);
        }
    }

    std::vector<NarrowPlace> CloseFeatures()
    {
        std::vector<NarrowPlace> found;
        const std::vector<CurveSpot> spots = LaySpots();
        const SpacedPoints grid(Points(spots), Spacings(spots));
        for (const CurveSpot &a : spots) {
            const FeatureCurve &c = _model.features.curve[a.curve];
            const double most = NarrowShare * a.spacing;
            // A curve that is too short in itself; for a closed one its width counts.
            double width = c.closed ? c.Length() / Pi : c.Length();
            bool narrow = width < most;
            grid.VisitNear(a.point, a.spacing, [&](int k) {
                const CurveSpot &b = spots[k];
                if (&b == &a || Adjacent(a, b))
                    return;
                const auto [segment, distance] = Nearest(a.point, b);
                if (distance < (narrow ? std::min(width, most) : most) && Joined(a, b.curve, segment, distance)) {
                    narrow = true;
                    width = distance;
                }
            });
            if (narrow)
                found.push_back(Place(NarrowKind::CloseFeatures, a.point, width, a.spacing));
        }
        return found;
    }

    // Two in a spacing along every curve, one at least.
    std::vector<CurveSpot> LaySpots() const
    {
        std::vector<CurveSpot> spots;
        const std::vector<double> &h = _model.density.spacing;
        for (std::size_t i = 0; i < _model.features.curve.size(); ++i) {
            const FeatureCurve &c = _model.features.curve[i];
            std::vector<double> measure(c.vertex.size(), 0);
            for (int k = 0; k < c.Segments(); ++k)
                measure[k + 1] = measure[k] + c.InSpacings(k, h);
            const int count = std::max(1, static_cast<int>(std::min(2 * measure.back(), 1.0 * MostSamples)));
            int k = 0;
            for (int j = 0; j < count; ++j) {
                const double want = measure.back() * (j + 0.5) / count;
                while (k + 1 < c.Segments() && measure[k + 1] < want)
                    ++k;
                const double l = measure[k + 1] - measure[k];
                const double share = l > 0 ? std::clamp((want - measure[k]) / l, 0.0, 1.0) : 0;
                const int a = c.vertex[k], b = c.vertex[k + 1];
                spots.push_back({_surface.position[a] + (_surface.position[b] - _surface.position[a]) * share,
                                 h[a] + (h[b] - h[a]) * share, c.arc[k] + (c.arc[k + 1] - c.arc[k]) * share,
                                 static_cast<int>(i), k});
            }
        }
        return spots;
    }

    // Whether two spots are near for being neighbours along a curve or around a corner.
    bool Adjacent(const CurveSpot &a, const CurveSpot &b) const
    {
        const FeatureCurve &c = _model.features.curve[a.curve], &d = _model.features.curve[b.curve];
        if (a.curve == b.curve) {
            double way = std::abs(a.s - b.s);
            if (c.vertex.front() == c.vertex.back())
                way = std::min(way, c.Length() - way);
            return way < CornerReach * a.spacing || way < 2.5 * Norm(a.point - b.point);
        }
        for (const bool first : {true, false})
            for (const bool second : {true, false}) {
                if ((first ? c.vertex.front() : c.vertex.back()) != (second ? d.vertex.front() : d.vertex.back()))
                    continue;
                const double r = first ? a.s : c.Length() - a.s, q = second ? b.s : d.Length() - b.s;
                if (std::max(r, q) <= CornerReach * a.spacing)
                    return true;
            }
        return false;
    }

    // Segment of a spot's curve nearest to p, downhill from the spot, and its distance.
    std::pair<int, double> Nearest(const Point &p, const CurveSpot &spot) const
    {
        const FeatureCurve &c = _model.features.curve[spot.curve];
        const auto squared = [&](int k) {
            const Point &a = _surface.position[c.vertex[k]];
            return SegmentSquaredDistance(p, a, _surface.position[c.vertex[k + 1]] - a);
        };
        int best = spot.segment;
        double least = squared(best);
        for (const int step : {-1, 1})
            for (int k = best + step; k >= 0 && k < c.Segments(); k += step) {
                const double d = squared(k);
                if (d > least)
                    break;
                least = d;
                best = k;
            }
        return {best, std::sqrt(least)};
    }

    // Whether the surface joins a spot with a segment at this distance, without a feature between.
    bool Joined(const CurveSpot &a, int curve, int segment, double distance)
    {
        const Side from = _model.features.curve[a.curve].side[a.segment];
        const Side to = _model.features.curve[curve].side[segment];
        const Point &tail = _surface.position[_mesh.Tail(to)];
        const Point along = _surface.position[_mesh.Head(to)] - tail;
        const double l = SquaredNorm(along);
        const Point foot = tail + along * (l > 0 ? std::clamp(Dot(a.point - tail, along) / l, 0.0, 1.0) : 0.0);
        bool met = false;
        for (const Side s : {from, _mesh.Mate(from)}) {
            if (s == NoSide || met)
                continue;
            const Point middle = (a.point + foot) / 2;
            Flood(SideTriangle(s), middle, 0.75 * distance, false, _flooding[0], [&](int t) {
                met = t == SideTriangle(to) || (_mesh.Mate(to) != NoSide && t == SideTriangle(_mesh.Mate(to)));
                return !met;
            });
        }
        return met;
    }

    // Of places that follow one another within a spacing, the narrowest.
    static std::vector<NarrowPlace> OnePerPart(const std::vector<NarrowPlace> &found)
    {
        std::vector<Point> point;
        std::vector<double> spacing;
        for (const NarrowPlace &f : found) {
            point.push_back(Point(f.position[0], f.position[1], f.position[2]));
            spacing.push_back(f.spacing);
        }
        const SpacedPoints grid(point, spacing);
        DisjointSets parts(found.size());
        for (std::size_t i = 0; i < found.size(); ++i)
            grid.VisitNear(point[i], spacing[i], [&](int k) {
                if (SquaredNorm(point[k] - point[i]) <= spacing[i] * spacing[i])
                    parts.Join(static_cast<int>(i), k);
            });
        std::vector<int> narrowest(found.size(), -1);
        for (std::size_t i = 0; i < found.size(); ++i) {
            int &best = narrowest[parts.SetOf(static_cast<int>(i))];
            if (best < 0 || Narrower(found[i], found[best]))
                best = static_cast<int>(i);
        }
        std::vector<NarrowPlace> places;
        for (const int k : narrowest)
            if (k >= 0)
                places.push_back(found[k]);
        return places;
    }
};

/// A sentence on the narrow places of one kind, the first few with their figures; empty if there are none.
inline std::string NarrowWarning(const std::vector<NarrowPlace> &places, NarrowKind kind)
{
    constexpr int shown = 3;
    const auto text = [](double x) {
        std::array<char, 32> s = {};
        std::snprintf(s.data(), s.size(), "%.4g", x);
        return std::string(s.data());
    };
    const bool thin = kind == NarrowKind::ThinPart;
    int count = 0;
    std::string list;
    for (const NarrowPlace &p : places) {
        if (p.kind != kind || ++count > shown)
            continue;
        list += (count == 1 ? " (" : "), (") + text(p.position[0]) + ", " + text(p.position[1]) + ", " +
                text(p.position[2]) + ": " + text(p.width) + (thin ? " thick" : " apart") + " at a spacing of " +
                text(p.spacing) + ", " +
                (p.vertices <= 1e8 ? std::to_string(static_cast<long long>(p.vertices)) + " vertices would resolve it"
                                   : std::string("no vertex count resolves it"));
    }
    if (count == 0)
        return "";
    return std::string(thin ? "the surface is thinner" : "features are closer together") +
           " than the spacing allows at " + std::to_string(count) + (count == 1 ? " place:" : " places:") + list +
           (count > shown ? "), ..." : ")");
}

} // namespace ccdm
} // namespace vcg

#endif
