// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_TRIANGULATION_H
#define VCG_CCDM_TRIANGULATION_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <vcg/space/point3.h>

#include <vcg/complex/algorithms/ccdm/parameters.h>

namespace vcg {
namespace ccdm {

using Point = Point3<double>;

/// Side of a triangle: 4 * triangle + local index of the opposite vertex; -1 is no side.
using Side = int;
constexpr Side NoSide = -1;
inline Side MakeSide(int t, int e)
{
    return 4 * t + e;
}
inline int SideTriangle(Side s)
{
    return s >> 2;
}
inline int SideEdge(Side s)
{
    return s & 3;
}
inline int Next(int i)
{
    return i == 2 ? 0 : i + 1;
}
inline int Prev(int i)
{
    return i == 0 ? 2 : i - 1;
}

/// A triangle: its vertices, and for each side the side that it is glued to.
/// Gluing carries no orientation, so that a non-orientable surface needs no special case.
struct Triangle {
    int v[3];
    Side n[3];
    std::uint8_t constrained = 0; ///< bit e: the side opposite v[e] is a feature and is never flipped
    std::uint8_t dead = 0;
    std::uint16_t mark = 0; ///< scratch of the algorithm at work
    int label = -1;         ///< face of the reference surface that it lies in, while that is known

    int IndexOf(int vertex) const { return v[0] == vertex ? 0 : v[1] == vertex ? 1 : 2; }
    bool Constrained(int e) const { return (constrained >> e) & 1; }
    void SetConstrained(int e, bool on)
    {
        constrained = static_cast<std::uint8_t>(on ? constrained | (1U << e) : constrained & ~(1U << e));
    }
};

/// The star of a vertex in walking order: triangle k lies between the outer vertices k and k + 1;
/// in a closed star the outer vertices wrap around.
struct Star {
    std::vector<int> outer;
    std::vector<Side> corner; ///< side of triangle k opposite the centre
    bool closed = true;

    int Triangles() const { return static_cast<int>(corner.size()); }
    int OuterAfter(int k) const { return outer[closed && k + 1 == Triangles() ? 0 : k + 1]; }
};

/// Triangle-neighbour tables of a 2-manifold with or without boundary, orientable or not.
class Triangulation
{
public:
    std::vector<Triangle> triangle;
    std::vector<int> incident; ///< one live triangle of each vertex; -1 for a dead vertex

    /// Outer vertices of a star in walking order, each with its marks; -1 after the last if there is room.
    static constexpr int MostInRing = 8;
    using Ring = std::array<int, MostInRing>;
    /// Marks of an entry of a ring beside the number, which must be less than RingWall: the side between this outer
    /// vertex and the next is constrained; the edge to this one is, or ends the star; (of the first entry) the star is
    /// open.
    static constexpr int RingWall = 1 << 28, RingSpoke = 1 << 29, RingOpen = 1 << 30, RingNumber = RingWall - 1;

    int VertexCount() const { return static_cast<int>(incident.size()); }
    int TriangleCount() const { return static_cast<int>(triangle.size()); }

    /// Glues triangles along equal vertex pairs. The caller has made sure that no edge has more than
    /// two faces and that no vertex has more than one fan.
    void Build(int vertexCount, const std::vector<std::array<int, 3>> &faces)
    {
        ForgetRings();
        triangle.assign(faces.size(), Triangle());
        incident.assign(vertexCount, -1);
        for (std::size_t t = 0; t < faces.size(); ++t)
            for (int i = 0; i < 3; ++i) {
                triangle[t].v[i] = faces[t][i];
                triangle[t].n[i] = NoSide;
                incident[faces[t][i]] = static_cast<int>(t);
            }
        // Sides bucketed by their smaller vertex: linear, and no hashing.
        std::vector<int> start(vertexCount + 1, 0);
        auto low = [&](int t, int e) { return std::min(triangle[t].v[Next(e)], triangle[t].v[Prev(e)]); };
        auto high = [&](int t, int e) { return std::max(triangle[t].v[Next(e)], triangle[t].v[Prev(e)]); };
        const int count = TriangleCount();
        for (int t = 0; t < count; ++t)
            for (int e = 0; e < 3; ++e)
                ++start[low(t, e) + 1];
        for (int v = 0; v < vertexCount; ++v)
            start[v + 1] += start[v];
        std::vector<Side> bucket(3 * static_cast<std::size_t>(count));
        std::vector<int> fill(start.begin(), start.end() - 1);
        for (int t = 0; t < count; ++t)
            for (int e = 0; e < 3; ++e)
                bucket[fill[low(t, e)]++] = MakeSide(t, e);
        for (int v = 0; v < vertexCount; ++v) {
            const auto first = bucket.begin() + start[v], last = bucket.begin() + start[v + 1];
            std::sort(first, last, [&](Side a, Side b) {
                const int ha = high(SideTriangle(a), SideEdge(a)), hb = high(SideTriangle(b), SideEdge(b));
                return ha != hb ? ha < hb : a < b;
            });
            for (auto s = first; s != last && s + 1 != last; ++s) {
                const Side a = s[0], b = s[1];
                if (high(SideTriangle(a), SideEdge(a)) == high(SideTriangle(b), SideEdge(b)))
                    Glue(a, b);
            }
        }
    }

