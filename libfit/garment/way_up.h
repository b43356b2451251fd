// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which way up a garment may be worn that was given turned in some way.

#include <vector>

#include "garment_openings.h"

namespace garmentfit {

struct WayUp {
    Eigen::Quaterniond turn;  ///< makes the garment upright
    double evidence = 0;  ///< how clearly its openings speak for it, at most 1; below 0 they speak against it
};

/// The ways worth trying, best evidence first. Only as given where the openings speak for it; else with each axis of the room for the vertical, and
/// each line along which the garment is spread, or its openings follow each other; what is nearly an axis of the room is taken for it.
/// @param outward  from outward_cloth. Cost O(n).
std::vector<WayUp> ways_up(const TriangleMesh& outward, const std::vector<Opening>& openings);

}  // namespace garmentfit
