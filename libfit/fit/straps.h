// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Garments that hang by straps, such as camisoles. Above their bodice the cloth encloses next to nothing, and a body
// would stand in the bodice with its arms beside the straps.

#include <vector>

#include "garment_openings.h"

namespace garmentfit {

/// The two armholes and the neck, in this order, of a garment of which straps are nearly all the cloth between them:
/// the middle between the armholes is not inside by the cloth. None of other garments. O(n).
std::vector<Opening> openings_between_straps(const TriangleMesh& outward, const std::vector<Opening>& openings);

/// What closes these openings, facing outwards. The neck's lid is a tent as high as the straps, for the shoulders reach
/// up to there.
TriangleMesh lids_between_straps(const std::vector<Opening>& shoulders);

}  // namespace garmentfit
