// SPDX-License-Identifier: GPL-3.0-or-later
#include "parameters.h"

#include <algorithm>

#include <QStringList>

using vcg::ccdm::Params;

namespace filter_ccdm {

namespace {

enum SelectedEdges { Ignored, WithTheAngle, InsteadOfTheAngle };

// The number that leaves a parameter to the optimizer.
constexpr int Auto = -1;

// Rich text wraps in tooltips, plain text does not.
QString Tip(const char *text)
{
    return QString("<p>%1</p>").arg(text);
}

constexpr const char *OrAuto = ", or be -1";

// The number, if it is in its range. The host hands over numbers unchecked, and bad text as 0.
template <class T>
T Checked(const char *name, T low, T high, T x, const char *orElse)
{
    if (!(x >= low && x <= high)) // nor is what is not a number
        throw Failure(QString("%1 must lie between %2 and %3%4, not %5")
                          .arg(name)
                          .arg(low)
                          .arg(high)
                          .arg(orElse)
                          .arg(x)
                          .toStdString());
    return x;
}

double Real(const RichParameterList &list, const char *name, double low, double high, const char *orElse = "")
{
    // The host keeps single precision; what was typed is the short decimal.
    const double x = QString::number(static_cast<double>(list.getFloat(name))).toDouble();
    return Checked(name, low, high, x, orElse);
}

int Whole(const RichParameterList &list, const char *name, int low, int high, const char *orElse = "")
{
    return Checked(name, low, high, list.getInt(name), orElse);
}

int Choice(const RichParameterList &list, const char *name, int count)
{
    return Checked(name, 0, count - 1, list.getEnum(name), "");
}

} // namespace

RichParameterList DeclareParameters(int vertices)
{
    const Params p;
    RichParameterList list;
    list.addParam(RichInt("vertex_count", std::max(4, vertices), "Vertex count",
                          Tip("Number of vertices of the result, 4 or more. The result has exactly that many, unless "
                              "topology or features force more; the log says so then.")));
    list.addParam(RichFloat("edge_length", 0, "Edge length instead (% of diagonal)",
                            Tip("Above 0, this takes the place of the vertex count: the mean edge length of the "
                                "result in percent of the bounding box's diagonal, met to about 2 %. 0 to 100.")));
    list.addParam(RichFloat("max_error", 0, "Largest error instead (% of diagonal)",
                            Tip("Above 0, this takes the place of the vertex count: few vertices whose surface lies "
                                "nowhere farther from the original than this, in percent of the bounding box's "
                                "diagonal. Takes up to 8 runs. 0 to 100.")));
    list.addParam(RichFloat("feature_angle", static_cast<Scalarm>(p.featureAngle), "Feature angle (deg)",
                            Tip("Edges whose two faces turn by more than this angle are sharp features and are kept. "
                                "Degrees, above 0 up to 180; at 180 only boundaries are features. Raise it when noise "
                                "is taken for creases, lower it when a crease gets rounded off.")));
    list.addParam(RichEnum("selected_edges", Ignored,
                           QStringList({"Ignored", "With the angle", "Instead of the angle"}), "Selected edges",
                           Tip("Whether the selected face edges (see \"Select Crease Edges\") are kept as features: in "
                               "addition to those found by the feature angle, or instead of them.")));
    list.addParam(RichEnum("boundary", 0, QStringList({"Sliding", "Fixed", "Smooth"}), "Boundary",
                           Tip("What becomes of open boundaries. Sliding: their corners stay, their other vertices are "
                               "replaced by new ones along them. Fixed: all of their vertices stay, so that the result "
                               "fits to what it was cut from. Smooth: none need stay, sharp turns are rounded off.")));
    list.addParam(RichEnum("density", 0, QStringList({"Uniform", "Curvature", "Vertex quality"}), "Density",
                           Tip("What the density of the vertices follows: nothing, the curvature of the surface, or "
                               "the quality of its vertices (0 or more and finite; larger means denser).")));
    list.addParam(RichBool("selected_faces_only", false, "Selected faces only",
                           Tip("Remeshes the selected faces only. All other vertices and faces stay exactly as they "
                               "are, and the parts join without a gap. The vertex count is that of the whole result; "
                               "the new faces are selected in it.")));
    list.addParam(RichBool("keep_attributes", true, "Keep attributes",
                           Tip("Carries colours, quality, selection, texture coordinates, custom attributes and own "
                               "normals over from the place where each new vertex or face lies; seams of the texture "
                               "coordinates are kept as features. The log names what was carried. Always on when only "
                               "the selected faces are remeshed.")));
    list.addParam(RichBool("new_layer", true, "New layer",
                           Tip("Puts the result into a new layer and leaves this one alone; otherwise the result takes "
                               "the place of this layer's mesh, which cannot be undone.")));
    list.addParam(
        RichEnum("optimizer", 0, QStringList({"Accelerated", "Annealing"}), "Optimizer",
                 Tip("Accelerated gives better triangles in the same time; Annealing, with random samples, is "
                     "the method as published.") CCDM_ADVANCED));
    list.addParam(RichInt("global_iterations", Auto, "Global iterations (NG; -1: auto)",
                          Tip("Number of perturb-and-optimise rounds, 0 to 1000000; -1: 14 with Accelerated, 40 with "
                              "Annealing. Triangles get better with more; time grows in proportion.") CCDM_ADVANCED));
    list.addParam(RichInt("local_iterations", p.localIterations, "Local iterations (NL)",
                          Tip("Relocations of every vertex in each round, 1 to 1000000.") CCDM_ADVANCED));
    list.addParam(
        RichFloat("lambda", static_cast<Scalarm>(p.lambda), "Lambda (edge lengths)",
                  Tip("Size of the random perturbation in units of the edge length, 0 to 1. The paper "
                      "recommends 0.2. The accelerated optimizer begins with about a third of it and fades it out.")
                      CCDM_ADVANCED));
    list.addParam(RichFloat("min_angle", Auto, "Smallest angle (deg; -1: auto)",
                            Tip("The closing polish aims at no angle below this, 0 to 45 degrees; -1: 40 with "
                                "Accelerated, 34 with Annealing. Sharp corners and narrow parts of the input can "
                                "forbid it; the log says what was reached.") CCDM_ADVANCED));
    list.addParam(RichFloat("approximation", static_cast<Scalarm>(p.approximation), "Approximation (weight)",
                            Tip("How much closeness to the original counts against the angles in the closing steps, "
                                "0 to 1. Above 0.5 the vertices may leave the surface.") CCDM_ADVANCED));
    list.addParam(
        RichEnum("repair", 0, QStringList({"Harmless only", "Cut apart"}), "Repair",
                 Tip("What is mended of a mesh that is no surface. Harmless only: nothing that changes it; it "
                     "is refused, with the places. Cut apart: edges of more than two faces, and vertices that "
                     "join several sheets, are cut.") CCDM_ADVANCED));
    list.addParam(RichInt("seed", static_cast<int>(p.seed), "Seed",
                          Tip("Seed of the random generator, 0 to 2147483647. The same mesh, parameters and seed give "
                              "the same result.") CCDM_ADVANCED));
    return list;
}

Settings ReadParameters(const RichParameterList &list)
{
    Settings s;
    Params &p = s.engine;
    const double edgeLength = Real(list, "edge_length", 0, 100);
    const double maxError = Real(list, "max_error", 0, 100);
    if (edgeLength > 0 && maxError > 0)
        throw Failure("edge_length and max_error are both above 0; only one of them can be the target");
    if (edgeLength > 0)
        s.edgeLengthPercent = edgeLength;
    else if (maxError > 0)
        p.maxError = maxError / 100;
    else
        p.vertexCount = Whole(list, "vertex_count", 4, 100000000);
    p.featureAngle = Real(list, "feature_angle", 1e-3, 180);
    const int selected = Choice(list, "selected_edges", 3);
    p.useMarkedEdges = selected != Ignored;
    if (selected == InsteadOfTheAngle)
        p.featureAngle = 180;
    p.boundary = static_cast<vcg::ccdm::BoundaryKind>(Choice(list, "boundary", 3));
    p.selectedFacesOnly = list.getBool("selected_faces_only");
    s.keepAttributes = list.getBool("keep_attributes");
    p.density = static_cast<vcg::ccdm::DensityKind>(Choice(list, "density", 3));
    s.newLayer = list.getBool("new_layer");
    if (Choice(list, "optimizer", 2) == 1) {
        p.optimizer = vcg::ccdm::OptimizerKind::Annealing;
        p.sampler = vcg::ccdm::SamplerKind::Random;
    }
    if (list.getInt("global_iterations") != Auto)
        p.globalIterations = Whole(list, "global_iterations", 0, 1000000, OrAuto);
    p.localIterations = Whole(list, "local_iterations", 1, 1000000);
    p.lambda = Real(list, "lambda", 0, 1);
    if (list.getFloat("min_angle") != Auto)
        p.minAngle = Real(list, "min_angle", 0, 45, OrAuto);
    p.approximation = Real(list, "approximation", 0, 1);
    p.repair = static_cast<vcg::ccdm::RepairKind>(Choice(list, "repair", 2));
    p.seed = static_cast<std::uint32_t>(Whole(list, "seed", 0, 2147483647));
    return s;
}

} // namespace filter_ccdm
