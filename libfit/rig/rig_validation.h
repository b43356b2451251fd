// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "garmentfit/rig_body.h"
#include "garmentfit/skeleton.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// Refuses compact shapes such as blocks and balls, before expensive work. Figures may be more compact than humans. O(n).
/// @throws InvalidInput with the number.
void check_shape(const TriangleMesh& closed, Humanlike humanlike);

/// Refuses what is more compact than a human and has next to no likeness with one: not a doll with a large head, but a
/// boat in which a figure was found. O(n). @throws InvalidInput as check_shape does
void check_figure(const TriangleMesh& closed, const Rig& rig);

/// Checks that a skeleton is human: bones inside the body, equal lengths left and right, usual proportions.
/// O(samples * triangles). @throws InvalidInput that names the failed test, with numbers.
void check_rig(const TriangleMesh& closed, const Skeleton& skeleton);

/// Refuses a skeleton with a foot that points backwards: toes were taken for a heel, or left and right are exchanged.
/// @throws InvalidInput
void check_feet(const Skeleton& skeleton);

/// How human a skeleton in a body is.
struct HumanLikeness {
    double squares = 0;  ///< of deviations beyond a human's limits, in standard deviations; 0 where there is none
    std::string furthest;  ///< what is furthest from human, with numbers; empty where nothing is
};

/// The tests of check_rig and check_feet by degrees, with guessed spreads. @throws InvalidInput (not_human) when lengths
/// are not finite or little of the skeleton is inside: then it is no skeleton of this body.
HumanLikeness human_likeness(const TriangleMesh& closed, const Skeleton& skeleton);

}  // namespace garmentfit
