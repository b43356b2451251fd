// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Garments that hang by straps, such as camisoles. Above their bodice the cloth encloses next to nothing, and a body
// would stand in the bodice with its arms beside the straps.

#include <vector>

#include "garment_openings.h"

namespace garmentfit {

/// What closes the armholes and the neck, facing outwards, of a garment of which straps are nearly all the cloth
/// between them. The neck's lid is a tent as high as the straps, for the shoulders reach up to there. Nothing of other
/// garments. O(n).
/// @param openings  of the garment
TriangleMesh lids_between_straps(const TriangleMesh& outward, const std::vector<Opening>& openings);

}  // namespace garmentfit
