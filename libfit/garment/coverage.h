// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a garment may cover. The openings allow several answers: two openings in a tube are a skirt, a tube top or a
// strapless dress. The fit decides (libfit/fit/evidence.h).

#include <array>
#include <string_view>
#include <vector>

#include "type_guess.h"

namespace garmentfit {

enum class CoverageKind { top, legs, skirt, dress, jumpsuit };
inline constexpr std::array<std::string_view, 5> k_coverage_kind_names { "top", "legs", "skirt", "dress", "jumpsuit" };

/// What garments of a type cover. @pre neither `automatic` nor coarse
CoverageKind coverage_kind_of(GarmentType type);

struct Coverage {
    CoverageKind kind;
    GarmentType type;  ///< what a garment with these openings is called if it covers these bones
    std::vector<Bone> bones;
    bool is_guessed = false;  ///< by the shape of the openings (guess_type), or given
    double name_probability = 1;  ///< that the type is right, given the kind; tops with sleeves count as one
};

/// What a garment that was found to be of a type is called if it covers these bones in the end: trousers that leave
/// both shins uncovered are shorts.
GarmentType type_when_worn(GarmentType found, const std::vector<Bone>& covered);

/// One for each kind, the guessed one first, and last a top with bare shoulders, where none has an opening for arms; a
/// given type leaves only its own, a coarse word those of its group.
/// @throws InvalidInput when there are too few openings for a body, and no type is given.
std::vector<Coverage> possible_coverages(GarmentType given, const std::vector<Opening>& openings);

/// The given type, or else the guessed one, of the group of a coarse word. @throws InvalidInput when it cannot be
/// guessed.
GarmentType resolve_type(GarmentType given, const std::vector<Opening>& openings);

}  // namespace garmentfit
