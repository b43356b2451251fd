// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// The hips that cloth reaches, as lhipjoint and rhipjoint: beside the hip joint it lies about as high as the joint, or
/// higher. Trousers and skirts that reach none hang on the thighs.
/// @param joints     in the pose in which the cloth is worn
/// @param positions  of the cloth, m. Cost O(n).
GARMENTFIT_API std::vector<Bone> hips_under_cloth(const Skeleton& joints, const Positions& positions,
                                                  const Triangles& triangles);

}  // namespace garmentfit
