// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which side of cloth that has thickness is the outer one. Such cloth is closed all round, but for tunnels: two sheets that run beside
// each other, sewn together along rims.

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// Those of the faces that belong to the outer sheet. A face is of the same sheet as its neighbours, and of another one than the face close
/// behind it; the surest of these statements come first, and those that contradict them are left out: where folds pass through each other by the
/// thickness of the cloth, or along a rim.
/// @param faces  of `cloth`, turned outwards: away from what is between the sheets
/// @param opposite  the other edge at each edge, 3 f + k; -1 for none
/// @param thickness  m, between the sheets
/// Cost O(n log n).
std::vector<int> outer_sheet(const TriangleMesh& cloth, const std::vector<int>& faces, const std::vector<int>& opposite,
                             double thickness);

}  // namespace garmentfit
