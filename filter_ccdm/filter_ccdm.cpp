// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_ccdm.h"

#include <algorithm>
#include <exception>
#include <new>

#include <QAction>
#include <QElapsedTimer>
#include <QFileInfo>

#include "attributes.h"
#include "host_process.h"

using filter_ccdm::Failure;
using filter_ccdm::RunningThreads;

namespace {

// The window stays alive during a run, so a second one can be started from within the first, on the same thread.
// PyMeshLab runs the one plugin object on several threads at once, which is fine.
class RunGuard
{
public:
    explicit RunGuard(RunningThreads &running) : _running(running)
    {
        const std::lock_guard<std::mutex> lock(_running.mutex);
        if (Find() != _running.ids.end())
            throw Failure("this filter is running already; wait until it has finished");
        _running.ids.push_back(std::this_thread::get_id());
    }
    ~RunGuard()
    {
        const std::lock_guard<std::mutex> lock(_running.mutex);
        _running.ids.erase(Find());
    }
    RunGuard(const RunGuard &) = delete;
    RunGuard &operator=(const RunGuard &) = delete;

private:
    RunningThreads &_running;

    std::vector<std::thread::id>::iterator Find()
    {
        return std::find(_running.ids.begin(), _running.ids.end(), std::this_thread::get_id());
    }
};

// The layer list shows the base name of the label.
QString NewLayerName(const QString &label)
{
    const QString base = QFileInfo(label).completeBaseName();
    return base.isEmpty() ? "ccdm" : base + "_ccdm";
}

} // namespace

FilterCcdmPlugin::FilterCcdmPlugin()
{
    typeList = {FP_CCDM_REMESHING};
    for (const int id : typeList)
        actionList.push_back(new QAction(filterName(id), this));
}

QString FilterCcdmPlugin::pluginName() const
{
    return "FilterCCDM";
}

QString FilterCcdmPlugin::filterName(int id) const
{
    return id == FP_CCDM_REMESHING ? "Remeshing: Isotropic CCDM (constrained centroidal Delaunay mesh)" : "";
}

QString FilterCcdmPlugin::filterInfo(int id) const
{
    if (id != FP_CCDM_REMESHING)
        return "";
    // Kept short: in MeshLab 2020.09 the parameters have only the room that this text leaves them.
    return "Replaces the triangles of a surface by well-shaped ones: as <b>many vertices</b> as asked for, the same "
           "topology, sharp features and boundaries, close to the original. Takes any 2-manifold triangle "
           "mesh, also with boundaries, noise or self-intersections, and not orientable ones.<br>"
           "See: <i>Zhonggui Chen, Juan Cao, Wenping Wang</i>, <b>\"Isotropic Surface Remeshing Using Constrained "
           "Centroidal Delaunay Mesh\"</b>, Computer Graphics Forum 31(7), 2012.";
}

FilterCcdmPlugin::CCDM_ARITY FilterCcdmPlugin::filterArity(CCDM_ACTION *) const
{
    return SINGLE_MESH;
}

int FilterCcdmPlugin::getPreConditions(CCDM_ACTION *) const
{
    return MeshModel::MM_FACENUMBER;
}

int FilterCcdmPlugin::postCondition(CCDM_ACTION *) const
{
    return MeshModel::MM_VERTNUMBER | MeshModel::MM_FACENUMBER;
}

#if CCDM_HOST_API == 2020

FilterCcdmPlugin::FilterClass FilterCcdmPlugin::getClass(QAction *)
{
    return Remeshing;
}

void FilterCcdmPlugin::initParameterSet(QAction *, MeshModel &layer, RichParameterList &parameters)
{
    parameters = filter_ccdm::DeclareParameters(layer.cm.vn);
}

void FilterCcdmPlugin::initParameterSet(QAction *, MeshDocument &document, RichParameterList &parameters)
{
    parameters = filter_ccdm::DeclareParameters(document.mm() == nullptr ? 0 : document.mm()->cm.vn);
}

bool FilterCcdmPlugin::applyFilter(QAction *, MeshDocument &document, const RichParameterList &parameters,
                                   vcg::CallBackPos *progress)
{
    const Outcome outcome = Attempt(document, parameters, progress);
    // The box reads the message as HTML; meshlabserver shows the log only.
    if (!outcome.done) {
        try {
            errorMessage = outcome.cause.toHtmlEscaped();
        } catch (const std::bad_alloc &) {
            errorMessage = outcome.cause;
        }
    }
    return outcome.done;
}

#else

QString FilterCcdmPlugin::vendor() const
{
    return "CCDM for MeshLab";
}

QString FilterCcdmPlugin::pythonFilterName(int id) const
{
    return id == FP_CCDM_REMESHING ? "meshing_isotropic_ccdm" : "";
}

FilterCcdmPlugin::FilterClass FilterCcdmPlugin::getClass(const QAction *) const
{
    return Remeshing;
}

RichParameterList FilterCcdmPlugin::initParameterList(const QAction *, const MeshModel &layer)
{
    return filter_ccdm::DeclareParameters(layer.cm.vn);
}

RichParameterList FilterCcdmPlugin::initParameterList(const QAction *, const MeshDocument &document)
{
    return filter_ccdm::DeclareParameters(document.mm() == nullptr ? 0 : document.mm()->cm.vn);
}

