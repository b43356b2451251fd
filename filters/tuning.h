// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Fitted numbers of the filters. "Body metres" are metres on a body of human size: any other body is scaled to it first
// (body_scale.h).

namespace garmentfit {

/// Dimensionless, 0 undecided to 1 certain. Guesses with a smaller margin get a warning.
/// fitted: guess, on the twelve pairs of the house data
inline constexpr double k_low_confidence = 0.2;

/// Guesses of a smaller probability get a warning. derived: of what is said with more, four in five at least are right
/// (libfit/fit/evidence.h)
inline constexpr double k_low_probability = 0.8;

/// Probability below which another way of wearing a garment is not tried, where the most probable one ends badly, and how
/// many are. fitted: guess
inline constexpr double k_worth_trying = 0.05;
inline constexpr int k_other_wearings = 2;

/// l / l0 - 1 of an edge. Cloth that is stretched further has torn: it hangs on a part of the body that another way of
/// wearing it may leave free. fitted: guess, on the wild clothes
inline constexpr double k_torn = 2;

/// Body metres. A garment that slipped down by more gets a warning.
/// fitted: guess, on the twelve pairs of the house data: cloth that settles sinks by some centimetres, a coat by nine
inline constexpr double k_slipped = 0.15;

/// Share of a radius; and for thin bones metres, or on a body less than a metre across, a share of its diagonal. A rig
/// whose radii differ from the body's by more is another body's: files keep fewer digits than the rig was found with,
/// and two people differ by more.
/// fitted: guess, on tests/bodies
inline constexpr double k_same_radius = 0.02, k_same_place = 5e-4;

}  // namespace garmentfit
