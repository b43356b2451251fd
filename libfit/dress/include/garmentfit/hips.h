// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/skeleton.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// How far below the hip joints the legs part, m; 0 where the surface does not show it, as in a gown.
/// @param closed  surface of the body in the pose of the joints
GARMENTFIT_API double crotch_depth(const Skeleton& joints, const TriangleMesh& closed);

/// The hips that cloth reaches, as lhipjoint and rhipjoint: beside the hip joint it lies about as high as the joint, or
/// higher. Trousers and skirts that reach none hang on the thighs.
/// @param joints     in the pose in which the cloth is worn
/// @param crotch     depth, m: a body in wide trousers wears others lower
/// @param positions  of the cloth, m. Cost O(n).
GARMENTFIT_API std::vector<Bone> hips_under_cloth(const Skeleton& joints, double crotch, const Positions& positions,
                                                  const Triangles& triangles);

}  // namespace garmentfit
