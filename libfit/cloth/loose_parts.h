// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "garmentfit/mesh.h"
#include "topology.h"

namespace garmentfit {

/// Ties that hold buttons, pockets and badges, which are modelled as pieces of their own, on the cloth that they lie
/// on: pairs of a vertex of such a part and one of the cloth, enough of them that the part can neither slide nor turn.
/// A piece is such a part if it is no longer than 25 cm and nowhere further than 2 cm from a longer piece (tuning.h).
/// @param rest      welded
/// @param topology  of rest.triangles
/// Cost O(n log n).
std::vector<std::pair<int, int>> find_loose_part_ties(const GarmentMesh& rest, const MeshTopology& topology);

}  // namespace garmentfit
