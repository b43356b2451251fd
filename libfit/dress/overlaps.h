// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds where a body enters itself, as posed bodies do at armpits, laps and crossed arms: no cloth can lie between such
// parts.

#include <vector>

#include "garmentfit/recover_pose.h"

namespace garmentfit {

/// Pairs of parts of a body that enter each other, deepest first. O(n log n).
/// @param near_cloth  of each vertex; only those count
std::vector<Overlap> find_overlaps(const TriangleMesh& body, const SkinWeights& weights,
                                   const std::vector<char>& near_cloth);

}  // namespace garmentfit
