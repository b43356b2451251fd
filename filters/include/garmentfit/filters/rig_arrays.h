// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Skeletons and poses as rows of numbers, metres, +y up: how hosts pass them from filter to filter and into files.

#include "garmentfit/skeleton.h"

namespace garmentfit {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// derived: the root, the bones' tails, the tips.
constexpr int k_joint_rows = 1 + int(bone_count) + int(extremity_count);
/// derived: root's translation and rotation, rotations of the bones; w, x, y, z.
constexpr int k_pose_columns = 3 + 4 + 4 * int(bone_count);

/// k_joint_rows x 3.
Rows rows_of(const Skeleton& skeleton);
/// 1 x k_pose_columns.
Rows row_of(const Pose& pose);

/// @throws InvalidInput where rows or columns are too few or too many, or numbers are not finite.
Skeleton skeleton_of(const Rows& joints);
/// @throws InvalidInput likewise, and where a rotation is not a unit quaternion.
Pose pose_of(const Rows& row);
/// @throws InvalidInput where shapes differ, or a bone or weight is out of range, naming the vertex.
SkinWeights weights_of(const Rows& bones, const Rows& weights);

}  // namespace garmentfit
