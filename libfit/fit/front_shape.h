// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the cloth between its openings tells about where a garment faces: bodies are not alike in front and behind.

#include <vector>

#include "clearance_field.h"
#include "garmentfit/skeleton.h"
#include "type_guess.h"

namespace garmentfit {

/// Offsets along a direction that may be the front, in tenths of the garment's width at its top, at most 3, and at
/// most 0.7 of seat, lap and rise. Each of them changes its sign with the direction.
struct FrontShape {
    double torso = 0;  ///< of the middle of the cloth against its sides, mean over six heights: backs are rounder
    double waist = 0;  ///< the same at the top: trousers stand further out over the seat
    double hems = 0;  ///< of the lowest openings against the highest
    double cuffs = 0;  ///< of the sleeves' ends against the highest opening: elbows bend forwards
    double seat = 0;  ///< of the middle between front and back, a third of a width below the top, against the top
    double lap = 0;  ///< breadth of the front half against the rear one, at the lap: thighs are in front of the seat
    double rise = 0;  ///< of the highest opening behind against in front, upwards: waists are higher behind
    double bow = 0;  ///< of the top and the bottom against the heights between them: backs bend, shirts hang from them
    double bare
        = 0;  ///< tenths of the cloth in the middle by which more is behind, at most 0.6: necklines are deep in front
};

/// Of those with more than this girth, m; null if there is none.
const Opening* highest_opening(const std::vector<Opening>& openings, double least_girth);

/// @param front  unit, horizontal. Cost O(n log n) of the cloth's patches.
FrontShape front_shape(const std::vector<ClothPatch>& cloth, const std::vector<Opening>& openings,
                       const GarmentCues& cues, const Vec3& front);

/// Of the middle between front and back at the chest of a body against that at its seat, along the front, in tenths of the
/// distance between its shoulders, at most 3: busts are in front, seats behind. 0 where there is no cloth at one of them.
double profile_of(const std::vector<ClothPatch>& cloth, const Skeleton& worn, const Vec3& front);

}  // namespace garmentfit
