// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The filters as MeshLab shows them. Names are the keys of its scripts: they are never changed.

#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/filters/filters.h"

namespace garmentfit::meshlab {

constexpr std::string_view k_title = "Garment Fitting: ";  ///< what the name of every entry begins with

enum class Task { run_stages, save_rig, load_rig, measure };

struct MenuEntry {
    std::string name;  ///< "Garment Fitting: Rig Body": in the menu and in .mlx scripts
    std::string python_name;  ///< "generate_garment_fitting_rig": in PyMeshLab
    std::string help;  ///< HTML
    Task task = Task::run_stages;
    const Filter* filter = nullptr;  ///< of the common table; null unless the task is to run stages

    bool reads(Data data) const;
    /// Whether units and axes of the body are asked for; else those of its rig hold.
    bool begins_with_body() const;
    bool makes_rig() const;  ///< so that one bone's weight is shown
    bool makes_maps() const;  ///< of ease, strain and pressure, of which one is shown
};

/// The five filters of the common table and three that only MeshLab has, in the order of the menu.
const std::vector<MenuEntry>& menu();

}  // namespace garmentfit::meshlab
