// SPDX-License-Identifier: GPL-3.0-or-later

// Writes the example scripts for meshlabserver, with a body as layer 0 and a garment as layer 1. meshlabserver needs
// every parameter of a filter in a script, so this program reads them from the plugin.
//
//   meshlab-scripts PLUGIN_FOLDER BODY GARMENT OUT_FOLDER

#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <QApplication>
#include <QDir>

#include <common/filterscript.h>
#include <common/pluginmanager.h>

#include "garmentfit/error.h"
#include "open_layer.h"

namespace {

namespace fs = std::filesystem;
using namespace garmentfit;

struct Script {
    std::string name;
    std::vector<std::string> filters;
};

/// Each filter after those that it needs.
const std::vector<Script> k_scripts {
    { "rig_body", { "Rig Body" } },
    { "fit_skeleton", { "Rig Body", "Fit Skeleton" } },
    { "drape_garment", { "Rig Body", "Fit Skeleton", "Drape Garment" } },
    { "recover_pose", { "Rig Body", "Fit Skeleton", "Drape Garment", "Recover Pose" } },
    { "dress_body", { "Dress Body" } },
    { "save_rig", { "Rig Body", "Save Rig" } },
    { "load_rig", { "Load Rig" } },
    { "save_outfit", { "Dress Body", "Save Outfit" } },
    { "measurements", { "Dress Body", "Body Measurements and Ease" } },
};

constexpr int k_dressed_layer = 7;  // derived: the last of Dress Body's layers in a document of a body and a garment

RichParameterList parameters_of(const PluginManager& plugins, const QString& filter, MeshDocument& document)
{
    QAction* const action = plugins.actionFilterMap.value(filter);
    if (!action)
        throw InvalidInput("the plugin folder has no filter " + filter.toStdString());
    RichParameterList list;
    qobject_cast<MeshFilterInterface*>(action->parent())->initParameterSet(action, document, list);
    if (list.hasParameter("worn"))
        static_cast<RichMesh&>(list.getParameterByName("worn")).meshindex = k_dressed_layer;
    if (list.hasParameter("file"))  // a name without folder: meshlabserver's working directory
        list.setValue("file", FileValue(QFileInfo(list.getParameterByName("file").value().getFileName()).fileName()));
    return list;
}

void write_script(const PluginManager& plugins, const Script& script, MeshDocument& document, const fs::path& folder)
{
    FilterScript written;
    for (const std::string& filter : script.filters) {
        FilterNameParameterValuesPair step;
        step.first = QString::fromStdString("Garment Fitting: " + filter);
        step.second = parameters_of(plugins, step.first, document);
        written.append(step);
    }
    const fs::path path = folder / (script.name + ".mlx");
    if (!written.save(QString::fromStdString(path.string())))
        throw InvalidInput("cannot write " + path.string());
}

void write_scripts(const fs::path& plugin_folder, const fs::path& body, const fs::path& garment, const fs::path& folder)
{
    PluginManager plugins;
    RichParameterList settings;
    plugins.loadPlugins(settings, QDir(QString::fromStdString(plugin_folder.string())));
    MeshDocument document;
    meshlab::open_layer(document, body);
    meshlab::open_layer(document, garment);
    fs::create_directories(folder);
    for (const Script& script : k_scripts)
        write_script(plugins, script, document, folder);
}

}  // namespace

int main(int argc, char** argv)
{
    const QApplication application(argc, argv);
    if (argc != 5) {
        std::cerr << "meshlab-scripts PLUGIN_FOLDER BODY GARMENT OUT_FOLDER\n";
        return 2;
    }
    try {
        write_scripts(argv[1], argv[2], argv[3], argv[4]);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << "meshlab-scripts: " << error.what() << '\n';
        return 2;
    }
}
