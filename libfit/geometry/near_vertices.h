// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Vertices that file formats with few digits, or seams that nobody welded, have left at nearly the same place.

#include <optional>
#include <vector>

#include "garmentfit/mesh.h"
#include "topology.h"

namespace garmentfit {

/// Positions in which vertices that are connected by an edge, or lie on borders, and are closer than 0.1 mm, are at the
/// same place: that of the first of them. None if there are no such vertices.
///
/// Motion is cut where distances fall below about that length, so such borders would hold each other fast. An edge that
/// short has no direction, and was stretched a thousandfold.
/// @param cloth     welded, m on a body of human size
/// @param topology  of cloth.triangles
/// @param garments  of each vertex its garment; vertices of two garments stay apart. Empty: one garment.
/// Cost O(n log n) for borders that are not all in one plane x = const.
std::optional<Positions> merge_near_vertices(const GarmentMesh& cloth, const MeshTopology& topology,
                                             const std::vector<int>& garments = {});

}  // namespace garmentfit
