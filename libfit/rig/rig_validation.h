// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "garmentfit/skeleton.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// Refuses compact shapes such as blocks and balls, before expensive work. O(n). @throws InvalidInput with the number.
void check_shape(const TriangleMesh& closed);

/// Checks that a skeleton is human: bones inside the body, equal lengths left and right, usual proportions, feet that
/// point the same way.
/// O(samples * triangles). @throws InvalidInput that names the failed test, with numbers.
void check_rig(const TriangleMesh& closed, const Skeleton& skeleton);

/// How human a skeleton in a body is.
struct HumanLikeness {
    double squares = 0;  ///< of deviations beyond a human's limits, in standard deviations; 0 where check_rig passes
    std::string furthest;  ///< what is furthest from human, with numbers; empty where nothing is
};

/// The tests of check_rig by degrees, with guessed spreads. @throws InvalidInput (not_human) when lengths are not
/// finite or little of the skeleton is inside: then it is no skeleton of this body.
HumanLikeness human_likeness(const TriangleMesh& closed, const Skeleton& skeleton);

}  // namespace garmentfit
