// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_TRANSPLANT_H
#define VCG_CCDM_TRANSPLANT_H

#include <algorithm>
#include <cmath>
#include <vector>

#include <vcg/complex/algorithms/ccdm/polish.h>
#include <vcg/complex/algorithms/ccdm/refinement.h>

namespace vcg {
namespace ccdm {

/// Takes vertices out of places where no move and no flip helps, such as a fold of the input that is finer than the
/// spacing and holds several of them, and puts them where the mesh has the longest edge.
class Transplant
{
public:
    Transplant(const Model &model, Remesh &remesh, Workers &workers) : _model(model), _remesh(remesh), _workers(workers)
    {
    }

    /// Aims at `degrees` for the triangles that touch no feature; at most `places` vertices are moved. Vertices and
    /// triangles may be renumbered. Returns whether anything changed.
    bool Run(double degrees, int places)
    {
        bool changed = false;
        for (; places > 0; --places) {
            const int worst = WorstFree();
            if (worst < 0 || LargestCosine(_remesh, worst) <= std::cos(degrees * Pi / 180) + 1e-9)
                break;
            const Remesh before = _remesh;
            const double cosine = LargestCosine(_remesh, worst);
            if (!MoveFrom(worst, degrees)) {
                _remesh = before;
                break;
            }
            const int now = WorstFree();
            if (now >= 0 && LargestCosine(_remesh, now) > cosine - 1e-3) {
                _remesh = before;
                break;
            }
            changed = true;
        }
        return changed;
    }

private:
    static constexpr int Rings = 4, Sweeps = 12, Failures = 20;

    const Model &_model;
    Remesh &_remesh;
    Workers &_workers;

    bool Free(int v) const { return _remesh.place[v].kind == VertexKind::Free; }

    // The triangle with the smallest angle of those whose vertices are all free; -1 if there is none.
    int WorstFree() const
    {
        int worst = -1;
        double cosine = -1;
        for (int t = 0; t < _remesh.mesh.TriangleCount(); ++t) {
            const Triangle &T = _remesh.mesh.triangle[t];
            if (!(Free(T.v[0]) && Free(T.v[1]) && Free(T.v[2])))
                continue;
            const double c = LargestCosine(_remesh, t);
            if (c > cosine) {
                cosine = c;
                worst = t;
            }
        }
        return worst;
    }

    // Merges the ends of the shortest edge of a triangle that may go, and splits the longest edge of the mesh.
    bool MoveFrom(int t, double degrees)
    {
        const Triangle T = _remesh.mesh.triangle[t];
        const auto length = [&](int e) {
            return SquaredNorm(_remesh.position[T.v[Next(e)]] - _remesh.position[T.v[Prev(e)]]);
        };
        int order[3] = {0, 1, 2};
        std::sort(std::begin(order), std::end(order),
                  [&](int a, int b) { return length(a) != length(b) ? length(a) < length(b) : a < b; });
        std::vector<int> stamp(_remesh.VertexCount(), 0);
        int tick = 0;
        for (const int e : order) {
            const Side s = MakeSide(t, e);
            const int gone = _remesh.mesh.Tail(s), stays = _remesh.mesh.Head(s);
            if (_remesh.mesh.Constrained(s) || !_remesh.mesh.MayCollapse(gone, stays, s, stamp, ++tick))
                continue;
            Star scratch;
            _remesh.mesh.Collapse(gone, stays, s, scratch);
            std::vector<int> rest;
            for (int v = 0; v < _remesh.VertexCount(); ++v)
                if (v != gone)
                    rest.push_back(v);
            Refinement refinement(_model, _remesh);
            refinement.Renumber(rest);
            refinement.SplitLongest(1, _workers);
            _remesh.mesh.KeepRings();
            const int added = _remesh.VertexCount() - 1;
            RelaxAround(stays - (stays > gone ? 1 : 0));
            RelaxAround(added);
            Polish polish(_model, _remesh, _workers, Failures);
            polish.Unfold(10);
            polish.RaiseAngles(degrees, 0.2, 20);
            return added == static_cast<int>(rest.size());
        }
        return false;
    }

    void RelaxAround(int v)
    {
        TrialPatch patch(_model, _remesh);
        patch.Take(_remesh.mesh.incident[v], Rings);
        patch.Relax(Sweeps, [](int) { return false; });
    }
};

} // namespace ccdm
} // namespace vcg

#endif
