// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds the joints of a human among joints whose names say nothing, by their tree and places: two pairs of limbs, a
// trunk between them, a head beyond the arms.

#include <optional>
#include <vector>

#include "garmentfit/types.h"
#include "joint_names.h"

namespace garmentfit {

struct UnnamedJoints {
    std::vector<int> parents;  ///< rows of the same, in any order; -1: none
    std::vector<Vec3> places;  ///< in any unit, any axis up
    std::vector<double> masses;  ///< of the skin that hangs on each, by number of vertices or area
    std::vector<Vec3> centres;  ///< of that skin; anything where the mass is 0
};

/// The side is told by the feet, which point to the front. Joints between two of those that are named, fingers, twist
/// bones and helpers have no name. Empty where there is no such tree. O(n + number of pairs squared).
std::vector<std::optional<NamedJoint>> joints_by_tree(const UnnamedJoints& joints);

}  // namespace garmentfit
