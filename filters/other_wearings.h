// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The second choice: other ways of wearing a garment, where the most probable one ends badly.

#include <cstddef>
#include <functional>

#include "garmentfit/error.h"
#include "garmentfit/filters/filters.h"

namespace garmentfit {

/// The cloth lies across the bones of the body, so draping cannot start.
class RefusedGarment : public InvalidInput {
public:
    RefusedGarment(std::size_t index, const std::string& message) :
        InvalidInput(ErrorCode::crossing_start, message), garment(index)
    {
    }
    std::size_t garment;  ///< of the scene
};

/// How dressing ends.
enum class End {
    worn,
    torn_or_slipped,  ///< certified, but drawn out to several times its length, or fallen off
    too_small,
    not_certified,
    refused,  ///< there is no result
    count
};

/// How much speaks for a way of wearing a garment once it was tried: its probability before, times that of such an end
/// if garments are worn as they should, and that of the size which it needs (decision 23). Comparable for ways of wearing
/// one garment.
/// @param size  factor by which the garment was made larger for this way
double plausibility(double probability, End end, double size = 1);

/// The garment faces alike, and lies round every bone that it covers in the other way, too: one way under two names.
bool is_within(const FitResult& way, const FitResult& other);

/// How to dress a scene that has its rig.
struct DressingSteps {
    std::function<void(Scene&)> fit, drape_and_recover;
};

/// Where a garment is too small that was scaled to the body as no unit explains its size, that guess was wrong: it is
/// fitted anew at the size of its most probable unit, and stays so where it is worn.
void try_size_in_unit(Scene& scene, const DressingSteps& steps, const Progress& progress);

/// Where a garment whose file has no unit is too small, cannot be put on, or slips off in the end, it is tried in
/// larger or smaller sizes, and stays so in the first in which it is worn where it was put on, with all its pieces, and
/// in the same way if there was one.
/// @param refused  as below
void try_other_sizes(Scene& scene, const DressingSteps& steps, std::size_t refused, const Progress& progress);

/// Where a garment is too small, crosses, is held back or torn, the next probable ways of wearing it are tried while
/// one of them can be more plausible, and the scene keeps the most plausible one. What was tried in vain is added to
/// FitResult::rejected.
/// @param refused  of a scene that could not be draped: the garment which hindered it; else not read
void try_other_wearings(Scene& scene, const DressingSteps& steps, std::size_t refused, const Progress& progress);

}  // namespace garmentfit
