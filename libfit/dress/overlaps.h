// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a body enters itself, as posed bodies do at armpits, laps and crossed arms: nothing can lie between such parts, whoever drapes it.

#include <vector>

#include "garmentfit/recover_pose.h"

namespace garmentfit {

/// Parts of a body that enter each other, deepest first. O(n log n).
/// @param near_cloth  of each vertex; what is far from cloth does not matter
std::vector<Overlap> overlaps(const TriangleMesh& body, const SkinWeights& weights,
                              const std::vector<char>& near_cloth);

}  // namespace garmentfit
