// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How the connected pieces of a garment hold together.

#include "garmentfit/export.h"
#include "garmentfit/mesh.h"

namespace garmentfit {

/// Each piece but the largest one is counted once in `seamed`, `held` or `free`.
struct PieceCounts {
    int count = 0;  ///< connected pieces; vertices at the same place count as one
    int seamed = 0;  ///< with a border on the border of another piece, as panels with unwelded seams
    int held = 0;  ///< that lie on a larger piece with their border or their back: pockets, flaps, buttons, collars
    int free = 0;  ///< that lie on no larger piece, and so are layers of their own
};

/// m; how far the piece that went furthest is from the larger piece that it lay beside (within 5 cm): the least, over
/// its vertices, by which one is further from the place that it was next to. What hangs where it hung has not gone; what
/// fell off has, and what slid away as a whole. 0 where nothing lies beside another piece.
/// Cost O(n log n) for each pair of pieces that are close to each other.
/// @param garment    as given, on a body of human size
/// @param positions  as worn, n x 3, metres
GARMENTFIT_API double longest_piece_shift(const GarmentMesh& garment, const Positions& positions);

/// The rule that draping holds pieces by. Cost O(n log n) for each pair of pieces that are close to each other.
/// @param garment  as given, on a body of human size
GARMENTFIT_API PieceCounts count_pieces_held(const GarmentMesh& garment);

}  // namespace garmentfit
