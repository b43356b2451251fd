// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// Which bones each vertex may hang on. Keeps a limb's weights off another limb that it touches.
using VisibleBones = std::vector<std::array<bool, bone_count>>;

/// Heat equilibrium weights [baran_2007_pinocchio], equation (1): n x 17, rows sum to 1. One sparse Cholesky factorisation.
/// @param closed  a closed surface
Eigen::MatrixXd heat_weights(const TriangleMesh& closed, const Skeleton& skeleton, const VisibleBones& visible);

}  // namespace garmentfit
