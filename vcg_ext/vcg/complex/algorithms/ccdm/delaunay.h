// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_DELAUNAY_H
#define VCG_CCDM_DELAUNAY_H

#include <algorithm>
#include <cmath>
#include <vector>

#include <vcg/complex/algorithms/ccdm/patch_schedule.h>

namespace vcg {
namespace ccdm {

/// The two triangles (a, p, q) and (b, q, p) of an edge pq, seen as a quadrilateral.
struct Hinge {
    Point a, b, p, q;
    int apexA, apexB;

    Hinge(const Remesh &r, Side s)
        : a(r.position[r.mesh.Opposite(s)]), b(r.position[r.mesh.Opposite(r.mesh.Mate(s))]),
          p(r.position[r.mesh.Tail(s)]), q(r.position[r.mesh.Head(s)]), apexA(r.mesh.Opposite(s)),
          apexB(r.mesh.Opposite(r.mesh.Mate(s)))
    {
    }

    /// Excess of the opposite angles over pi, as a number that grows with it from 0: the paper's
    /// priority of an edge that is not locally Delaunay. Not positive for a locally Delaunay edge.
    double Excess() const
    {
        const Point ap = p - a, aq = q - a, bp = p - b, bq = q - b;
        const double cosA = Dot(ap, aq), cosB = Dot(bp, bq);
        if (cosA >= 0 && cosB >= 0)
            return 0; // neither angle is obtuse
        const double sinA = Norm(Cross(ap, aq)), sinB = Norm(Cross(bp, bq));
        const double sine = sinA * cosB + cosA * sinB;
        const double scale = std::sqrt((cosA * cosA + sinA * sinA) * (cosB * cosB + sinB * sinB));
        if (!(sine < -1e-9 * scale))
            return 0;
        return 1 + (cosA * cosB - sinA * sinB) / scale;
    }

    /// Whether the other diagonal is so long that no flip can raise the smallest angles: in two equilateral
    /// triangles it has three times the squared length, in a square as much.
    bool Slender() const { return SquaredNorm(a - b) > 2 * SquaredNorm(p - q); }

    /// Whether the other diagonal gives two triangles that face the way the old ones do, and turn no
    /// more sharply at their new edge than a right angle or than before.
    bool KeepsShape() const
    {
        const Point n1 = Cross(p - a, q - a), n2 = Cross(q - b, p - b), n = n1 + n2;
        const Point m1 = Cross(p - a, b - a), m2 = Cross(b - a, q - a);
        const double tiny = 1e-6 * SquaredNorm(n);
        if (!(Dot(m1, n) > tiny) || !(Dot(m2, n) > tiny))
            return false;
        const double after = Dot(m1, m2);
        if (after > 0)
            return true;
        const double before = Dot(n1, n2);
        return after * std::sqrt(SquaredNorm(n1) * SquaredNorm(n2)) >
               before * std::sqrt(SquaredNorm(m1) * SquaredNorm(m2));
    }
};

/// The one predicate that says whether an edge may flip: it is no feature, the flip repeats no edge
/// and folds nothing.
inline bool MayFlip(const Remesh &r, Side s, const Hinge &h)
{
    return r.mesh.Mate(s) != NoSide && !r.mesh.Constrained(s) && h.KeepsShape() &&
           r.mesh.FindEdge(h.apexA, h.apexB) == NoSide;
}

/// Makes the mesh a Delaunay mesh by flipping the edges that are not locally Delaunay, the worst first
/// (paper, section 3.3; [DZM07a]). Patches of the mesh are worked on at the same time.
class DelaunayFlipper
{
public:
    explicit DelaunayFlipper(Workers &workers) : _workers(workers) {}

    /// Returns the number of flips. Bounded by a fixed number of flips an edge: geometry that would go on
    /// longer is left as it is.
    long long Run(Remesh &r)
    {
        std::vector<Task> task(Patches::Count(r.VertexCount()));
        Task last;
        for (const Entry &e : Find(r)) {
            const int patch = PatchOfHinge(r, e.side);
            (patch >= 0 ? task[patch] : last).queue.push_back(e);
        }
        _workers.For(static_cast<int>(task.size()), [&](int patch, int) { task[patch].Run(r, patch); });
        long long flips = 0;
        for (const Task &t : task) {
            last.queue.insert(last.queue.end(), t.left.begin(), t.left.end());
            flips += t.flips;
            _bounded = _bounded || t.bounded;
        }
        last.Run(r, Everywhere);
        _bounded = _bounded || last.bounded;
        _crossing.swap(last.flipped);
        return flips + last.flips;
    }

