// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The neck of a top that is modelled as a solid and filled there.

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// Where the trunk of a top lies between its sleeves and above its hem.
struct Trunk {
    Vec3 hem = Vec3::Zero(), shoulders = Vec3::Zero();  ///< m: middles of the hem, and of both sleeves' ends
    Vec3 up = Vec3::UnitY(), across = Vec3::UnitX();  ///< unit
    double width = 0;  ///< m, from sleeve to sleeve
    double hem_area = 0;  ///< m^2, of a disc that closes the hem
};

/// The cloth that closes a neck: at the top of the trunk, or below a hood, a smooth round patch inside a crease, a collar
/// or a groove. No body passes there, and no pit or flat end shows where one should. Patches are grown from places in the
/// middle, over faces less and less alike; where one hardly grows from one limit to the next, a crease holds it
/// (maximally stable regions [matas_2004_mser], of directions in place of grey values). Of these the largest round one
/// is the neck; empty without any, as of shoulders without a collar.
/// Cost: some hundred walks over the top of the cloth.
/// @param cloth  oriented outwards
std::vector<int> find_shut_neck(const TriangleMesh& cloth, const Trunk& trunk);

}  // namespace garmentfit
