// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Units and axes of a mesh: what the user says, or else a guess.

#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/units.h"

namespace garmentfit {

/// What the user says about units and axes: "m", "cm", ... and "+y", "-z", ...; "auto" leaves it to a guess.
struct FrameChoice {
    std::string unit = "auto", up = "auto";
};

/// Possible values, for hosts that show a list; "auto" comes first.
const std::vector<std::string_view>& unit_choices();
const std::vector<std::string_view>& axis_choices();

/// What the user says, and a guess of the rest; margins are 1 where the user said it. @throws InvalidInput.
FrameGuess body_frame(const Positions& positions, const Triangles& triangles, const FrameChoice& choice = {});
/// The same for a garment, given the body's frame. @throws InvalidInput.
FrameGuess garment_frame(const Positions& positions, const Triangles& triangles, const Frame& body,
                         const FrameChoice& choice = {});

}  // namespace garmentfit
