// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/frame_choice.h"

namespace garmentfit {
namespace {

/// The guess, replaced by what the user said.
FrameGuess apply_choice(FrameGuess guess, const FrameChoice& choice)
{
    if (choice.unit != "auto") {
        guess.frame.metres_per_unit = metres_per(choice.unit);
        guess.unit_margin = 1;
    }
    if (choice.up != "auto") {
        guess.frame.up = axis_of(choice.up);
        guess.up_margin = 1;
    }
    return guess;
}

}  // namespace

const std::vector<std::string_view>& unit_choices()
{
    static const std::vector<std::string_view> choices { "auto", "m", "dm", "cm", "mm", "in", "ft" };
    return choices;
}

const std::vector<std::string_view>& axis_choices()
{
    static const std::vector<std::string_view> choices { "auto", "+x", "-x", "+y", "-y", "+z", "-z" };
    return choices;
}

FrameGuess body_frame(const Positions& positions, const Triangles& triangles, const FrameChoice& choice)
{
    return apply_choice(guess_body_frame(positions, triangles), choice);
}

FrameGuess garment_frame(const Positions& positions, const Triangles& triangles, const Frame& body,
                         const FrameChoice& choice)
{
    return apply_choice(guess_garment_frame(positions, triangles, body), choice);
}

}  // namespace garmentfit
