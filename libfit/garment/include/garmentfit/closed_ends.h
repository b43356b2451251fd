// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Garments whose cuffs, ankles, neck or hem are closed by flat caps, and what lies in them that is no cloth.

#include "garmentfit/export.h"
#include "garmentfit/mesh.h"

namespace garmentfit {

/// Pieces of a garment's mesh that are no cloth, and share no vertex with it.
struct LeftOut {
    int solids = 0;  ///< that fill it
    int lids = 0;  ///< that lie loosely in its openings
    int faces = 0;  ///< of all of them
};

struct OpenedGarment {
    /// All vertices in their order, and the faces of the cloth in theirs. The vertices of each piece of `left_out` lie
    /// in one place, that of the vertex of the cloth nearest to its middle: they go where the cloth goes.
    GarmentMesh garment;
    int closed_ends = 0;  ///< caps and lids
    LeftOut left_out = {};
};

/// Leaves out the caps: flat discs with steep cloth all around them, and flat fans around a vertex; and lids and solids
/// that hide the inside of the garment. A surface that is closed everywhere keeps its caps unless they are three or
/// more: a sphere, a block or a pillow is no garment.
/// Any size: lengths are judged by the garment's own. Cost O(n log n).
GARMENTFIT_API OpenedGarment open_ends(const GarmentMesh& garment);

}  // namespace garmentfit
