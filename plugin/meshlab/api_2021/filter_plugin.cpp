// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_plugin.h"

#include "dialog.h"
#include "menu.h"
#include "run_entry.h"

using namespace garmentfit::meshlab;

FilterGarmentFit::FilterGarmentFit()
{
    for (std::size_t id = 0; id < menu().size(); ++id) {
        typeList.push_back(ActionIDType(id));
        actionList.push_back(new QAction(filterName(ActionIDType(id)), this));
    }
}

QString FilterGarmentFit::pluginName() const { return "FilterGarmentFit"; }
QString FilterGarmentFit::vendor() const { return "GarmentFit"; }
QString FilterGarmentFit::filterName(ActionIDType id) const { return QString::fromStdString(menu().at(id).name); }
QString FilterGarmentFit::filterInfo(ActionIDType id) const { return QString::fromStdString(menu().at(id).help); }
FilterPlugin::FilterClass FilterGarmentFit::getClass(const QAction*) const { return Layer; }
FilterPlugin::FilterArity FilterGarmentFit::filterArity(const QAction*) const { return FIXED; }
// existing layers stay unchanged
int FilterGarmentFit::postCondition(const QAction*) const { return MeshModel::MM_NONE; }

QString FilterGarmentFit::pythonFilterName(ActionIDType id) const
{
    return QString::fromStdString(menu().at(id).python_name);
}

RichParameterList FilterGarmentFit::initParameterList(const QAction* action, const MeshDocument& document)
{
    return dialog_for(menu().at(ID(action)), document);
}

std::map<std::string, QVariant> FilterGarmentFit::applyFilter(const QAction* action, const RichParameterList& list,
                                                              MeshDocument& document, unsigned int& post_condition,
                                                              vcg::CallBackPos* callback)
{
    try {
        post_condition = MeshModel::MM_NONE;
        const Report report = run_entry(menu().at(ID(action)), list, document, progress_to(callback));
        for (const std::string& line : report.lines)
            log("%s", line.c_str());
        for (const std::string& warning : report.warnings)
            log(GLLogStream::WARNING, warning);
        return { report.numbers.begin(), report.numbers.end() };
    } catch (const std::exception& error) {  // whatever else leaves this function ends MeshLab
        throw MLException(QString(error.what()));
    }
}

MESHLAB_PLUGIN_NAME_EXPORTER(FilterGarmentFit)
