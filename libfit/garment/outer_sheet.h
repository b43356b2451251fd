// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The outer sheet of cloth with thickness. Such cloth is a closed surface of genus above 0: two parallel sheets, joined
// along rims.

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// The faces that belong to the outer sheet. A face belongs to the same sheet as its neighbours, and to the other sheet
/// than the face close behind it. These relations are taken in order of their reliability, and relations that
/// contradict earlier ones are ignored: where folds intersect within the thickness, or along a rim. Where that leaves
/// tatters, all relations between two smooth regions are added up.
/// @param faces  of `cloth`, oriented outwards: away from the space between the sheets
/// @param opposite  for each half-edge 3 f + k the other half-edge; -1 for none
/// @param thickness  m, between the sheets
/// Cost O(n log n).
std::vector<int> outer_sheet(const TriangleMesh& cloth, const std::vector<int>& faces, const std::vector<int>& opposite,
                             double thickness);

}  // namespace garmentfit
