// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rotations that may make a garment upright.

#include <vector>

#include "garment_openings.h"

namespace garmentfit {

/// rad; a larger angle between the vertical and the nearest line says no more. fitted: guess
inline constexpr double k_most_askew = 0.5;

struct WayUp {
    Eigen::Quaterniond turn;  ///< rotation that makes the garment upright
    double evidence = 0;  ///< of the openings, at most 1; negative: evidence against it
    double askew
        = 0;  ///< rad, to the nearest line from opening to opening, at most k_most_askew; 0 where there is none
};

/// The rotations worth trying, best evidence first. Only the identity where the openings are evidence for it. Otherwise
/// the candidates for the vertical are the coordinate axes, the lines from opening to opening, and the principal axes
/// of the garment. A candidate close to a coordinate axis is replaced by that axis.
/// @param outward  from outward_cloth. Cost O(n).
std::vector<WayUp> ways_up(const TriangleMesh& outward, const std::vector<Opening>& openings);

}  // namespace garmentfit