    /// Those flips of the last run that were not inside one patch.
    const std::vector<Flipped> &Crossing() const { return _crossing; }

    /// Whether any run has ended at its bound.
    bool Bounded() const { return _bounded; }

private:
    struct Entry {
        double excess;
        Side side;
        bool operator<(const Entry &o) const { return excess != o.excess ? excess < o.excess : side < o.side; }
    };
    static constexpr int Everywhere = -1;

    // The edges of one patch, and what its flips leave to do across its border.
    struct Task {
        std::vector<Entry> queue, left;
        std::vector<Flipped> flipped; // filled for the edges across borders
        long long flips = 0;
        bool bounded = false;

        void Run(Remesh &r, int patch)
        {
            std::make_heap(queue.begin(), queue.end());
            const long long limit = 12LL * (patch == Everywhere ? r.mesh.TriangleCount() : 2 * Patches::Size) + 64;
            while (!queue.empty() && flips < limit) {
                std::pop_heap(queue.begin(), queue.end());
                const Entry top = queue.back();
                queue.pop_back();
                if (r.mesh.Mate(top.side) == NoSide || r.mesh.Constrained(top.side))
                    continue;
                // An entry whose edge has changed since is void: the change has queued what it left.
                if (patch != Everywhere && PatchOfHinge(r, top.side) != patch)
                    continue;
                const Hinge h(r, top.side);
                if (h.Excess() != top.excess || !MayFlip(r, top.side, h))
                    continue;
                const int t = SideTriangle(top.side), u = SideTriangle(r.mesh.Mate(top.side));
                if (patch == Everywhere)
                    flipped.push_back({r.mesh.Tail(top.side), r.mesh.Head(top.side), h.apexA, h.apexB});
                r.mesh.Flip(top.side);
                ++flips;
                for (const int k : {t, u})
                    for (int e = 0; e < 3; ++e)
                        Enqueue(r, MakeSide(k, e), patch);
            }
            bounded = !queue.empty();
        }

        void Enqueue(const Remesh &r, Side s, int patch)
        {
            if (r.mesh.Mate(s) == NoSide || r.mesh.Constrained(s))
                return;
            const double excess = Hinge(r, s).Excess();
            if (!(excess > 0))
                return;
            if (patch != Everywhere && PatchOfHinge(r, s) != patch) {
                left.push_back({excess, s});
                return;
            }
            queue.push_back({excess, s});
            std::push_heap(queue.begin(), queue.end());
        }
    };

    Workers &_workers;
    std::vector<std::vector<Entry>> _found;
    std::vector<Flipped> _crossing;
    bool _bounded = false;

    std::vector<Entry> Find(const Remesh &r)
    {
        const int count = r.mesh.TriangleCount();
        _found.resize(Chunks::Count(count));
        Chunks::For(_workers, count, [&](int first, int last, int chunk) {
            std::vector<Entry> &found = _found[chunk];
            found.clear();
            for (int t = first; t < last; ++t) {
                // Only an edge opposite an obtuse angle can fail, and a triangle has at most one.
                const Triangle &T = r.mesh.triangle[t];
                const Point &a = r.position[T.v[0]], &b = r.position[T.v[1]], &c = r.position[T.v[2]];
                const double la = SquaredNorm(c - b), lb = SquaredNorm(a - c), lc = SquaredNorm(b - a);
                const int e = la > lb ? (la > lc ? 0 : 2) : (lb > lc ? 1 : 2);
                if (!(2 * std::max({la, lb, lc}) > la + lb + lc) || T.n[e] == NoSide || T.Constrained(e))
                    continue;
                const double excess = Hinge(r, MakeSide(t, e)).Excess();
                if (excess > 0)
                    found.push_back({excess, MakeSide(t, e)});
            }
        });
        std::vector<Entry> all;
        for (const std::vector<Entry> &found : _found)
            all.insert(all.end(), found.begin(), found.end());
        return all;
    }
};

} // namespace ccdm
} // namespace vcg

#endif
