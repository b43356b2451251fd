// SPDX-License-Identifier: GPL-3.0-or-later

// A scene, which is in metres with +y up, and how it was given.

#ifndef known_scene_h
#define known_scene_h

#include <string>
#include <vector>

#include "garmentfit/filters/filters.h"
#include "garmentfit/units.h"

namespace garmentfit {

constexpr const char* k_own_position
    = "OwnPosition";  ///< the array with the body's points as given, where they were moved
constexpr const char* k_rest_position = "RestPosition";  ///< the same of garments

struct KnownScene {
    Scene scene;
    Frame body_frame;
    std::vector<Frame> garment_frames;
    std::vector<std::string> garment_names;  ///< of their blocks
};

}  // namespace garmentfit

#endif
