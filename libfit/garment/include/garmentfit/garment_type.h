// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The type of a garment, and which bones a type covers.

#include <string_view>
#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

enum class GarmentType {
    automatic,
    tshirt,
    longsleeve,
    blouse,
    hoodie,
    jacket,
    coat,
    vest,
    trousers,
    shorts,
    skirt,
    dress,
    jumpsuit,
    suit,
    tanktop,
    camisole,
    strapless,
    halter,
    leggings,
    hotpants,
    poncho,
    cape,
    robe,
    overalls,
    // Coarse words: they restrict what is searched for, and are never found.
    top,
    bottom,
    whole
};

/// All names in the order of GarmentType: "auto", "tshirt", ...
GARMENTFIT_API const std::vector<std::string_view>& garment_type_names();
/// @throws InvalidInput listing the known names.
GARMENTFIT_API GarmentType garment_type_of(std::string_view name);
GARMENTFIT_API std::string_view name_of(GarmentType type);

/// Whether it names a group of types: top, bottom, whole.
GARMENTFIT_API bool is_coarse(GarmentType type);

struct TypeGuess {
    GarmentType type = GarmentType::automatic;
    double confidence = 0;  ///< of the evidence: 0 = low confidence, 1 = far from every limit. Not a probability.
};

/// Guesses the type from openings and the tubes that lead to them. Returns `automatic` with confidence 0 when a body
/// does not fit through the openings. Cost O(n log n).
GARMENTFIT_API TypeGuess guess_garment_type(const GarmentMesh& garment);

/// The bones that a type covers; none for `automatic` and coarse words.
GARMENTFIT_API std::vector<Bone> bones_covered_by(GarmentType type);

}  // namespace garmentfit
