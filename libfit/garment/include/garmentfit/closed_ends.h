// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Garments whose cuffs, ankles, neck or hem are closed by flat caps.

#include "garmentfit/export.h"
#include "garmentfit/mesh.h"

namespace garmentfit {

struct OpenedGarment {
    GarmentMesh garment;  ///< all vertices, and the faces that belong to no cap, in their order
    int closed_ends = 0;  ///< caps that were left out
};

/// Leaves out the caps: flat discs with steep cloth all around them, and flat fans around a vertex. A surface that is
/// closed everywhere keeps its caps unless they are three or more: a sphere, a block or a pillow is no garment.
/// Any size: lengths are judged by the garment's own. Cost O(n log n).
GARMENTFIT_API OpenedGarment open_ends(const GarmentMesh& garment);

}  // namespace garmentfit
