// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The skeleton of 17 bones, its poses, and the skin weights.
//
// Skeleton  the CMU motion-capture (ASF) skeleton without hands, feet and head, as in [wu_2018_garment_fitting].
// Skinning  dual quaternions [kavan_2008_dual_quaternions].
// Spaces    rest = the rest pose of the input body: the pose in which it was given. A Pose rotates bones away from it,
//           so the identity Pose is the rest pose. world = after a Pose was applied.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// Bones in the order of every table in libfit. Parents come before children.
enum Bone : int {
    lhipjoint,
    lfemur,
    ltibia,
    rhipjoint,
    rfemur,
    rtibia,
    lowerback,
    upperback,
    thorax,
    lowerneck,
    upperneck,
    lclavicle,
    lhumerus,
    lradius,
    rclavicle,
    rhumerus,
    rradius,
    bone_count
};

/// "lhipjoint", ... in the order of Bone.
GARMENTFIT_API std::string_view bone_name(int bone);
/// -1 when there is no bone of that name.
GARMENTFIT_API int bone_of(std::string_view name);
/// The bone at whose tail this one begins; -1 for the three bones that begin at the root.
GARMENTFIT_API int parent_of(int bone);
/// lfemur <-> rfemur ...; bones of the spine are their own mirror.
GARMENTFIT_API int mirror_of(int bone);
/// Of the humerus and radius of either side.
constexpr bool is_arm(int bone) { return bone == lhumerus || bone == lradius || bone == rhumerus || bone == rradius; }
/// Of the femur and tibia of either side.
constexpr bool is_leg(int bone) { return bone == lfemur || bone == ltibia || bone == rfemur || bone == rtibia; }

/// Ends of the body beyond the last joints. They are not bones, because they never bend.
enum Extremity : int { head_top, lhand_tip, rhand_tip, lfoot_tip, rfoot_tip, extremity_count };

/// The bone at whose tail an extremity begins: upperneck, lradius, rradius, ltibia, rtibia.
GARMENTFIT_API int bone_before(Extremity extremity);

/// Joint positions of one body, in one pose. The head of a bone is the tail of its parent (or the root).
struct Skeleton {
    Vec3 root = Vec3::Zero();
    std::array<Vec3, bone_count> tails {};
    std::array<Vec3, extremity_count> tips {};

    GARMENTFIT_API const Vec3& head(int bone) const;
    const Vec3& tail(int bone) const { return tails[bone]; }
    /// Unit; any for a bone without length, as a file may have.
    Vec3 direction(int bone) const { return length(bone) > 0 ? (tail(bone) - head(bone)).normalized() : Vec3::UnitY(); }
    double length(int bone) const { return (tail(bone) - head(bone)).norm(); }
};

/// Rotations of the bones away from the rest pose.
struct Pose {
    Vec3 root_translation = Vec3::Zero();  ///< m, added to the root
    Eigen::Quaterniond root_rotation = Eigen::Quaterniond::Identity();  ///< of the whole body, about the root
    /// Of each bone about its head, in the axes of the rest pose: world rotation = parent's world rotation * this.
    std::array<Eigen::Quaterniond, bone_count> rotations;
    GARMENTFIT_API Pose();  ///< the rest pose
};

/// Whether two poses are equal bit for bit.
GARMENTFIT_API bool is_same(const Pose& a, const Pose& b);

/// World-from-rest rigid transform of each bone.
using BoneTransforms = std::array<Eigen::Isometry3d, bone_count>;

/// Transforms of the parents are included. O(1).
GARMENTFIT_API BoneTransforms bone_transforms(const Skeleton& rest, const Pose& pose);

/// The joints in a pose, world space.
GARMENTFIT_API Skeleton pose_skeleton(const Skeleton& rest, const Pose& pose);

/// Interpolates rotations by spherical linear interpolation and the root linearly; t in [0, 1].
GARMENTFIT_API Pose slerp(const Pose& from, const Pose& to, double t);

/// At most four bones a vertex; weights are non-negative and sum to 1, unused slots carry weight 0.
struct SkinWeights {
    Eigen::Matrix<int, Eigen::Dynamic, 4, Eigen::RowMajor> bones;
    Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> weights;
};

/// Poses vertices by dual quaternion blending; n x 3 in, n x 3 out. O(n).
/// Returns the same bits when every transform is exactly the identity.
GARMENTFIT_API Positions skin(const Positions& rest_positions, const SkinWeights& weights,
                              const BoneTransforms& transforms);

/// The result of rigging a body.
struct Rig {
    Skeleton skeleton;  ///< in the rest pose
    SkinWeights weights;  ///< of all vertices of the user's mesh
    Vec3 up = Vec3::UnitY();  ///< of the trunk, unit: from pelvis to neck
    Vec3 front = Vec3::UnitZ();  ///< of the trunk, unit: where the chest faces
    /// Evidence for left and right: 0 = low confidence, 1 = all cues agree. Not a probability.
    double side_confidence = 0;
    /// That the body is a human one: 1 where its proportions are a human's, near 0 for cartoons.
    double human_probability = 1;
    std::string not_human {};  ///< what is furthest from human, with numbers; empty where nothing is
    /// m, radius of the limb around each bone, from bone_radii; 0 = unknown, then estimated from the leg's length.
    std::array<double, bone_count> radii {};
};

/// Distance of the skin from each bone, m: the lower quartile over the vertices whose largest weight is on the bone, so
/// that a flat part counts with its thin side; 0 for a bone without vertices. O(n log n).
GARMENTFIT_API std::array<double, bone_count> bone_radii(const Skeleton& rest, const SkinWeights& weights,
                                                         const Positions& rest_positions);

}  // namespace garmentfit