    Side Mate(Side s) const { return triangle[SideTriangle(s)].n[SideEdge(s)]; }
    int Opposite(Side s) const { return triangle[SideTriangle(s)].v[SideEdge(s)]; }
    /// The two ends of a side, in the order of its own triangle.
    int Tail(Side s) const { return triangle[SideTriangle(s)].v[Next(SideEdge(s))]; }
    int Head(Side s) const { return triangle[SideTriangle(s)].v[Prev(SideEdge(s))]; }
    bool Constrained(Side s) const { return triangle[SideTriangle(s)].Constrained(SideEdge(s)); }
    /// Marks both sides of an edge.
    void SetConstrained(Side s, bool on)
    {
        ForgetRings();
        triangle[SideTriangle(s)].SetConstrained(SideEdge(s), on);
        const Side m = Mate(s);
        if (m != NoSide)
            triangle[SideTriangle(m)].SetConstrained(SideEdge(m), on);
    }
    /// Whether the triangles on both sides of a glued edge are oriented alike.
    bool Coherent(Side s) const { return Tail(s) == Head(Mate(s)); }

    /// Walks around a vertex from triangle to triangle. Inside a triangle with the centre at local
    /// index i, entered over side e, the next side to cross is 3 - i - e: no orientation is used, and
    /// each star comes out consistently oriented in itself.
    void GatherStar(int v, Star &star) const
    {
        star.outer.clear();
        star.corner.clear();
        star.closed = true;
        const int first = incident[v];
        int t = first, i = triangle[t].IndexOf(v), j = Next(i);
        for (;;) {
            const Triangle &T = triangle[t];
            star.corner.push_back(MakeSide(t, i));
            star.outer.push_back(T.v[j]);
            const Side s = T.n[j];
            if (s == NoSide)
                break;
            t = SideTriangle(s);
            if (t == first)
                return;
            i = triangle[t].IndexOf(v);
            j = 3 - i - SideEdge(s);
        }
        GatherOpenStar(v, star);
    }

    /// Side between a and b, or NoSide.
    Side FindEdge(int a, int b) const
    {
        Side found = NoSide;
        VisitSpokes(a, [&](int outer, Side s) {
            if (outer == b)
                found = s;
            return outer != b;
        });
        return found;
    }

    /// Calls visit(outer vertex, a side of that edge) for each edge at v until it returns false.
    template <class Visit>
    void VisitSpokes(int v, Visit visit) const
    {
        const int first = incident[v];
        int t = first, i = triangle[t].IndexOf(v), j = Next(i);
        const int back = Prev(i);
        for (;;) {
            const Triangle &T = triangle[t];
            const int k = 3 - i - j;
            if (!visit(T.v[k], MakeSide(t, j)))
                return;
            const Side s = T.n[j];
            if (s == NoSide)
                break;
            t = SideTriangle(s);
            if (t == first)
                return;
            i = triangle[t].IndexOf(v);
            j = 3 - i - SideEdge(s);
        }
        // Open star: the other half, from the first triangle backwards.
        t = first;
        j = back;
        i = triangle[t].IndexOf(v);
        for (;;) {
            const Triangle &T = triangle[t];
            if (!visit(T.v[3 - i - j], MakeSide(t, j)))
                return;
            const Side s = T.n[j];
            if (s == NoSide)
                return;
            t = SideTriangle(s);
            i = triangle[t].IndexOf(v);
            j = 3 - i - SideEdge(s);
        }
    }

