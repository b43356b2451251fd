// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Ends of a garment that are closed by cloth modelled all the way round: the floors of its cuffs, ankles, hem and neck.

#include <vector>

#include "garmentfit/mesh.h"

namespace garmentfit {

struct HollowEnds {
    std::vector<std::vector<int>> faces;  ///< of each end
    TriangleMesh outside;  ///< of a solid, without its hollows up to their rims; no faces for others
};

void transform(HollowEnds& ends, const Eigen::Matrix4d& motion);

/// Those of a garment through which no body passes: it has no opening or one, also where its parts are
/// wrapped. Two ends are opened at least, those that are open included. And both sleeves of one with two openings.
/// @param opened  without caps. Cost: O(n log n) for open garments, seconds for a wrap of those in parts or closed;
/// what was found last is kept.
HollowEnds find_hollow_ends(const GarmentMesh& opened);

/// Both sleeves of a garment that is open at hem and neck and nowhere else; none for others. Cost: as above, without a
/// wrap.
HollowEnds find_closed_sleeves(const GarmentMesh& garment);

/// The neck of a top that is open at the hem and both sleeves and nowhere else; none for others. Cost: as above, without
/// a wrap.
HollowEnds find_closed_neck(const GarmentMesh& garment);

}  // namespace garmentfit
