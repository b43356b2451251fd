// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/rig_arrays.h"

#include <cmath>
#include <string>

#include "garmentfit/error.h"

namespace garmentfit {
namespace {

constexpr int k_tips_from = 1 + int(bone_count);  // derived: after the root and the bones' tails

void require_shape(const Rows& rows, int count, int columns, const char* what)
{
    if (rows.rows() != count || rows.cols() != columns)
        throw InvalidInput(ErrorCode::count_mismatch,
                           std::string(what) + " is an array of " + std::to_string(rows.rows()) + " x "
                               + std::to_string(rows.cols()) + " instead of " + std::to_string(count) + " x "
                               + std::to_string(columns) + "; give what a filter made");
    if (!rows.allFinite())
        throw InvalidInput(ErrorCode::not_finite,
                           std::string(what) + " has numbers that are not finite; give what a filter made");
}

Eigen::RowVector4d row_of(const Eigen::Quaterniond& q) { return { q.w(), q.x(), q.y(), q.z() }; }

/// Not normalised: a pose that is written and read keeps its bits.
Eigen::Quaterniond rotation_of(const Eigen::RowVector4d& row)
{
    constexpr double k_rounding = 1e-6;  // unit: text files keep six digits at least
    if (std::abs(row.norm() - 1) > k_rounding)
        throw InvalidInput(ErrorCode::bad_rig,
                           "a rotation of the pose is not a unit quaternion; give what a filter made");
    return { row[0], row[1], row[2], row[3] };
}

}  // namespace

Rows rows_of(const Skeleton& skeleton)
{
    Rows joints(k_joint_rows, 3);
    joints.row(0) = skeleton.root;
    for (int b = 0; b < bone_count; ++b)
        joints.row(1 + b) = skeleton.tails[b];
    for (int e = 0; e < extremity_count; ++e)
        joints.row(k_tips_from + e) = skeleton.tips[e];
    return joints;
}

Rows row_of(const Pose& pose)
{
    Rows row(1, k_pose_columns);
    row.leftCols<3>() = pose.root_translation.transpose();
    row.middleCols<4>(3) = row_of(pose.root_rotation);
    for (int b = 0; b < bone_count; ++b)
        row.middleCols<4>(7 + 4 * b) = row_of(pose.rotations[b]);
    return row;
}

Skeleton skeleton_of(const Rows& joints)
{
    require_shape(joints, k_joint_rows, 3, "the skeleton");
    Skeleton skeleton;
    skeleton.root = joints.row(0);
    for (int b = 0; b < bone_count; ++b)
        skeleton.tails[b] = joints.row(1 + b);
    for (int e = 0; e < extremity_count; ++e)
        skeleton.tips[e] = joints.row(k_tips_from + e);
    return skeleton;
}

Pose pose_of(const Rows& row)
{
    require_shape(row, 1, k_pose_columns, "the pose");
    Pose pose;
    pose.root_translation = row.leftCols<3>().transpose();
    pose.root_rotation = rotation_of(row.middleCols<4>(3));
    for (int b = 0; b < bone_count; ++b)
        pose.rotations[b] = rotation_of(row.middleCols<4>(7 + 4 * b));
    return pose;
}

SkinWeights weights_of(const Rows& bones, const Rows& weights)
{
    if (bones.cols() != 4 || weights.cols() != 4 || bones.rows() != weights.rows())
        throw InvalidInput(ErrorCode::count_mismatch,
                           "the rig has " + std::to_string(bones.rows()) + " x " + std::to_string(bones.cols())
                               + " bones for " + std::to_string(weights.rows()) + " x " + std::to_string(weights.cols())
                               + " weights; give four of each for each vertex");
    for (Eigen::Index v = 0; v < bones.rows(); ++v)
        if (!((bones.row(v).array() >= 0).all() && (bones.row(v).array() < int(bone_count)).all()
              && (weights.row(v).array() >= 0).all() && (weights.row(v).array() <= 1).all()))
            throw InvalidInput(ErrorCode::bad_rig,
                               "the rig's vertex " + std::to_string(v)
                                   + " has a bone or a weight out of range; rig the body again");
    return { bones.cast<int>(), weights };
}

}  // namespace garmentfit
