// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The skin under clothes drawn in, so that fewer poses push it through the cloth: files of outfits hold a body that is
// slimmer where clothes cover it.
//
// Method  skin is under cloth where cloth hides it from four of five directions that it faces, in the pose in which the
//         clothes are worn. It goes inwards by 6 cm (of an adult), by a share of the limb's thickness at most, and the
//         less the nearer bare skin is.
// Cost    O(n log m + 100 (n + m)): a ray for each of n vertices of the body, and 100 depth pictures of m faces of body
//         and clothes.

#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/mesh.h"

namespace garmentfit {

/// n x 3: the vertices of the body, those of bare skin where they were.
/// @param body     in the pose in which the clothes are worn
/// @param clothes  worn, in the same space
GARMENTFIT_API Positions inset_skin(const TriangleMesh& body, const std::vector<TriangleMesh>& clothes);

}  // namespace garmentfit
