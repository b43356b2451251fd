// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// For each vertex the bones that may be its heat source. Keeps the weights of a limb off another limb that touches it.
using VisibleBones = std::vector<std::array<bool, bone_count>>;

/// Heat equilibrium weights [baran_2007_pinocchio], equation (1): n x 17, rows sum to 1. One sparse Cholesky
/// factorisation.
/// @throws SolverFailure when the factorisation fails.
/// @param closed  a closed surface
Eigen::MatrixXd heat_weights(const TriangleMesh& closed, const Skeleton& skeleton, const VisibleBones& visible);

}  // namespace garmentfit
