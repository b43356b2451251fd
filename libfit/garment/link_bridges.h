// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "garmentfit/mesh.h"
#include "sewn_pieces.h"
#include "topology.h"

namespace garmentfit {

/// Two triangles between the nearest border edges of two parts that a ring joins: a strap goes on into the bodice, and
/// parts the armhole from the neck. Not where they would part a small hole from the border, as a belt's end in its
/// buckle does. O(n) for each link, and its border edges squared.
/// @return whether there were any
bool bridge_links(GarmentMesh& cloth, const MeshTopology& topology, const std::vector<SewnDetail>& details);

}  // namespace garmentfit
