// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The skeleton as the joints of a file, named and cut as one program wants them.

#include <array>
#include <string>
#include <vector>

#include "garmentfit/skinned_gltf.h"

namespace garmentfit {

struct FileJoint {
    std::string name;
    int parent;  ///< row, before this one; -1: none
    Vec3 place;  ///< m, in the rest pose
    int bone = -1;  ///< whose rotation it takes: that of the body as a whole where it is none
};

struct JointTree {
    std::vector<FileJoint> joints;  ///< parents before children, the root first
    std::array<int, bone_count> joint_of {};  ///< of each bone the row that moves its skin
    std::array<int, extremity_count> extremities { -1, -1, -1, -1, -1 };  ///< rows of hands and feet that move skin

    int row_named(const std::string& name) const;  ///< -1: none
};

JointTree joint_tree(const Skeleton& skeleton, BoneNames names);

/// Joints of a file that move a vertex, the strongest first: n x 4, or n x 8 for what has more than four bones or joints
/// a vertex. Unused slots have weight 0.
struct FileWeights {
    Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> joints;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> weights;
};

/// Bones without a joint of their own go to the one before them. Where the tree has hands and feet that move, skin
/// beyond wrist and ankle goes to these.
/// @param weights  a column for each bone
FileWeights file_weights(const JointTree& tree, const Skeleton& skeleton, const Positions& positions,
                         const JointWeights& weights);

/// Of weights over other joints, as rows of `joints`, columns of `weights`; what others have is left out.
FileWeights file_weights(const JointWeights& weights, const std::vector<int>& joints);

}  // namespace garmentfit
