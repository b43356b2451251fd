// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The plugin for MeshLab 2020.09: a failure is a message and `false`.

#include "host_api.h"

class FilterGarmentFit : public QObject, public MeshFilterInterface {
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
    Q_INTERFACES(MeshFilterInterface)

public:
    FilterGarmentFit();

    QString pluginName() const override;
    QString filterName(FilterIDType id) const override;
    QString filterInfo(FilterIDType id) const override;
    FilterClass getClass(QAction* action) override;
    FILTER_ARITY filterArity(QAction* action) const override;
    int postCondition(QAction* action) const override;
    using MeshFilterInterface::initParameterSet;
    void initParameterSet(QAction* action, MeshDocument& document, RichParameterList& list) override;
    bool applyFilter(QAction* action, MeshDocument& document, const RichParameterList& list,
                     vcg::CallBackPos* callback) override;
};
