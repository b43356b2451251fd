// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A garment made ready to move. What needs its vertices welded and its edges listed takes this value, so both are done
// once for a garment.

#include <vector>

#include "garmentfit/mesh.h"
#include "sewn_pieces.h"
#include "topology.h"
#include "untangle.h"
#include "weld.h"

namespace garmentfit {

struct PreparedCloth {
    Weld weld;  ///< between the garment's own vertices and those of the cloth
    GarmentMesh rest;  ///< welded
    MeshTopology topology;  ///< of rest.triangles
    Positions positions;  ///< at the start, welded, n x 3
    SewnPieces sewn;  ///< of rest
    std::vector<Crossing> crossings;  ///< pairs of the cloth that cross there and stay as they are
    std::vector<int> garments;  ///< of each vertex of the cloth its garment; empty: one
};

/// Welds the garment (near vertices, too: near_vertices.h), lists its edges, and finds which of its pieces are sewn
/// together. `start` holds positions of the
/// garment's own vertices. Nothing is untangled: `crossings` stays empty.
/// @param garments  of each vertex its garment, where `rest` has several. Empty: one.
PreparedCloth prepare_cloth(const GarmentMesh& rest, const Positions& start, const std::vector<int>& garments = {});

/// Untangles the cloth where it can be done without meeting the obstacle, and writes down what still crosses.
void untangle_clear_of(PreparedCloth& cloth, const TriangleMesh& obstacle);

}  // namespace garmentfit
