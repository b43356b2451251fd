// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Warnings, one line each: guesses of low confidence, and results that differ from what was asked for.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/filters/filters.h"
#include "garmentfit/io.h"
#include "garmentfit/units.h"

namespace garmentfit {

/// Tells the users of a host to set a parameter: "give --swap-sides", "set swap_sides".
using HowToSet = std::function<std::string(std::string_view parameter)>;

/// "set swap_sides": for hosts that show parameters by their names.
std::string set_by_name(std::string_view parameter);

/// About a mesh's unit and axes. @param prefix  of the parameters that settle them: "" or "garment_"
std::vector<std::string> warnings_about_frame(const std::string& mesh, const FrameGuess& guess,
                                              const std::string& prefix, const HowToSet& set);

/// About parts of a garment's file that belong to the shape in it: a skin, morph targets, tangents, animations.
std::vector<std::string> warnings_about_left_behind(const MeshFile& garment);

/// About left and right.
std::vector<std::string> warnings_about_rig(const Scene& scene, const HowToSet& set);

/// About a rig that a user gave, where something speaks against it (doubt_about() in given_rig.h).
/// @param called  the rig in the warning
std::vector<std::string> warnings_about_given_rig(const Rig& rig, const BodyMesh& body, const std::string& called);

/// About garments that were not fitted in one pose, about type, front and up where they are guessed with a low
/// probability, and about ends closed by caps.
std::vector<std::string> warnings_about_fits(const Scene& scene, const std::vector<std::string>& names,
                                             const HowToSet& set);

/// About several garments whose types and widths suggest another order than the one they are worn in.
std::vector<std::string> warnings_about_layers(const Scene& scene, const std::vector<std::string>& names,
                                               const HowToSet& set);

/// About the dressed garments: overstretched, not at rest, slipped, crossing themselves as given.
std::vector<std::string> warnings_about_dressing(const Dressing& dressing, const std::vector<std::string>& names);

/// All of the above but frames. `names` are those of the garments.
std::vector<std::string> warnings_about_scene(const Scene& scene, const std::vector<std::string>& names,
                                              const HowToSet& set);

}  // namespace garmentfit