    /// Calls visit(side) once for every edge, with the side of the lower number.
    template <class Visit>
    void VisitEdges(const Visit &visit) const
    {
        VisitEdges(0, TriangleCount(), visit);
    }

    /// The same for the edges of which that is a side of one of the triangles in [first, last).
    template <class Visit>
    void VisitEdges(int first, int last, const Visit &visit) const
    {
        for (int t = first; t < last; ++t)
            for (int e = 0; e < 3; ++e) {
                const Side s = MakeSide(t, e);
                if (Mate(s) == NoSide || s < Mate(s))
                    visit(s);
            }
    }

    /// From now on until the next change other than a flip, rings that are given to KeepRing are known for
    /// as long as no flip changes them. A sweep over known rings reads no triangles.
    void KeepRings() { _ring.assign(incident.size(), {-1}); }
    bool KeepsRingsOf(int count) const { return !_ring.empty() && count <= MostInRing; }
    void KeepRing(int v, const Ring &ring) { _ring[v] = ring; }
    /// For callers that write triangles themselves.
    void ForgetRing(int v)
    {
        if (!_ring.empty())
            _ring[v][0] = -1;
    }
    const Ring *KnownRing(int v) const { return !_ring.empty() && _ring[v][0] >= 0 ? &_ring[v] : nullptr; }

    int Valence(int v) const
    {
        int count = 0;
        VisitSpokes(v, [&](int, Side) {
            ++count;
            return true;
        });
        return count;
    }

    bool OnBoundary(int v) const
    {
        bool boundary = false;
        VisitSpokes(v, [&](int, Side s) {
            boundary = boundary || Mate(s) == NoSide;
            return !boundary;
        });
        return boundary;
    }

    /// Replaces the edge of side s by the other diagonal of its two triangles. The caller has checked
    /// that the edge has two triangles and that the other diagonal is not an edge already.
    /// Returns the side of the new edge in the first triangle.
    Side Flip(Side s)
    {
        const int t = SideTriangle(s), e = SideEdge(s), e1 = Next(e), e2 = Prev(e);
        const Side m = triangle[t].n[e];
        const int u = SideTriangle(m), f = SideEdge(m);
        Triangle &T = triangle[t], &U = triangle[u];
        const int a = T.v[e], p = T.v[e1], q = T.v[e2], b = U.v[f];
        const int up = U.IndexOf(p), uq = U.IndexOf(q);
        const Side outerPB = U.n[uq], outerBQ = U.n[up], outerAQ = T.n[e1];
        const bool cPB = U.Constrained(uq), cBQ = U.Constrained(up), cAQ = T.Constrained(e1);
        T.v[e2] = b;
        T.SetConstrained(e, cPB);
        T.SetConstrained(e1, false);
        U.v[0] = a;
        U.v[1] = b;
        U.v[2] = q;
        U.SetConstrained(0, cBQ);
        U.SetConstrained(1, cAQ);
        U.SetConstrained(2, false);
        Glue(MakeSide(t, e), outerPB);
        Glue(MakeSide(u, 0), outerBQ);
        Glue(MakeSide(u, 1), outerAQ);
        Glue(MakeSide(t, e1), MakeSide(u, 2));
        incident[a] = incident[p] = incident[b] = t;
        incident[q] = u;
        if (!_ring.empty())
            _ring[a][0] = _ring[b][0] = _ring[p][0] = _ring[q][0] = -1;
        return MakeSide(t, e1);
    }

    /// Puts the new vertex v into triangle t, which becomes three.
    void SplitTriangle(int t, int v)
    {
        const int t1 = TriangleCount(), t2 = t1 + 1;
        triangle.resize(triangle.size() + 2, triangle[t]);
        Grow(v);
        Triangle &T = triangle[t], &T1 = triangle[t1], &T2 = triangle[t2];
        const Side n1 = T.n[1], n2 = T.n[2];
        const bool c1 = T.Constrained(1), c2 = T.Constrained(2);
        // t keeps side 0; t1 takes side 1, t2 side 2; the new vertex replaces the opposite corner.
        T.v[0] = v;
        T1.v[1] = v;
        T2.v[2] = v;
        T.constrained = static_cast<std::uint8_t>(T.constrained & 1U);
        T1.constrained = static_cast<std::uint8_t>(c1 ? 2U : 0U);
        T2.constrained = static_cast<std::uint8_t>(c2 ? 4U : 0U);
        Glue(MakeSide(t1, 1), n1);
        Glue(MakeSide(t2, 2), n2);
        Glue(MakeSide(t, 1), MakeSide(t1, 0));
        Glue(MakeSide(t, 2), MakeSide(t2, 0));
        Glue(MakeSide(t1, 2), MakeSide(t2, 1));
        incident[v] = t;
        incident[T.v[1]] = incident[T.v[2]] = t;
        incident[T1.v[0]] = t1;
    }

