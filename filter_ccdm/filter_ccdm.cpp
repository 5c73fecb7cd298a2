// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_ccdm.h"

#include <cmath>
#include <exception>
#include <new>

#include <QAction>
#include <QElapsedTimer>
#include <QFileInfo>

#include "remesh_layer.h"

using filter_ccdm::Failure;
using vcg::ccdm::Params;

namespace {

// Rich text wraps in tooltips, plain text does not.
QString Tip(const char *text)
{
    return QString("<p>%1</p>").arg(text);
}

// The host hands over numbers unchecked, and bad text as 0.
Params ReadParameters(const RichParameterList &list)
{
    const auto real = [&](const char *name, double low, double high) {
        // The host keeps single precision; what was typed is the short decimal.
        const double x = QString::number(static_cast<double>(list.getFloat(name))).toDouble();
        if (!(x >= low && x <= high))
            throw Failure(
                QString("%1 must lie between %2 and %3, not %4").arg(name).arg(low).arg(high).arg(x).toStdString());
        return x;
    };
    const auto whole = [&](const char *name, int low, int high) {
        const int x = list.getInt(name);
        if (x < low || x > high)
            throw Failure(
                QString("%1 must lie between %2 and %3, not %4").arg(name).arg(low).arg(high).arg(x).toStdString());
        return x;
    };
    Params p;
    p.vertexCount = whole("vertex_count", 4, 100000000);
    p.featureAngle = real("feature_angle", 1e-3, 180);
    p.lambda = real("lambda", 0, 1);
    p.globalIterations = whole("global_iterations", 0, 1000000);
    p.localIterations = whole("local_iterations", 1, 1000000);
    const int density = list.getEnum("density");
    if (density < 0 || density > 2)
        throw Failure("density must be 0 (uniform), 1 (curvature) or 2 (vertex quality)");
    p.density = static_cast<vcg::ccdm::DensityKind>(density);
    const int optimizer = list.getEnum("optimizer");
    if (optimizer < 0 || optimizer > 1)
        throw Failure("optimizer must be 0 (accelerated) or 1 (annealing, the paper's)");
    if (optimizer == 1) {
        p.optimizer = vcg::ccdm::OptimizerKind::Annealing;
        p.sampler = vcg::ccdm::SamplerKind::Random;
    }
    p.minAngle = real("min_angle", 0, 45);
    p.useMarkedEdges = list.getBool("selected_edges");
    p.seed = static_cast<std::uint32_t>(whole("seed", 0, 2147483647));
    return p;
}

// The layer list shows the base name of the label.
QString NewLayerName(const MeshModel &source)
{
    return QFileInfo(source.label()).completeBaseName() + "_ccdm";
}

} // namespace

FilterCcdmPlugin::FilterCcdmPlugin()
{
    typeList << FP_CCDM_REMESHING;
    for (const FilterIDType id : types())
        actionList << new QAction(filterName(id), this);
}

QString FilterCcdmPlugin::pluginName() const
{
    return "FilterCCDM";
}

QString FilterCcdmPlugin::filterName(FilterIDType id) const
{
    return id == FP_CCDM_REMESHING ? "Remeshing: Isotropic CCDM (constrained centroidal Delaunay mesh)" : "";
}

QString FilterCcdmPlugin::filterInfo(FilterIDType id) const
{
    if (id != FP_CCDM_REMESHING)
        return "";
    return "Replaces the triangles of a surface by well-shaped ones: the result has the <b>number of vertices</b> "
           "asked "
           "for, the same topology, the same sharp features and boundaries, and all of its vertices lie on the "
           "original. Takes any 2-manifold triangle mesh, with any genus, with boundaries, noise or "
           "self-intersections, orientable or not.<br>"
           "The vertices are spread by the wanted density; then edges are flipped until the mesh is Delaunay and each "
           "vertex moves to the centroid of its neighbourhood, over and over; random perturbations take the mesh "
           "from one local optimum to a better one.<br><br>"
           "See:<br><i>Zhonggui Chen, Juan Cao, Wenping Wang</i><br>"
           "<b>\"Isotropic Surface Remeshing Using Constrained Centroidal Delaunay Mesh\"</b><br>"
           "Computer Graphics Forum 31(7), 2012.";
}

FilterCcdmPlugin::FilterClass FilterCcdmPlugin::getClass(QAction *)
{
    return Remeshing;
}

FilterCcdmPlugin::FILTER_ARITY FilterCcdmPlugin::filterArity(QAction *) const
{
    return SINGLE_MESH;
}

int FilterCcdmPlugin::getPreConditions(QAction *) const
{
    return MeshModel::MM_FACENUMBER;
}

int FilterCcdmPlugin::postCondition(QAction *) const
{
    return MeshModel::MM_VERTNUMBER | MeshModel::MM_FACENUMBER;
}

