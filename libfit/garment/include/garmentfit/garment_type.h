// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a garment is, and which bones it covers.

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
    suit
};

/// "auto", "tshirt", ... all of them, in the order of GarmentType.
GARMENTFIT_API const std::vector<std::string_view>& garment_type_names();
/// @throws InvalidInput listing the known names.
GARMENTFIT_API GarmentType garment_type_of(std::string_view name);
GARMENTFIT_API std::string_view name_of(GarmentType type);

struct TypeGuess {
    GarmentType type = GarmentType::automatic;
    double margin = 0;  ///< 0 (a toss-up) to 1 (all evidence agrees)
};

/// Reads the type off the garment's openings and tubes; `automatic` with margin 0 when it has none that a body fits through.
/// Cost O(n log n).
GARMENTFIT_API TypeGuess guess_garment_type(const GarmentMesh& garment);

/// The bones that a type covers.
GARMENTFIT_API std::vector<Bone> bones_covered_by(GarmentType type);

}  // namespace garmentfit
