// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "garmentfit/garment_type.h"
#include "garment_openings.h"

namespace garmentfit {

/// As guess_garment_type, from its openings.
TypeGuess guess_type(const std::vector<Opening>& openings);
/// The given type, or for `automatic` the one that is found. @throws InvalidInput when there is none.
TypeGuess resolve_type(GarmentType given, const std::vector<Opening>& openings);

/// How clearly the openings say that the garment hangs upright: 0 (not at all) to 1.
double uprightness(const std::vector<Opening>& openings);

/// The bones that a garment of this type covers; where a type may come with any sleeves, its openings tell.
std::vector<Bone> bones_covered_by(GarmentType type, const std::vector<Opening>& openings);

/// What a garment's openings say about how it is worn.
struct GarmentCues {
    Vec3 across = Vec3::Zero();  // horizontal, from sleeve to sleeve or leg to leg of the tallest piece that has two
    Vec3 front = Vec3::Zero();  // horizontal; where openings face, longer the more of them agree
    std::vector<Vec3> hems;  // middles of two legs', or none
    std::vector<Vec3> cuffs;  // middles of two, of the longest sleeves, or none: where hands come out
};
GarmentCues cues_of(const std::vector<Opening>& openings);

}  // namespace garmentfit
