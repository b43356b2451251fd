// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "garmentfit/mesh.h"

namespace garmentfit {

/// Ties that hold buttons, pockets and badges, which are modelled as pieces of their own, on the cloth that they lie on: pairs of a vertex of such a
/// piece and one of the cloth, enough of them that the piece can neither slide nor turn. A piece is taken for one if it is no longer than
/// 25 cm and nowhere further than 2 cm from a longer one.
/// @param rest  welded
/// Cost O(n log n).
std::vector<std::pair<int, int>> ties_of_loose_parts(const GarmentMesh& rest);

}  // namespace garmentfit
