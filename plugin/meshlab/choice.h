// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the user chose in a dialog or a script.

#include <filesystem>
#include <string>
#include <vector>

#include "garmentfit/filters/filters.h"
#include "garmentfit/filters/frame_choice.h"
#include "host_api.h"
#include "menu.h"

namespace garmentfit::meshlab {

/// What becomes quality and colour of a dressed garment.
enum class ShownMap { ease, strain, pressure, none };

/// What the user chose.
struct Choice {
    MeshModel* body = nullptr;
    std::vector<MeshModel*> garments;  ///< from the inside out
    std::vector<GarmentType> types;  ///< of the garments
    MeshModel* worn = nullptr;  ///< the first garment, on the body
    FrameChoice body_frame, garment_frame;
    std::string front = "auto";  ///< an axis of the body's layer
    Parameters parameters;  ///< lengths still in the body's own unit
    Bone shown_bone = thorax;
    ShownMap shown_map = ShownMap::ease;
    std::filesystem::path file;
};

/// @throws InvalidInput: a layer that is not there, or chosen twice.
Choice read_choice(const MenuEntry& entry, const RichParameterList& list, MeshDocument& document);

/// Lengths from the body's unit to metres; a default is again what it is on the command line, digit by digit.
void put_lengths_in_metres(const MenuEntry& entry, Parameters& parameters, double metres_per_unit);

}  // namespace garmentfit::meshlab
