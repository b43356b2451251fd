// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Hollows of a solid in which a tube of cloth ends, and flat ends. Clothes that are modelled as solids, by hand or from
// pictures, show their cuffs, hems and necks as pits with a floor.

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// A hollow, up to its rim.
struct Hollow {
    std::vector<int> floor;  ///< faces that close the tube
    std::vector<int> walls;  ///< the other ones: cloth, whose other side is close behind
};

/// Hollows in which tubes of cloth end.
///
/// A place lies in a hollow if all rays across the mean direction of the surface round it, from a little above it, meet
/// the surface: between legs and under arms some go out. The hollow goes up to where such rays go out, or the surface
/// turns away from its axis. It is the end of a tube if the solid goes on behind its floor for about as far as it is
/// wide, for behind a fold of the front there is only the back; and if it is round, and fills the solid.
///
/// @param solid    closed, in even triangles that are small against a cuff, such as a wrap, oriented outwards
/// @param outside  faces of it in which hollows are looked for
/// Cost: up to 24 rays from each of three heights for each face, most often a few; 24 more for those near a floor.
std::vector<Hollow> find_hollows(const TriangleMesh& solid, const std::vector<int>& outside);

/// The same, and where there are three or more with them, flat ends without a hollow: connected faces that look along
/// one axis, near to one plane, from whose outline the surface goes back at once, and behind which a tube goes on. Beside
/// all ends of a garment, what is far narrower than the solid behind it is none. The cost is about the same.
std::vector<Hollow> find_solid_ends(const TriangleMesh& solid, const std::vector<int>& outside);

}  // namespace garmentfit