    /// Puts the new vertex v onto the edge of side s; each of its triangles becomes two. A feature
    /// edge becomes two feature edges.
    void SplitEdge(Side s, int v)
    {
        const Side m = Mate(s);
        const bool feature = Constrained(s);
        const int tail = Tail(s);
        Grow(v);
        const int nearTail = HalveTriangle(s, v, tail, feature);
        if (m == NoSide)
            return;
        const int farTail = HalveTriangle(m, v, tail, feature);
        // The old records keep the half at the head; the new ones hold the half at the tail.
        Glue(MakeSide(SideTriangle(s), SideEdge(s)), MakeSide(SideTriangle(m), SideEdge(m)));
        Glue(MakeSide(nearTail, SideEdge(s)), MakeSide(farTail, SideEdge(m)));
    }

    /// Link condition: whether moving v onto its neighbour w keeps the surface and repeats no edge.
    /// `s` is a side of the edge between them; `stamp` has one entry a vertex, `tick` a fresh value.
    bool MayCollapse(int v, int w, Side s, std::vector<int> &stamp, int tick) const
    {
        const Side m = Mate(s);
        const bool boundaryEdge = m == NoSide;
        bool vBoundary = false, wBoundary = false;
        VisitSpokes(v, [&](int outer, Side x) {
            stamp[outer] = tick;
            vBoundary = vBoundary || Mate(x) == NoSide;
            return true;
        });
        int common = 0;
        VisitSpokes(w, [&](int outer, Side x) {
            common += stamp[outer] == tick;
            wBoundary = wBoundary || Mate(x) == NoSide;
            return true;
        });
        if (common != (boundaryEdge ? 1 : 2) || (vBoundary && wBoundary && !boundaryEdge))
            return false;
        return SurvivesCollapse(s) && (boundaryEdge || SurvivesCollapse(m));
    }

    /// Moves v onto w and removes the triangles of their edge. MayCollapse has said yes.
    /// Live triangles around w are those that were around either.
    void Collapse(int v, int w, Side s, Star &scratch)
    {
        ForgetRings();
        GatherStar(v, scratch);
        const Side m = Mate(s);
        for (const Side c : scratch.corner)
            triangle[SideTriangle(c)].v[SideEdge(c)] = w;
        CloseOver(s, w);
        if (m != NoSide)
            CloseOver(m, w);
        incident[v] = -1;
    }

    /// Drops dead triangles and dead vertices and renumbers the rest: vertex k of the result is
    /// order[k]; triangles follow their first vertex in that order.
    void Compact(const std::vector<int> &order)
    {
        ForgetRings();
        std::vector<int> newVertex(incident.size(), -1);
        for (std::size_t k = 0; k < order.size(); ++k)
            newVertex[order[k]] = static_cast<int>(k);
        std::vector<int> start(order.size() + 1, 0);
        auto key = [&](const Triangle &T) {
            return std::min({newVertex[T.v[0]], newVertex[T.v[1]], newVertex[T.v[2]]});
        };
        for (const Triangle &T : triangle)
            if (!T.dead)
                ++start[key(T) + 1];
        for (std::size_t k = 1; k < start.size(); ++k)
            start[k] += start[k - 1];
        std::vector<int> newTriangle(triangle.size(), -1);
        for (std::size_t t = 0; t < triangle.size(); ++t)
            if (!triangle[t].dead)
                newTriangle[t] = start[key(triangle[t])]++;
        std::vector<Triangle> packed(order.empty() ? 0 : start[order.size() - 1]);
        incident.assign(order.size(), -1);
        for (std::size_t t = 0; t < triangle.size(); ++t) {
            if (triangle[t].dead)
                continue;
            Triangle T = triangle[t];
            for (int i = 0; i < 3; ++i) {
                T.v[i] = newVertex[T.v[i]];
                incident[T.v[i]] = newTriangle[t];
                if (T.n[i] != NoSide)
                    T.n[i] = MakeSide(newTriangle[SideTriangle(T.n[i])], SideEdge(T.n[i]));
            }
            packed[newTriangle[t]] = T;
        }
        triangle.swap(packed);
    }

