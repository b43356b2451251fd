// SPDX-License-Identifier: GPL-3.0-or-later

// A scene, in metres with +y up, and the frames of its inputs.

#ifndef known_scene_h
#define known_scene_h

#include <string>
#include <vector>

#include "garmentfit/filters/filters.h"
#include "garmentfit/units.h"

namespace garmentfit {

/// Arrays with the points of the input, where they were moved: of the body, and of garments.
constexpr const char* k_input_position = "InputPosition";
constexpr const char* k_rest_position = "RestPosition";

struct KnownScene {
    Scene scene;
    Frame body_frame;
    std::vector<Frame> garment_frames;
    std::vector<std::string> garment_names;  ///< of their blocks in a composite
    std::vector<std::string> body_warnings;  ///< one line for each guess that is uncertain, and about a given rig
    std::vector<std::string> garment_frame_warnings;  ///< one line for each guess that is uncertain
};

}  // namespace garmentfit

#endif
