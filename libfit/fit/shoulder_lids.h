// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Garments without sleeves. Between their armholes and the neck there may be little cloth, down to straps, which encloses
// next to nothing: a body would stand in the bodice with its arms beside the straps.

#include <vector>

#include "garment_openings.h"

namespace garmentfit {

/// What closes the armholes and the neck, facing outwards; of a halter the neck and the one opening for arms and back. The
/// neck's lid is a tent as high as the cloth beside it, for the shoulders reach up to there, and that of a back is as deep
/// as the garment. Nothing of garments with sleeves, or that are open in front. O(n).
/// @param openings  of the garment
TriangleMesh lids_at_shoulders(const TriangleMesh& outward, const std::vector<Opening>& openings);

}  // namespace garmentfit
