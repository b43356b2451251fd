// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "garmentfit/mesh.h"

namespace garmentfit {

/// A garment as it is read without a wrap.
struct PlainReading {
    GarmentMesh opened;  ///< as given without closed ends
    TriangleMesh cloth;  ///< without gaps between panels, each patch oriented outwards
    TriangleMesh outer;  ///< without the inner sheets of thick cloth
    bool is_sealed = false;  ///< the outer sheet has neither openings nor tunnels
    bool serves = false;  ///< it is no garment in parts, and has openings or is a sealed one
};

/// derived: a body enters through one and comes out at another
inline constexpr std::size_t k_fewest_openings = 2;

/// @param opened  from open_ends. O(n log n)
PlainReading read_plainly(GarmentMesh opened);

}  // namespace garmentfit
