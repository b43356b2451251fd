// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the user chose in a dialog or a script.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "garmentfit/filters/filters.h"
#include "garmentfit/filters/frame_choice.h"
#include "garmentfit/filters/outfit.h"
#include "host_api.h"
#include "menu.h"

namespace garmentfit::meshlab {

/// The map that becomes quality and colour of a dressed garment.
enum class ShownMap { ease, strain, pressure, none };

struct Choice {
    MeshModel* body = nullptr;
    std::vector<MeshModel*> garments;  ///< innermost first
    std::vector<GarmentType> types;  ///< of the garments
    std::vector<std::optional<Fabric>> fabrics;  ///< of the garments; empty: as in the parameters
    std::vector<std::string> garment_fronts;  ///< axes of the garments' layers, or "auto"
    MeshModel* worn = nullptr;  ///< the first garment, on the body
    FrameChoice body_frame, garment_frame;
    std::string front = "auto";  ///< axis of the body's layer
    Parameters parameters;  ///< lengths still in the body's own unit
    Bone shown_bone = thorax;
    ShownMap shown_map = ShownMap::ease;
    std::filesystem::path file;
    std::optional<BoneNames> outfit_bones = {};  ///< none: those of the body's file
    std::filesystem::path body_file;  ///< empty: that of the body's layer
    bool hide_covered_skin = false;
    int influences = k_few_influences;  ///< joints of a vertex of the clothes, at most
};

/// @throws InvalidInput where a layer does not exist or is chosen twice.
Choice read_choice(const MenuEntry& entry, const RichParameterList& list, MeshDocument& document);

/// Converts lengths from the body's unit to metres. A default becomes again the command line's, digit by digit.
void put_lengths_in_metres(const MenuEntry& entry, Parameters& parameters, double metres_per_unit);

}  // namespace garmentfit::meshlab
