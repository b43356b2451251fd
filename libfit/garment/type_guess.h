// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "garment_openings.h"
#include "garmentfit/garment_size.h"
#include "garmentfit/garment_type.h"

namespace garmentfit {

/// As guess_garment_type, from the openings.
TypeGuess guess_type(const std::vector<Opening>& openings);

/// Evidence of the openings that the garment is upright: 0 (none) to 1.
double uprightness(const std::vector<Opening>& openings);

/// The bones that a garment covers. Where the type does not determine the sleeves, the openings do; sleeves that are
/// clearly short leave the forearms bare, whatever the type. Dresses and jumpsuits without openings for arms have no
/// straps, and leave the shoulders bare.
std::vector<Bone> bones_covered_by(GarmentType type, const std::vector<Opening>& openings);

/// A strap round the neck holds it. The arms and the back have one opening, which is behind.
struct Halter {
    Opening neck, back;
};
std::optional<Halter> find_halter(const std::vector<Opening>& openings);

/// Evidence of the openings on how the garment is worn.
struct GarmentCues {
    Vec3 across = Vec3::Zero();  // horizontal: from sleeve to sleeve or leg to leg of the tallest piece that has two
    Vec3 front = Vec3::Zero();  // horizontal: sum of the normals of openings, longer the better they agree;
        // of a halter away from its back
    std::optional<Vec3> front_given;  // horizontal: where the user says that the front is
    std::vector<Vec3> hems;  // centroids of the two leg openings, or empty
    bool has_arms = false;  // two openings are sleeves or armholes
    bool is_halter = false;
    bool is_strapless = false;  // each piece has a top and a hem, or legs, and no other opening
    std::vector<Vec3> cuffs;  // centroids of the two longest sleeves' openings, or empty
    std::vector<Vec3> armholes;  // centroids of the two armholes of openings_at_shoulders, or empty
};
/// @param front  where the user says that the front of the held garment is: not vertical
GarmentCues cues_of(const std::vector<Opening>& openings, const std::optional<Vec3>& front = {});

/// The openings for arms and neck of the tallest piece that has armholes, and one for the trunk: straps may be all that
/// parts them. None where it has sleeves, or is open in front. The armholes come first.
std::vector<Opening> openings_at_shoulders(const std::vector<Opening>& openings);

/// Measures of the tallest piece of a garment, m; 0 where it has no such part.
struct GarmentMeasures {
    int piece = -1;  ///< Opening::piece; less than 0 where no piece was measured
    double shoulders = 0;  ///< from sleeve to sleeve, where they meet the trunk, or from armhole to armhole
    double sleeve = 0;  ///< girth of the wider sleeve; not of an armhole
    double sleeve_length = 0;  ///< of the shorter sleeve
    double neck = 0;  ///< girth of the highest opening above sleeves
    double trunk = 0;  ///< girth, the narrowest of the tube that ends at the hem; or of the waist, above legs
    double leg = 0;  ///< girth of the wider leg
    double inseam = 0;  ///< length of the legs
};
GarmentMeasures measures_of(const std::vector<Opening>& openings);

/// As garmentfit/garment_size.h, by its parts alone.
std::vector<WearerHeight> wearer_heights(const GarmentMeasures& measures);

}  // namespace garmentfit
