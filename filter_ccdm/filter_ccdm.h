// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef FILTER_CCDM_FILTER_CCDM_H
#define FILTER_CCDM_FILTER_CCDM_H

#include <QObject>

#include "host_api.h"

/// MeshLab's face of the remesher: names, parameters, one call, a report in the log.
class FilterCcdmPlugin : public QObject, public CCDM_FILTER_BASE
{
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(CCDM_FILTER_IID)
    Q_INTERFACES(CCDM_FILTER_BASE)

public:
    enum { FP_CCDM_REMESHING };

    FilterCcdmPlugin();

    QString pluginName() const override;
    QString filterName(FilterIDType id) const override;
    QString filterInfo(FilterIDType id) const override;
    FilterClass getClass(QAction *) override;
    FILTER_ARITY filterArity(QAction *) const override;
    int getPreConditions(QAction *) const override;
    int postCondition(QAction *) const override;
    void initParameterSet(QAction *, MeshModel &layer, RichParameterList &parameters) override;
    bool applyFilter(QAction *, MeshDocument &document, const RichParameterList &parameters,
                     vcg::CallBackPos *progress) override;

private:
    /// The filter proper; throws when there is no result, and has not touched the document then.
    void remesh(MeshDocument &document, const RichParameterList &parameters, vcg::CallBackPos *progress);
    bool _running = false;
};

#endif
