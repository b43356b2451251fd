// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/mesh.h"

namespace garmentfit {

/// The user's vertices, with those that were cut off moved to the nearest stump. Vertices are cut off where faces were
/// deleted and vertices left, of a hand for example. Next to a thigh they still belong to the arm. O(n log n).
Positions move_to_stumps(const BodyMesh& body);

}  // namespace garmentfit
