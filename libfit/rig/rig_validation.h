// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/skeleton.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// Refuses compact shapes such as blocks and balls, before expensive work. O(n). @throws InvalidInput with the number.
void check_shape(const TriangleMesh& closed);

/// Checks that a skeleton is human: bones inside the body, equal lengths left and right, usual proportions.
/// O(samples * triangles). @throws InvalidInput that names the failed test, with numbers.
void check_rig(const TriangleMesh& closed, const Skeleton& skeleton);

}  // namespace garmentfit
