// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which pieces of a garment are sewn to which, and where.
//
// Clothes come in pieces that share no vertex: panels with unwelded seams, pockets, flaps, buttons, collars, linings.
// A piece is sewn to a larger one of the same garment in one of two ways (lengths in tuning.h):
//
// Seam  its border lies along the border of the other. Both borders are tied. A piece may have seams with itself, and
//       holes without area, where one side of a seam has vertices that the other lacks, are tied across.
// Held  its border lies on the surface of the other, or its back does: nearly all of a piece that is small, or all of a
//       larger one much closer. What lies on the other is tied. Patches (discs, such as pockets) are
//       held by half of their border, and from further away: no limb passes through them, so nothing else holds them.
//       A drawstring or a pull, which would fall off, hangs where it touches.
//
// The border of a panel with thickness, which is closed, is its rim: the sharp edges between and about its two sheets.
//
// A button on a flap is tied to the flap, the flap to the coat. What is not sewn is a layer of its own.

#include <array>
#include <vector>

#include "garmentfit/mesh.h"
#include "garmentfit/pieces.h"
#include "topology.h"

namespace garmentfit {

/// A vertex of one piece and the nearest point of a triangle of another, or in a seam of a piece with itself, of its own.
struct Tie {
    int vertex;
    std::array<int, 3> corners;  ///< of the triangle
    std::array<double, 3> weights;  ///< barycentric
    bool is_seam = false;  ///< both are on borders
    bool is_own = false;  ///< of one piece
};

/// A piece such as a button, a bead or a belt loop: small, held by its back on a piece that is none, or in a seam.
struct SewnDetail {
    std::vector<int> vertices;
    /// Where it is a link, a ring or a buckle that alone holds two parts of that piece together, such as strap and
    /// bodice: the vertices of either part that it is sewn to.
    std::array<std::vector<int>, 2> linked = {};

    bool is_link() const { return !linked[0].empty(); }
};

struct SewnPieces {
    std::vector<Tie> ties;
    PieceCounts counts;
    std::vector<SewnDetail> details = {};
};

/// @param rest      welded
/// @param topology  of rest.triangles
/// @param garments  of each vertex its garment, where `rest` has several: these are not sewn to each other. Empty: one.
/// Cost O(n log n) for each pair of pieces that are close to each other, O(n + b log b) for a single piece with b vertices
/// on its border.
SewnPieces find_sewn_pieces(const GarmentMesh& rest, const MeshTopology& topology,
                            const std::vector<int>& garments = {});

}  // namespace garmentfit
