// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Other garments in the mesh of one: files of shops may show two shirts side by side. A body can be in one of them
// only. And what garments are shown on.

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// The faces of each whole garment that stands beside the largest one: nearly as large, at its height, apart from it
/// sideways, and each with openings of its own for a trunk and limbs. A pair of socks, sleeves that are not sewn on,
/// and clothes over each other, are none. O(n log n); where something stands beside, another reading of each.
/// @param mesh  y up
/// @param patches  the faces of each
std::vector<std::vector<int>> find_garments_beside(const TriangleMesh& mesh,
                                                   const std::vector<std::vector<int>>& patches);

/// The faces of what stands apart from a whole garment, below it, say, is far larger, and lets no body pass: plinths,
/// and trimmings that an exporter wrote in another scale. None where something else may be worn, too. The cost is the
/// same.
std::vector<std::vector<int>> find_plinths(const TriangleMesh& mesh, const std::vector<std::vector<int>>& patches);

}  // namespace garmentfit
