// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a user should know before believing a result: guesses that could well be wrong, and what came out other than asked
// for. One line each; hosts show them as warnings.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/filters/filters.h"
#include "garmentfit/units.h"

namespace garmentfit {

/// Tells the host's users to set a parameter: "give --swap-sides", "set swap_sides".
using HowToSet = std::function<std::string(std::string_view parameter)>;

/// Of a mesh's unit and axes. @param prefix  of the parameters that settle them: "" or "garment_"
std::vector<std::string> warnings_about_frame(const std::string& mesh, const FrameGuess& guess,
                                              const std::string& prefix, const HowToSet& set);

/// Where types and widths of garments say another order than they are worn in.
std::vector<std::string> warnings_about_layers(const Scene& scene, const std::vector<std::string>& names,
                                               const HowToSet& set);

/// Of how the garments ended up: where cloth is overstretched, moves still, slipped, crosses itself as it was given.
std::vector<std::string> warnings_about_dressing(const Dressing& dressing, const std::vector<std::string>& names);

/// Of sides, garment types, poses and of how the garments ended up. Garments are called by their `names`.
std::vector<std::string> warnings_about_scene(const Scene& scene, const std::vector<std::string>& names,
                                              const HowToSet& set);

}  // namespace garmentfit
