// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The plugin for MeshLab since 2021.07 and for PyMeshLab: a failure is an MLException.

#include "host_api.h"

class FilterGarmentFit : public QObject, public FilterPlugin {
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
    Q_INTERFACES(FilterPlugin)

public:
    FilterGarmentFit();

    QString pluginName() const override;
    QString vendor() const override;
    QString filterName(ActionIDType id) const override;
    QString pythonFilterName(ActionIDType id) const override;
    QString filterInfo(ActionIDType id) const override;
    FilterClass getClass(const QAction* action) const override;
    FilterArity filterArity(const QAction* action) const override;
    int postCondition(const QAction* action) const override;
    RichParameterList initParameterList(const QAction* action, const MeshDocument& document) override;
    std::map<std::string, QVariant> applyFilter(const QAction* action, const RichParameterList& list,
                                                MeshDocument& document, unsigned int& post_condition,
                                                vcg::CallBackPos* callback) override;
};
