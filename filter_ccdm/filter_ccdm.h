// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_CCDM_H
#define FILTER_CCDM_H

#include <mutex>
#include <thread>
#include <vector>

#include <QObject>
#include <QStringList>

#include "host_api.h"
#include "run_report.h"

namespace filter_ccdm {

/// The threads that are inside of a run. Not a thread-local mark: where there is no memory for that, the C library
/// ends the process.
struct RunningThreads {
    std::mutex mutex;
    std::vector<std::thread::id> ids;
};

} // namespace filter_ccdm

/// The remesher as a filter of MeshLab: names, parameters, one call, a report in the log. The host's versions
/// differ in the signatures only; what they do is in Attempt().
class FilterCcdmPlugin : public QObject, public CCDM_FILTER_BASE
{
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(CCDM_FILTER_IID)
    Q_INTERFACES(CCDM_FILTER_BASE)

public:
    enum { FP_CCDM_REMESHING };

    FilterCcdmPlugin();

    QString pluginName() const override;
    QString filterName(int id) const override;
    QString filterInfo(int id) const override;
    CCDM_ARITY filterArity(CCDM_ACTION *) const override;
    int getPreConditions(CCDM_ACTION *) const override;
    int postCondition(CCDM_ACTION *) const override;
#if CCDM_HOST_API == 2020
    FilterClass getClass(QAction *) override;
    void initParameterSet(QAction *, MeshModel &layer, RichParameterList &parameters) override;
    void initParameterSet(QAction *, MeshDocument &document, RichParameterList &parameters) override;
    bool applyFilter(QAction *, MeshDocument &document, const RichParameterList &parameters,
                     vcg::CallBackPos *progress) override;
#else
    QString vendor() const override;
    QString pythonFilterName(int id) const override;
    FilterClass getClass(const QAction *) const override;
    RichParameterList initParameterList(const QAction *, const MeshModel &layer) override;
    RichParameterList initParameterList(const QAction *, const MeshDocument &document) override;
    std::map<std::string, QVariant> applyFilter(const QAction *, const RichParameterList &parameters,
                                                MeshDocument &document, unsigned int &postConditionMask,
                                                vcg::CallBackPos *progress) override;
#endif

private:
    filter_ccdm::RunningThreads _running;

    enum class Level { Plain, Warning };
    struct Outcome {
        bool done = false;
        QString cause; // when it is not done; plain text
        filter_ccdm::Outputs outputs;
    };

    /// A guarded Remesh(): no exception leaves it.
    Outcome Attempt(MeshDocument &document, const RichParameterList &parameters, vcg::CallBackPos *progress);

    /// The filter proper; throws when there is no result, and has not touched the document then.
    filter_ccdm::Outputs Remesh(MeshDocument &document, const RichParameterList &parameters,
                                vcg::CallBackPos *progress);

    /// Into the log, if there is memory for it.
    void Say(const QStringList &lines, Level level = Level::Plain) noexcept;
    void Say(const char *beginning, const QString &line, Level level) noexcept;
};

#endif
