// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/mesh.h"

namespace garmentfit {

/// The user's vertices, but those that were cut off (of a hand, say, whose faces were deleted and whose vertices were left)
/// brought to the nearest stump: beside a thigh they still belong to the arm. O(n log n); nothing to do where all have faces.
Positions brought_to_stumps(const BodyMesh& body);

}  // namespace garmentfit
