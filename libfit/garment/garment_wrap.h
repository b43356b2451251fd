// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// An alpha wrap round a garment [portaneri_2022_alpha_wrap], whatever its pieces are, and the two sheets of it that a
// body passes through.

#include <optional>
#include <vector>

#include "cloth_patches.h"
#include "plain_reading.h"

namespace garmentfit {

/// Oriented outwards. It spans the gaps between parts, but not the openings for a body.
struct GarmentWrap {
    TriangleMesh surface;
    std::vector<Patch> patches;
};

/// Seconds; those made last are kept.
GarmentWrap wrap_parts(const PlainReading& plain);
/// The same with each border closed: what cloth with an opening encloses is solid in it. Not kept.
GarmentWrap wrap_closed(const PlainReading& plain);

/// The one with the largest area.
const Patch& largest_patch(const GarmentWrap& wrap);

/// Both sheets of a wrap that a body can pass through.
struct WrapSheets {
    TriangleMesh outer;  ///< bridges what lies near to each other: sleeves and the trunk, legs
    TriangleMesh inner;  ///< facing outwards, in one piece
    std::size_t outer_openings = 0, inner_openings = 0;

    /// Whether the inner one is open where the body comes out: holes beside bridges make no sleeve or leg of the outer
    /// one.
    bool inner_goes_round() const;
    /// In deep pleats the sheets change places, and both are ragged.
    bool inner_is_ragged() const;
};

/// None where the wrap closes the openings.
std::optional<WrapSheets> sheets_of(const GarmentWrap& wrap);

}  // namespace garmentfit
