// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A filter's parameters, from the one description to MeshLab's dialogs and scripts and back.

#include <filesystem>
#include <vector>

#include "filters/filters.h"
#include "filters/frame_choice.h"
#include "host_api.h"
#include "menu.h"

namespace fit::meshlab {

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

/// Nothing where the document has no layer.
RichParameterList dialog_for(const MenuEntry& entry, ShownDocument& document);

/// @throws InvalidInput: a layer that is not there, or chosen twice.
Choice read_dialog(const MenuEntry& entry, const RichParameterList& list, MeshDocument& document);

/// Lengths from the body's unit to metres, digit by digit what was typed where MeshLab keeps floats.
void put_lengths_in_metres(const MenuEntry& entry, Parameters& parameters, double metres_per_unit);

}  // namespace fit::meshlab
