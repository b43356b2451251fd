// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How much of the skin clothes hide from who looks at a body from all sides.
//
// Method  depth pictures of the clothes in many directions, each for two viewers: along it and against it.
// Cost    O(n) for each picture; n vertices of the body and faces of the clothes.

#include <vector>

#include "garmentfit/mesh.h"

namespace garmentfit {

/// All clothes as one mesh.
TriangleMesh joined(const std::vector<TriangleMesh>& clothes);

/// `count` directions evenly over half a sphere, which together with their opposites cover all of it. `phase` of
/// `phases` turns: other directions in each.
std::vector<Vec3> viewing_directions(int count, int phase = 0, int phases = 1);

/// Of each vertex of the body the share of the directions that it faces from which cloth hides it, at any distance: 0
/// where it is bare, 1 where it is never seen.
/// @param cloth  all clothes, in the space of the body
/// @param pixel  m, the side of a pixel
Eigen::VectorXd shares_hidden_by_cloth(const TriangleMesh& body, const TriangleMesh& cloth,
                                       const std::vector<Vec3>& directions, double pixel);

}  // namespace garmentfit
