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
/// edgeLength and maxError, and exactly one.
struct Params {
    /// Number of vertices of the result, 4 to 100000000; 0: not given.
    int vertexCount = 0;
    /// Mean edge length of the result, in the mesh's units, above 0; met to about 2 percent.
    std::optional<double> edgeLength;
    /// Largest two-sided (Hausdorff) distance between the input and the result, relative to the diagonal of the
    /// input's bounding box; range (0, 1]. Reached, as measured, with few vertices, or the run fails.
    std::optional<double> maxError;
    /// An edge is a feature when its two faces deviate from flat by more than this angle, in degrees,
    /// range (0, 180]. 180: only boundaries and marked edges are features.
    double featureAngle = 40.0;
    /// Takes the edges that the caller has marked as features in addition to those found by angle.
    bool useMarkedEdges = false;
    BoundaryKind boundary = BoundaryKind::Sliding;
    RepairKind repair = RepairKind::Harmless;
    /// Remeshes the selected faces only; all other vertices and faces stay as they are, and so do the edges between
    /// the two parts. The vertex count is that of the whole result; errors and lengths are about the remeshed part.
    bool selectedFacesOnly = false;
    /// Size of the perturbation relative to the mean length of a vertex's edges, the lambda of
    /// equation (4); range [0, 1]. The accelerated optimiser starts at half of it and fades it out.
    double lambda = 0.2;
    /// Number of perturb-optimise rounds, the paper's NG; at least 0. Unset: 40 with annealing, 24 with the
    /// accelerated optimiser. That does NG * NL relocations; where it starts from a coarse level, twice as many
    /// there and three tenths as many at full resolution.
    std::optional<int> globalIterations;
    /// Number of (Delaunay mesh, relocation) steps in each round, the paper's NL; at least 1.
    int localIterations = 3;
    DensityKind density = DensityKind::Uniform;
    /// gamma in rho = phi^gamma, the weight in the energy; range [0, 3]. Unset: 1/5 with annealing, as in
    /// the paper; with the accelerated optimiser what makes the vertex density proportional to phi (DensityExponent).
    std::optional<double> densityExponent;
    OptimizerKind optimizer = OptimizerKind::Accelerated;
    SamplerKind sampler = SamplerKind::Front;
    /// The rule of the relocations. Unset: PatchCentroid with annealing, as in the paper; CellCentroid with the
    /// accelerated optimiser, whose last relocations are to the patch centroid whatever the rule.
    std::optional<RelocationKind> relocation;
    /// Smallest angle that the closing polish aims at, in degrees; range [0, 45]. Unset: 40 with the
    /// accelerated optimiser, 34 with annealing.
    std::optional<double> minAngle;
    /// How much closeness to the input counts against the angles in the closing steps, range [0, 1]. The default
    /// costs hardly any angle. Above 0.5 the vertices also leave the surface, at 1 by the offset along their
    /// normals that makes the squared distance least.
    double approximation = 0.25;
    /// Seed of the only random generator; equal input, parameters and seed give equal results.
    std::uint32_t seed = 1;
    /// Number of threads, at least 0; 0: as many as the machine has cores. The result is the same for any.
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
    return p.globalIterations.value_or(p.optimizer == OptimizerKind::Accelerated ? 24 : 40);
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
    int unreferencedVertices = 0; ///< dropped with a warning
    int repeatedIndexFaces = 0;   ///< faces that name a vertex twice; dropped with a warning
    int zeroAreaFaces = 0;        ///< kept: they carry no sample
    int turnedFaces = 0;          ///< turned over to agree with their neighbours, with a warning if there are two sides
    int mergedVertices = 0;       ///< vertices of a cut boundary that were merged into others at their positions
    int copiedVertices = 0;       ///< new vertices where the surface was cut apart
    int nonFiniteVertices = 0;    ///< refused
    int nonManifoldEdges = 0;     ///< edges of more than two faces; refused, or cut apart
    int nonManifoldVertices = 0;  ///< vertices whose faces form more than one fan; refused, or cut apart
    int duplicateFaces = 0;       ///< faces on the same three vertices; dropped, or refused if they are a component
    int badDensityVertices = 0;   ///< density values that are negative or not finite; refused

    static constexpr std::size_t MostPlaces = 10;
    std::vector<std::array<int, 2>> refusedEdges; ///< the first of those refused, by their vertices
    std::vector<int> refusedVertices;             ///< the first of those refused
};

/// Topological type of a surface.
struct TopologyCounts {
    int vertices = 0; ///< referenced ones
    int edges = 0;
    int faces = 0;
    int euler = 0;
    int components = 0;
    int boundaryLoops = 0;
    bool orientable = true;

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
    NarrowKind kind = NarrowKind::ThinPart;
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
constexpr int SmallAngleReasonCount = 5;

/// A triangle of the result whose smallest angle is below the target.
struct SmallAngle {
    int face = 0;                               ///< index in the result
    double degrees = 0;                         ///< its smallest angle
    std::array<double, 3> position = {0, 0, 0}; ///< its centroid
    SmallAngleReason reason = SmallAngleReason::Unexplained;
};

/// The smallest angle of a result, and a reason for each triangle below the target. In degrees.
struct AngleCertificate {
    double target = 0;  ///< MinAngle of the parameters
    double reached = 0; ///< smallest angle of the result
    std::vector<SmallAngle> below;

    int Count(SmallAngleReason reason) const
    {
        int count = 0;
        for (const SmallAngle &a : below)
            count += a.reason == reason;
        return count;
    }
};

/// What a run achieved.
struct Report {
    Status status = Status::InvalidInput;
    std::string message; ///< one sentence with the cause; empty when done
    InputDefects defects;
    TopologyCounts inputTopology;
    TopologyCounts resultTopology;
    bool topologyPreserved = false;

    TargetKind target = TargetKind::Vertices;
    double asked = 0;   ///< the target's value: vertices, length in the mesh's units, or relative distance
    double reached = 0; ///< what the result has of it, measured
    int runs = 0;       ///< remeshings that it took; `seconds` is their sum, the rest is about the last that counts
    double meanEdgeLength = 0; ///< of the result, in the mesh's units

    int keptVertices = 0;      ///< that were not remeshed, as they do not belong to the selected faces
    int requestedVertices = 0; ///< asked for, or derived from another target
    /// Vertices beyond the requested ones, forced by topology or by features; 0 in the normal case.
    int extraVertices = 0;
    int featureCurves = 0;
    int featureCorners = 0;
    int prunedFragments = 0;         ///< feature fragments shorter than the local spacing, ignored
    std::vector<NarrowPlace> narrow; ///< one for each narrow part, the narrowest in spacings first

    std::vector<double> energy; ///< F of the kept state, first the start, then after each global iteration
    int accepted = 0;           ///< global iterations whose result was kept
    long long relocations = 0;  ///< vertex relocations tried, all sweeps together
    long long flips = 0;        ///< edge flips done by the optimiser
    bool flipsBounded = false;  ///< flips were ended at their bound: the mesh may not be Delaunay everywhere
    int foldedEdges = 0;        ///< edges of the result whose faces turn by more than 150 degrees
    AngleCertificate angles;

    std::vector<std::pair<std::string, double>> seconds; ///< wall time of each phase, in order
    std::vector<std::string> warnings;
};

} // namespace ccdm
} // namespace vcg

#endif
