// SPDX-License-Identifier: GPL-3.0-or-later
#include "menu.h"

namespace garmentfit::meshlab {
namespace {

const char* const k_citation
    = "<br><br>See: <br><i>N. Wu, Z. Deng, Y. Huang, C. Liu, D. Zhang, X. Jin</i>, <b>\"A fast garment fitting "
      "algorithm "
      "using skeleton-based error metric\"</b>, Computer Animation and Virtual Worlds 29 (2018), doi:10.1002/cav.1811";

/// What a filter of the common table needs, and the layers that it makes.
const char* layers_of_filter(std::string_view name)
{
    if (name == "rig")
        return "Makes two layers: the body with its skin weights as vertex attributes joint0..3 and weight0..3 and one "
               "bone's weight as quality, and the skeleton as edges.";
    if (name == "fit")
        return "Needs a rigged body. Makes two layers for each garment: the body in the pose of the garment, and its "
               "skeleton.";
    if (name == "drape")
        return "Needs a fitted skeleton. Makes a layer for each garment, as it is worn in the fitted pose, with ease, "
               "strain and pressure as vertex attributes and one of them as quality.";
    if (name == "recover")
        return "Needs a draped garment. Makes a layer for each garment, as it is worn in the body's input pose, with "
               "ease, "
               "strain and pressure as vertex attributes and one of them as quality.";
    return "Makes the layers of the four filters; the intermediate layers are hidden.";
}

std::string entry_name(std::string_view label) { return std::string(k_title) + std::string(label); }

MenuEntry stages_entry(const Filter& filter)
{
    return {
        entry_name(filter.label), "generate_garment_fitting_" + std::string(filter.name),
        std::string(filter.help) + ". " + layers_of_filter(filter.name)
            + " Existing layers stay unchanged. Choose body and garments as they were given, also when you run the "
              "filters one by one."
            + k_citation,
        Task::run_stages, &filter
    };
}

std::vector<MenuEntry> make_menu()
{
    std::vector<MenuEntry> entries;
    for (const Filter& filter : filters())
        entries.push_back(stages_entry(filter));
    entries.push_back(
        { entry_name("Save Rig"), "save_garment_fitting_rig",
          "Writes a body's skeleton, skin weights and fitted poses into one JSON file, because MeshLab's own "
          "formats drop them. Filters find the file by its name: man.rig.json beside man.ply. The "
          "program garmentfit reads it with --rig.",
          Task::save_rig, nullptr });
    entries.push_back(
        { entry_name("Load Rig"), "load_garment_fitting_rig",
          "Reads a rig that Save Rig or the program garmentfit wrote for this body, and makes the layers of Rig Body.",
          Task::load_rig, nullptr });
    entries.push_back(
        { entry_name("Save Outfit"), "save_garment_fitting_outfit",
          "Writes a dressed body and its garments as one GLB or VRM that other programs can pose: one skeleton, and "
          "skin weights for body and garments, or the avatar's own file with the garments added. UVs, materials and "
          "textures come from the files of the layers. Needs a "
          "garment that Recover Pose or Dress Body put on.",
          Task::save_outfit, nullptr });
    entries.push_back(
        { entry_name("Body Measurements and Ease"), "get_garment_fitting_measurements",
          std::string("Measures how a garment sits on a body in the body's input pose. Writes the girths of "
                      "both to the log, and makes a layer with ease, strain and pressure as vertex "
                      "attributes and one of them as quality. Needs a rigged body.")
              + k_citation,
          Task::measure, nullptr });
    return entries;
}

}  // namespace

bool MenuEntry::reads(Data data) const { return filter && filter->reads(data); }

bool MenuEntry::begins_with_body() const { return filter && filter->has(Stage::rig); }

bool MenuEntry::makes_rig() const { return begins_with_body() || task == Task::load_rig; }

bool MenuEntry::makes_maps() const
{
    return task == Task::measure || (filter && (filter->has(Stage::drape) || filter->has(Stage::recover)));
}

const std::vector<MenuEntry>& menu()
{
    static const std::vector<MenuEntry> entries = make_menu();
    return entries;
}

}  // namespace garmentfit::meshlab
