// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/skeleton.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// Refuses blocks and balls before any work is done on them. O(n). @throws InvalidInput with the number.
void check_shape(const TriangleMesh& closed);

/// Lets only a human's skeleton pass: joints and bones inside the body, limbs of equal lengths left and right, usual
/// proportions. O(samples * triangles). @throws InvalidInput naming the gate, with numbers.
void check_rig(const TriangleMesh& closed, const Skeleton& skeleton);

}  // namespace garmentfit