std::map<std::string, QVariant> FilterCcdmPlugin::applyFilter(const QAction *, const RichParameterList &parameters,
                                                              MeshDocument &document, unsigned int &,
                                                              vcg::CallBackPos *progress)
{
    Outcome outcome = Attempt(document, parameters, progress);
    if (!outcome.done) {
        const std::lock_guard<std::mutex> lock(_running.mutex);
        if (_running.ids.empty())
            setLog(nullptr); // PyMeshLab forgets to, and the document may be gone at the next run
        throw MLException(outcome.cause);
    }
    return std::move(outcome.outputs);
}

#endif

FilterCcdmPlugin::Outcome FilterCcdmPlugin::Attempt(MeshDocument &document, const RichParameterList &parameters,
                                                    vcg::CallBackPos *progress)
{
    Outcome outcome;
    try {
        try {
            const RunGuard guard(_running);
            outcome.outputs = Remesh(document, parameters, progress);
            outcome.done = true;
        } catch (const std::bad_alloc &) {
            throw;
        } catch (const std::exception &e) {
            outcome.cause = QString("CCDM remeshing was not done: ") + QString::fromUtf8(e.what());
        }
    } catch (const std::bad_alloc &) { // these literals need none
        outcome.cause = QStringLiteral("CCDM remeshing was not done: there is not enough memory");
    } catch (...) {
        outcome.cause = QStringLiteral("CCDM remeshing was not done: unknown error");
    }
    if (!outcome.done)
        Say("", outcome.cause, Level::Warning);
    return outcome;
}

filter_ccdm::Outputs FilterCcdmPlugin::Remesh(MeshDocument &document, const RichParameterList &parameters,
                                              vcg::CallBackPos *progress)
{
    MeshModel *source = document.mm();
    if (source == nullptr)
        throw Failure("there is no current layer");
    filter_ccdm::Settings settings = filter_ccdm::ReadParameters(parameters);
    if (settings.engine.density == vcg::ccdm::DensityKind::Quality && !source->hasDataMask(MeshModel::MM_VERTQUALITY))
        throw Failure("the layer has no vertex quality to take the density from");
    const int id = source->id();
    if (filter_ccdm::IsPyMeshLab(progress))
        progress = nullptr;

    // All that is needed of the layer is copied before the progress callback lets the user work on.
    filter_ccdm::Mesh input, result;
    filter_ccdm::CopyFromLayer(source->cm, input);
    if (settings.edgeLengthPercent)
        settings.engine.edgeLength = *settings.edgeLengthPercent / 100 * filter_ccdm::Diagonal(input);
    Say(filter_ccdm::DescribePlan(input, settings));
    if (settings.engine.useMarkedEdges && filter_ccdm::SelectedEdgeCount(input) == 0)
        Say(QStringList("note: no face edge is selected"), Level::Warning);
    filter_ccdm::AttributeCarrier carrier(*source, input, settings);
    carrier.MarkFeatures(input, settings.engine);

    QElapsedTimer timer;
    timer.start();
    vcg::ccdm::Provenance provenance;
    vcg::ccdm::Report report =
        filter_ccdm::RemeshCopy(input, result, settings.engine, progress, carrier.Any() ? &provenance : nullptr);
    const filter_ccdm::Measured run(input, result, std::move(report), static_cast<double>(timer.elapsed()) / 1000,
                                    settings.engine.threads != 1);

    // The layer may be gone by now, and another in its memory.
    if (document.getMesh(id) != source)
        throw Failure("the layer was deleted while the filter was running");
    if (!settings.newLayer && !filter_ccdm::IsAsCopied(source->cm, input))
        throw Failure("the layer was changed while the filter was running");
    filter_ccdm::Outputs outputs = filter_ccdm::OutputsOf(run);
    outputs["kept_faces"] = provenance.keptFaces;
    QStringList lines, notes;
    for (const std::string &warning : run.report.warnings)
        notes << "note: " + QString::fromStdString(warning);
    MeshModel *target = source;
    if (settings.newLayer)
        target = document.addNewMesh("", NewLayerName(source->label()), false);
    try {
        filter_ccdm::LayerContent content(result, *target);
        carrier.Carry(provenance, result, content);
        lines = carrier.Describe() + filter_ccdm::DescribeRun(run);
        content.Commit();
        if (settings.newLayer)
            filter_ccdm::CopySettings(*source, *target);
    } catch (...) {
        if (settings.newLayer)
            filter_ccdm::DeleteLayer(document, *target);
        throw;
    }
    if (settings.newLayer)
        document.setCurrentMesh(target->id());
    // The layer is there now: nothing below may fail.
    Say(lines);
    Say(notes, Level::Warning);
    return outputs;
}

void FilterCcdmPlugin::Say(const QStringList &lines, Level level) noexcept
{
    for (const QString &line : lines)
        Say("CCDM: ", line, level);
}

void FilterCcdmPlugin::Say(const char *beginning, const QString &line, Level level) noexcept
{
    const GLLogStream::Levels mark = level == Level::Warning ? GLLogStream::WARNING : GLLogStream::FILTER;
    try {
        const QByteArray text = beginning + line.toUtf8();
#if CCDM_HOST_API == 2020
        Log(mark, text.constData());
#else
        log(mark, text.constData());
#endif
    } catch (...) { // a line less in the log
    }
}

MESHLAB_PLUGIN_NAME_EXPORTER(FilterCcdmPlugin)

// Here, it needs no translation unit of its own.
#include "moc_filter_ccdm.cpp" // NOLINT(bugprone-suspicious-include)
