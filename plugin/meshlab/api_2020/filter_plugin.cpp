// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_plugin.h"

#include "dialog.h"
#include "menu.h"
#include "run_entry.h"
#include "scrolling_dialogs.h"

using namespace garmentfit::meshlab;

FilterGarmentFit::FilterGarmentFit()
{
    for (std::size_t id = 0; id < menu().size(); ++id) {
        typeList << FilterIDType(id);
        actionList << new QAction(filterName(FilterIDType(id)), this);
    }
    new ScrollingDialogs(QString::fromUtf8(k_title.data(), int(k_title.size())), this);
}

QString FilterGarmentFit::pluginName() const { return "FilterGarmentFit"; }
QString FilterGarmentFit::filterName(FilterIDType id) const { return QString::fromStdString(menu().at(id).name); }
QString FilterGarmentFit::filterInfo(FilterIDType id) const { return QString::fromStdString(menu().at(id).help); }
MeshFilterInterface::FilterClass FilterGarmentFit::getClass(QAction*) { return Layer; }
MeshFilterInterface::FILTER_ARITY FilterGarmentFit::filterArity(QAction*) const { return FIXED; }
// existing layers stay unchanged
int FilterGarmentFit::postCondition(QAction*) const { return MeshModel::MM_NONE; }

void FilterGarmentFit::initParameterSet(QAction* action, MeshDocument& document, RichParameterList& list)
{
    list = dialog_for(menu().at(ID(action)), document);
}

bool FilterGarmentFit::applyFilter(QAction* action, MeshDocument& document, const RichParameterList& list,
                                   vcg::CallBackPos* callback)
{
    try {
        const Report report = run_entry(menu().at(ID(action)), list, document, progress_to(callback));
        for (const std::string& line : report.lines)
            Log(line);
        for (const std::string& warning : report.warnings)
            Log(GLLogStream::WARNING, warning);
        return true;
    } catch (const std::exception& error) {  // whatever leaves this function ends MeshLab
        errorMessage = QString(error.what()).toHtmlEscaped();
        Log(GLLogStream::WARNING, std::string(error.what()));  // meshlabserver shows no other message
        return false;
    }
}

MESHLAB_PLUGIN_NAME_EXPORTER(FilterGarmentFit)
