// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_PARAMETERS_H
#define VCG_CCDM_PARAMETERS_H

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vcg {
namespace ccdm {

/// What the wanted vertex density phi is proportional to.
enum class DensityKind {
    Uniform,   ///< phi = 1
    Curvature, ///< phi = sqrt(|K| + H^2) of the input (paper, section 3.2)
    Quality    ///< phi = the caller's per-vertex field, positive and finite
};

/// How the mesh is optimised once it has been built.
enum class OptimizerKind {
    Annealing,  ///< the paper's local and global optimisation (sections 3.3 and 3.4)
    Accelerated ///< momentum on the cell centroid, fading noise, closing relocations
};

/// Where a relocation sends a free vertex; each is weighted with the density. All three are centroids that a
/// Delaunay mesh with equilateral triangles leaves in place.
enum class RelocationKind {
    PatchCentroid, ///< CPT: the centroid of the star (the paper's, section 2.1)
    CellCentroid,  ///< CVT: the centroid of the Voronoi cell (Du, Faber, Gunzburger 1999)
    Circumcentres  ///< ODT: the mean of the star's circumcentres by area (Alliez et al. 2005)
};

/// How the samples that become the output's vertices are laid on the input.
enum class SamplerKind {
    Random, ///< drawn in proportion to the density (section 3.2)
    Front   ///< laid out in hexagons by an advancing front
};

/// What becomes of the boundary.
enum class BoundaryKind {
    Sliding, ///< its corners stay, its other vertices are replaced by new ones along it
    Fixed,   ///< each of its vertices stays; new ones come between them where they are further apart than the spacing
    Smooth   ///< none of its vertices need stay: sharp turns are rounded off
};

/// What is done about an input that is no 2-manifold. Vertices that no face uses, faces that name a vertex twice or
/// repeat another, boundaries that are cut where the surface goes on, and faces turned against their neighbours are
/// mended always.
enum class RepairKind {
    Harmless, ///< nothing that changes the surface: it is refused
    Split     ///< faces are cut apart at edges of more than two faces, and sheets at vertices that join them
};

/// What a run is asked to reach.
enum class TargetKind {
    Vertices,   ///< a number of vertices
    EdgeLength, ///< a mean edge length
    MaxError    ///< a largest distance from the input
};

/// Parameters of the remesher. Values only; a default-constructed object needs just one of vertexCount,
/// edgeLength and maxError, and exactly one. Each ends with its unit, range, default and source; "paper" is Chen, Cao
/// and Wang 2012, a header named as the source explains what the paper does not have. Values out of range make the
/// status InvalidParameter.
struct Params {
    /// Number of vertices of the result. More come out only when the topology or the features need them.
    /// Unit: vertices. Range: [4, 100000000], or 0. Default: 0, not given. Source: paper, section 3.2.
    int vertexCount = 0;
    /// Mean edge length of the result, met to about 2 percent; turned into a vertex count.
    /// Unit: the mesh's. Range: (0, inf). Default: not given. Source: edge_length.h.
    std::optional<double> edgeLength;
    /// Largest two-sided (Hausdorff) distance between the input and the result. Reached, as measured, with few
    /// vertices in at most 8 runs, or the status is NotReached.
    /// Unit: diagonals of the input's bounding box. Range: (0, 1]. Default: not given. Source: target_search.h.
    std::optional<double> maxError;
    /// An edge is a feature when its two faces deviate from flat by more than this angle; at 180 only boundaries
    /// and marked edges are features.
    /// Unit: degrees. Range: (0, 180]. Default: 40. Source: paper, section 3.2; the value is measured.
    double featureAngle = 40.0;
    /// Takes the edges that the caller has marked as features in addition to those found by angle.
    /// Unit: none. Range: true or false. Default: false. Source: paper, section 3.2.
    bool useMarkedEdges = false;
    /// What becomes of the boundary.
    /// Unit: none. Range: any kind. Default: Sliding. Source: paper, sections 3.2 and 3.3, for Sliding.
    BoundaryKind boundary = BoundaryKind::Sliding;
    /// What is done about an input that is no 2-manifold.
    /// Unit: none. Range: any kind. Default: Harmless. Source: input_repair.h.
    RepairKind repair = RepairKind::Harmless;
    /// Remeshes the selected faces only; all other vertices and faces stay as they are, and so do the edges between
    /// the two parts. The vertex count is that of the whole result; errors and lengths are about the remeshed part.
    /// Unit: none. Range: true or false. Default: false. Source: selection.h.
    bool selectedFacesOnly = false;
    /// Size of the perturbation. The accelerated optimiser begins with about a third of it, half of
    /// that after a coarse level, and fades it out.
    /// Unit: mean length of a vertex's edges. Range: [0, 1]. Default: 0.2. Source: paper, section 3.4, lambda of
    /// equation (4).
    double lambda = 0.2;
    /// Number of perturb-optimise rounds, NG. The accelerated optimiser does NG * NL relocations; where it starts from
    /// a coarse level, 2.15 times as many there and a third as many at full resolution.
    /// Unit: rounds. Range: [0, 1000000]. Default: 14; with annealing 40. Source: paper, section 3.4, for 40; 14 is
    /// measured: three more take 6 % more time for 0.03 degrees.
    std::optional<int> globalIterations;
    /// Number of (Delaunay mesh, relocation) steps in each round, NL.
    /// Unit: steps. Range: [1, 1000000]. Default: 3. Source: paper, section 3.4.
    int localIterations = 3;
    /// What the wanted vertex density is proportional to.
    /// Unit: none. Range: any kind. Default: Uniform. Source: paper, section 3.2.
    DensityKind density = DensityKind::Uniform;
    /// gamma in rho = phi^gamma, the weight in the energy; the default of the accelerated optimiser is what makes the
    /// vertex density proportional to phi (DensityExponent).
    /// Unit: none. Range: [0, 3]. Default: 2, with cpt 1, with odt 1.6; with annealing 0.2. Source: paper, section 3.2,
    /// for 0.2; Du, Faber, Gunzburger 1999 for 2; 1 and 1.6 are measured.
    std::optional<double> densityExponent;
    /// How the mesh is optimised.
    /// Unit: none. Range: any kind. Default: Accelerated. Source: paper, section 3.4, for Annealing; optimizer.h.
    OptimizerKind optimizer = OptimizerKind::Accelerated;
    /// How the first points are laid out.
    /// Unit: none. Range: any kind. Default: Front. Source: paper, section 3.2, for Random; front_sampler.h.
    SamplerKind sampler = SamplerKind::Front;
    /// The rule of the relocations. The accelerated optimiser's last ones are to the patch centroid whatever the rule.
    /// Unit: none. Range: any kind. Default: CellCentroid; with annealing PatchCentroid. Source: paper, section 2.1,
    /// for PatchCentroid; centroid_rules.h.
    std::optional<RelocationKind> relocation;
    /// Smallest angle that the closing polish aims at. Not guaranteed: Report::angles says what stands in the way.
    /// Unit: degrees. Range: [0, 45]. Default: 40; with annealing 34. Source: polish.h; the values are measured.
    std::optional<double> minAngle;
    /// How much closeness to the input counts against the angles in the closing steps. The default costs hardly any
    /// angle. Above 0.5 the vertices also leave the surface, at 1 by the offset along their normals that makes the
    /// squared distance least.
    /// Unit: none. Range: [0, 1]. Default: 0.25. Source: approximation.h and surface_offset.h; the value is measured.
    double approximation = 0.25;
    /// Seed of the only random generator; equal input, parameters and seed give equal results.
    /// Unit: none. Range: [0, 4294967295]. Default: 1. Source: geometry.h.
    std::uint32_t seed = 1;
    /// Number of threads; at 0 as many as the machine has cores. The result is the same for any.
    /// Unit: threads. Range: [0, inf). Default: 0. Source: parallel.h.
    int threads = 0;
};

/// The relocation rule of a run.
inline RelocationKind Relocation(const Params &p)
{
    return p.relocation.value_or(p.optimizer == OptimizerKind::Accelerated ? RelocationKind::CellCentroid
                                                                           : RelocationKind::PatchCentroid);
}

/// The gamma of a run. Unset, it makes the vertex density of the accelerated optimiser proportional to phi: 2 for
/// the cell centroid (Du, Faber, Gunzburger 1999); about 1 for the patch centroid, whose fixed point is steeper, and
/// 1.6 for the circumcentres, both measured.
inline double DensityExponent(const Params &p)
{
    if (p.densityExponent || p.optimizer == OptimizerKind::Annealing)
        return p.densityExponent.value_or(0.2);
    switch (Relocation(p)) {
    case RelocationKind::PatchCentroid:
        return 1;
    case RelocationKind::Circumcentres:
        return 1.6;
    case RelocationKind::CellCentroid:
        break;
    }
    return 2;
}

/// The number of global iterations of a run.
inline int GlobalIterations(const Params &p)
{
    return p.globalIterations.value_or(p.optimizer == OptimizerKind::Accelerated ? 14 : 40);
}

/// The smallest angle that a run aims at, in degrees.
inline double MinAngle(const Params &p)
{
    return p.minAngle.value_or(p.optimizer == OptimizerKind::Accelerated ? 40.0 : 34.0);
}

/// What a run is asked to reach; of several, the first.
inline TargetKind TargetOf(const Params &p)
{
    return p.vertexCount != 0 ? TargetKind::Vertices : p.edgeLength ? TargetKind::EdgeLength : TargetKind::MaxError;
}

/// How a run ended.
enum class Status {
    Done,             ///< the result was checked and handed out
    Cancelled,        ///< the progress callback returned false
    InvalidParameter, ///< a parameter is out of its range
    InvalidInput,     ///< the input is not a surface that can be remeshed
    CheckFailed,      ///< the result did not pass the final check and was thrown away
    NotReached        ///< no number of vertices that was tried came within the error asked for
};

/// Defects of the input, as counts; those that forbid remeshing make the status InvalidInput.
struct InputDefects {
    int unreferencedVertices = 0; ///< that no face uses; dropped with a warning
    int repeatedIndexFaces = 0;   ///< faces that name a vertex twice; dropped with a warning
    int zeroAreaFaces = 0;        ///< faces without area; kept: they carry no sample
    int turnedFaces = 0;          ///< turned over to agree with their neighbours, with a warning if there are two sides
    int mergedVertices = 0;       ///< vertices of a cut boundary that were merged into others at their positions
    int copiedVertices = 0;       ///< new vertices where the surface was cut apart
    int nonFiniteVertices = 0;    ///< with a coordinate that is not finite; refused
    int nonManifoldEdges = 0;     ///< edges of more than two faces; refused, or cut apart
    int nonManifoldVertices = 0;  ///< vertices whose faces form more than one fan; refused, or cut apart
    int duplicateFaces = 0;       ///< faces on the same three vertices; dropped, or refused if they are a component
    int badDensityVertices = 0;   ///< density values that are negative or not finite; refused

    static constexpr std::size_t MostPlaces = 10; ///< in each of the two lists that follow
    std::vector<std::array<int, 2>> refusedEdges; ///< the first of those refused, by their vertices
    std::vector<int> refusedVertices;             ///< the first of those refused
};

/// Topological type of a surface.
struct TopologyCounts {
    int vertices = 0;       ///< those that faces use
    int edges = 0;          ///< each counted once
    int faces = 0;          ///< triangles
    int euler = 0;          ///< Euler characteristic: vertices - edges + faces
    int components = 0;     ///< joined over edges
    int boundaryLoops = 0;  ///< closed chains of boundary edges
    bool orientable = true; ///< whether the surface has two sides

    /// Same surface up to homeomorphism, as far as these counts tell.
    bool SameTypeAs(const TopologyCounts &o) const
    {
        return euler == o.euler && components == o.components && boundaryLoops == o.boundaryLoops &&
               orientable == o.orientable;
    }
};

/// What is narrower than the wanted spacing.
enum class NarrowKind {
    ThinPart,     ///< the surface: another sheet lies behind it, or it bends around on itself
    CloseFeatures ///< the surface between two features that are not neighbours at a corner
};

/// A narrow part of the input: no mesh of the wanted spacing can have good angles there. Lengths in the mesh's
/// units.
struct NarrowPlace {
    NarrowKind kind = NarrowKind::ThinPart;     ///< what is narrow
    std::array<double, 3> position = {0, 0, 0}; ///< where it is narrowest, relative to the spacing
    double width = 0;                           ///< thickness, or distance between the features
    double spacing = 0;                         ///< wanted edge length there
    double vertices = 0;                        ///< vertex count whose spacing would resolve it
};

/// What stands in the way of a triangle's smallest angle.
enum class SmallAngleReason {
    InputCorner,   ///< two feature curves meet at a corner of the triangle at less than the target
    CloseFeatures, ///< it touches a feature that is closer to another, or to another part of itself, than the spacing
    ThinPart,      ///< the surface is thinner there than the spacing
    FewVertices,   ///< the spacing is larger than the radius of curvature of the surface or of a feature
    Unexplained    ///< none of these: the target was just not reached
};
constexpr int SmallAngleReasonCount = 5; ///< number of reasons

/// A triangle of the result whose smallest angle is below the target.
struct SmallAngle {
    int face = 0;                                            ///< index in the result
    double degrees = 0;                                      ///< its smallest angle
    std::array<double, 3> position = {0, 0, 0};              ///< its centroid
    SmallAngleReason reason = SmallAngleReason::Unexplained; ///< what was found in the input there
};

/// The smallest angle of a result, and a reason for each triangle below the target. In degrees.
struct AngleCertificate {
    double target = 0;             ///< MinAngle of the parameters
    double reached = 0;            ///< smallest angle of the result
    std::vector<SmallAngle> below; ///< every triangle whose smallest angle is below the target

    /// Number of triangles below the target for one reason.
    int Count(SmallAngleReason reason) const
    {
        int count = 0;
        for (const SmallAngle &a : below)
            count += a.reason == reason;
        return count;
    }
};

/// What a run achieved. Counts are from 0 up and start at 0; unless the status is Done, what comes after the stage that
/// failed is as it starts.
struct Report {
    Status status = Status::InvalidInput; ///< how the run ended
    std::string message;                  ///< one sentence with the cause; empty when done
    InputDefects defects;                 ///< of the input, in counts
    TopologyCounts inputTopology;         ///< of the input once mended
    TopologyCounts resultTopology;        ///< of the result, counted anew by the final check
    bool topologyPreserved = false;       ///< whether the two are of the same type

    TargetKind target = TargetKind::Vertices; ///< what the parameters ask for
    double asked = 0;   ///< the target's value: vertices, length in the mesh's units, or distance in diagonals
    double reached = 0; ///< what the result has of it, measured, in the same unit
    int runs = 0; ///< remeshings that it took, at most 8; `seconds` is their sum, the rest is about the one handed out
    double meanEdgeLength = 0; ///< of the result, in the mesh's units

    int keptVertices = 0;      ///< that were not remeshed, as they do not belong to the selected faces
    int requestedVertices = 0; ///< asked for, or derived from another target
    /// Vertices beyond the requested ones, forced by topology or by features; 0 in the normal case.
    int extraVertices = 0;
    int featureCurves = 0;           ///< curves of creases, boundaries and marked edges (paper, section 3.2)
    int featureCorners = 0;          ///< vertices that stay: where curves meet, end or turn sharply
    int prunedFragments = 0;         ///< feature fragments shorter than the local spacing, ignored
    std::vector<NarrowPlace> narrow; ///< one for each narrow part, the narrowest in spacings first

    /// F of equation (1) in the kept state, first the start, then after each global iteration; of a mesh that was
    /// refined from a coarse level, since then. In the fourth power of a unit in which the input is about 1 long, so
    /// that only ratios within one run mean something.
    std::vector<double> energy;
    int accepted = 0; ///< global iterations of `energy` whose result was kept; with the accelerated optimiser all
    long long relocations = 0; ///< vertex relocations tried, all sweeps together
    long long flips = 0;       ///< edge flips done by the optimiser
    bool flipsBounded = false; ///< flips were ended at their bound: the mesh may not be Delaunay everywhere
    int foldedEdges = 0;       ///< edges of the result whose faces turn by more than 150 degrees
    AngleCertificate angles;   ///< the smallest angle, and why triangles are below the target

    std::vector<std::pair<std::string, double>> seconds; ///< wall time of each phase, in order
    std::vector<std::string> warnings;                   ///< one sentence each, for the user
};

} // namespace ccdm
} // namespace vcg

#endif