void FilterCcdmPlugin::initParameterSet(QAction *, MeshModel &layer, RichParameterList &parameters)
{
    const Params p;
    parameters.addParam(RichInt("vertex_count", std::max(4, layer.cm.vn), "Vertex count",
                                Tip("Number of vertices of the result, 4 or more. The result has exactly that many, "
                                    "unless topology or features force more; the log says so then.")));
    parameters.addParam(RichFloat("feature_angle", static_cast<float>(p.featureAngle), "Feature angle (deg)",
                                  Tip("Edges whose two faces turn by more than this angle are sharp features and are "
                                      "kept. Degrees, above 0 up to 180; at 180 only boundaries are features.")));
    parameters.addParam(RichFloat("lambda", static_cast<float>(p.lambda), "Lambda (perturbation)",
                                  Tip("Size of the random perturbation relative to the edge length, 0 to 1. The paper "
                                      "recommends 0.2. The accelerated optimizer starts at half of it and fades "
                                      "it out.")));
    parameters.addParam(RichInt("global_iterations", vcg::ccdm::GlobalIterations(p), "Global iterations (NG)",
                                Tip("Number of perturb-and-optimise rounds, 0 or more. Triangles get better with more "
                                    "rounds; time grows in proportion. Annealing wants about 40.")));
    parameters.addParam(RichInt("local_iterations", p.localIterations, "Local iterations (NL)",
                                Tip("Relocations of every vertex in each round, 1 or more.")));
    parameters.addParam(
        RichEnum("density", 0, QStringList({"Uniform", "Curvature", "Vertex quality"}), "Density",
                 Tip("What the density of the vertices follows: nothing, the curvature of the surface, or "
                     "the quality of its vertices (positive values; larger means denser).")));
    parameters.addParam(RichEnum("optimizer", 0, QStringList({"Accelerated", "Annealing (the paper's)"}), "Optimizer",
                                 Tip("Accelerated gives better triangles in the same time; Annealing, with random "
                                     "samples, is the method as published.")));
    parameters.addParam(RichFloat("min_angle", static_cast<float>(vcg::ccdm::MinAngle(p)), "Smallest angle (deg)",
                                  Tip("The closing polish aims at no angle below this, 0 to 45 degrees. Sharp corners "
                                      "of the input can forbid it; the log says what was reached.")));
    parameters.addParam(
        RichBool("selected_edges", false, "Selected edges are features",
                 Tip("Keeps the selected face edges (see \"Select Crease Edges\") as features, in addition "
                     "to those found by angle.")));
    parameters.addParam(RichInt("seed", static_cast<int>(p.seed), "Seed",
                                Tip("Seed of the random generator, 0 or more. The same seed gives the same result.")));
    parameters.addParam(RichBool("new_layer", true, "New layer",
                                 Tip("Puts the result into a new layer and leaves this one alone; otherwise the result "
                                     "takes the place of this layer's mesh.")));
}

bool FilterCcdmPlugin::applyFilter(QAction *, MeshDocument &document, const RichParameterList &parameters,
                                   vcg::CallBackPos *progress)
{
    // The window stays alive during a run, so a second one can be started from within the first.
    if (_running) {
        errorMessage = "This filter is running already; wait until it has finished.";
        return false;
    }
    _running = true;
    bool done = false;
    QString cause;
    try {
        remesh(document, parameters, progress);
        done = true;
    } catch (const std::bad_alloc &) {
        cause = "there is not enough memory";
    } catch (const std::exception &e) {
        cause = QString::fromUtf8(e.what());
    }
    _running = false;
    if (!done) {
        // The box reads the message as HTML; meshlabserver shows the log only.
        errorMessage = "CCDM remeshing was not done: " + cause.toHtmlEscaped();
        Log("CCDM remeshing was not done: %s", qUtf8Printable(cause));
    }
    return done;
}

void FilterCcdmPlugin::remesh(MeshDocument &document, const RichParameterList &parameters, vcg::CallBackPos *progress)
{
    MeshModel *source = document.mm();
    if (source == nullptr)
        throw Failure("there is no current layer");
    const Params params = ReadParameters(parameters);
    const bool newLayer = parameters.getBool("new_layer");
    if (params.density == vcg::ccdm::DensityKind::Quality && !source->hasDataMask(MeshModel::MM_VERTQUALITY))
        throw Failure("the layer has no vertex quality to take the density from");

    filter_ccdm::Mesh input, result;
    filter_ccdm::CopyFromLayer(source->cm, input);
    Log("CCDM: %d vertices, %d faces -> %d vertices, feature angle %g, lambda %g, %d x %d iterations, seed %u",
        input.VN(), input.FN(), params.vertexCount, params.featureAngle, params.lambda,
        vcg::ccdm::GlobalIterations(params), params.localIterations, static_cast<unsigned>(params.seed));

    QElapsedTimer timer;
    timer.start();
    const vcg::ccdm::Report report = filter_ccdm::RemeshCopy(input, result, params, progress);
    const double seconds = static_cast<double>(timer.elapsed()) / 1000;

    // The callback lets the user work on: the layer may be gone by now.
    if (!document.meshList.contains(source))
        throw Failure("the layer was deleted while the filter was running");
    if (newLayer) {
        const Matrix44m transform = source->cm.Tr;
        MeshModel *target = document.addNewMesh("", NewLayerName(*source), false);
        filter_ccdm::CopyToLayer(result, *target);
        target->cm.Tr = transform;
        document.setCurrentMesh(target->id());
    } else {
        filter_ccdm::CopyToLayer(result, *source);
    }
    for (const QString &line : filter_ccdm::DescribeRun(input, result, report, seconds))
        Log("CCDM: %s", qUtf8Printable(line));
}

MESHLAB_PLUGIN_NAME_EXPORTER(FilterCcdmPlugin)
