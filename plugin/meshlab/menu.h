// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The filters as MeshLab shows them. Names are keys of scripts and never change.

#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/filters/filters.h"

namespace garmentfit::meshlab {

constexpr std::string_view k_title = "Garment Fitting: ";  ///< prefix of every name

enum class Task { run_stages, save_rig, load_rig, save_outfit, measure };

struct MenuEntry {
    std::string name;  ///< "Garment Fitting: Rig Body": in the menu and in .mlx scripts
    std::string python_name;  ///< "generate_garment_fitting_rig": in PyMeshLab
    std::string help;  ///< HTML
    Task task = Task::run_stages;
    const Filter* filter = nullptr;  ///< of the common table; null unless task is run_stages

    bool reads(Data data) const;
    /// Whether the dialog has units and axes of the body; other filters take them from the rig.
    bool begins_with_body() const;
    bool makes_rig() const;  ///< of which the weight of one bone is shown
    bool makes_maps() const;  ///< of ease, strain and pressure, of which one is shown
};

/// The five filters of the common table and four that only MeshLab has, in the order of the menu.
const std::vector<MenuEntry>& menu();

}  // namespace garmentfit::meshlab