    /// Glues two sides; the second may be NoSide, which makes the first a boundary.
    void Glue(Side a, Side b)
    {
        triangle[SideTriangle(a)].n[SideEdge(a)] = b;
        if (b != NoSide)
            triangle[SideTriangle(b)].n[SideEdge(b)] = a;
    }

private:
    std::vector<Ring> _ring; // empty: not kept

    // Writes nothing where there are none, as several threads may change parts of the mesh then.
    void ForgetRings()
    {
        if (!_ring.empty())
            _ring.clear();
    }

    void Grow(int v)
    {
        ForgetRings();
        if (v >= VertexCount())
            incident.resize(v + 1, -1);
    }

    void GatherOpenStar(int v, Star &star) const
    {
        // The walk ended at the boundary: go to the other end and record from there.
        int t = SideTriangle(star.corner.front()), i = SideEdge(star.corner.front()), k = Prev(i);
        while (triangle[t].n[k] != NoSide) {
            const Side s = triangle[t].n[k];
            t = SideTriangle(s);
            i = triangle[t].IndexOf(v);
            k = 3 - i - SideEdge(s);
        }
        star.outer.clear();
        star.corner.clear();
        star.closed = false;
        int j = 3 - i - k;
        star.outer.push_back(triangle[t].v[j]);
        for (;;) {
            const Triangle &T = triangle[t];
            star.corner.push_back(MakeSide(t, i));
            star.outer.push_back(T.v[3 - i - j]);
            const Side s = T.n[j];
            if (s == NoSide)
                return;
            t = SideTriangle(s);
            i = triangle[t].IndexOf(v);
            j = 3 - i - SideEdge(s);
        }
    }

    // Splits the triangle of side s by a segment from its apex to v on that side: its record keeps
    // the half without `tail`, a new record with the same local indices takes the half with it.
    int HalveTriangle(Side s, int v, int tail, bool feature)
    {
        const int t = SideTriangle(s), e = SideEdge(s), u = TriangleCount();
        triangle.push_back(triangle[t]);
        Triangle &T = triangle[t], &U = triangle[u];
        const int iTail = T.IndexOf(tail), iHead = 3 - e - iTail;
        // Side iHead (apex - tail) goes to the new record.
        const Side outer = T.n[iHead];
        T.v[iTail] = v;
        U.v[iHead] = v;
        T.SetConstrained(iHead, false);
        U.SetConstrained(iTail, false);
        T.SetConstrained(e, feature);
        U.SetConstrained(e, feature);
        U.n[e] = NoSide;
        T.n[e] = NoSide;
        Glue(MakeSide(u, iHead), outer);
        Glue(MakeSide(t, iHead), MakeSide(u, iTail));
        incident[v] = t;
        incident[tail] = u;
        incident[T.v[e]] = t;
        incident[T.v[iHead]] = t;
        return u;
    }

    // The apex of a triangle that a collapse removes must keep a disk or half disk around it.
    bool SurvivesCollapse(Side s) const
    {
        const Triangle &T = triangle[SideTriangle(s)];
        const int e = SideEdge(s);
        const Side left = T.n[Next(e)], right = T.n[Prev(e)];
        if (left == NoSide || right == NoSide)
            return left != NoSide || right != NoSide;
        int valence = 0;
        bool boundary = false;
        VisitSpokes(T.v[e], [&](int, Side x) {
            ++valence;
            boundary = boundary || Mate(x) == NoSide;
            return valence < 4 && !boundary;
        });
        return boundary || valence >= 4;
    }

    // Glues the two other sides of a triangle that a collapse onto w removes.
    void CloseOver(Side s, int w)
    {
        const int t = SideTriangle(s), e = SideEdge(s);
        Triangle &T = triangle[t];
        const Side left = T.n[Next(e)], right = T.n[Prev(e)];
        const bool feature = T.Constrained(Next(e)) || T.Constrained(Prev(e));
        const int apex = T.v[e];
        T.dead = 1;
        const Side keep = left != NoSide ? left : right;
        Glue(keep, keep == left ? right : NoSide);
        SetConstrained(keep, feature);
        incident[w] = incident[apex] = SideTriangle(keep);
    }
};

} // namespace ccdm
} // namespace vcg

#endif
