// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// The shoulders over which cloth lies, as lclavicle and rclavicle: those where it passes over the collarbone, no
/// higher above it than the collarbone is long. Above is away from the trunk, at right angles to the collarbone.
/// @param joints     in the pose in which the cloth is worn
/// @param positions  of the cloth, m. Cost O(n).
GARMENTFIT_API std::vector<Bone> shoulders_under_cloth(const Skeleton& joints, const Positions& positions,
                                                       const Triangles& triangles);

}  // namespace garmentfit
