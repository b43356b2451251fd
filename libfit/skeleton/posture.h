// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A pose in the coordinates of the fit: position of the root, rotation of the body, direction of each bone.

#include <array>

#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Directions determine the rotations: each bone rotates from its rest direction by the shortest arc, relative to its
/// parent. This avoids twist of the skin.
struct Posture {
    Vec3 root = Vec3::Zero();  // m, world
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  // of the whole body: world from rest axes
    std::array<Vec3, bone_count> directions {};  // unit, world
};

/// Joints and rotations of a posture.
struct PlacedBones {
    Skeleton joints;  // world
    std::array<Vec3, bone_count> directions {};  // equal to the posture's
    std::array<Eigen::Quaterniond, bone_count> turns;  // of each bone: world from rest axes
    Eigen::Quaterniond root_turn;

    const Eigen::Quaterniond& parent_turn(int bone) const
    {
        return parent_of(bone) < 0 ? root_turn : turns[parent_of(bone)];
    }
};

/// The rotation by the smallest angle that takes one unit vector to another.
Eigen::Quaterniond shortest_arc(const Vec3& from, const Vec3& to);

double angle_between(const Vec3& a, const Vec3& b);  ///< rad, of unit vectors

/// The rotation of a bone that points along `direction`; its parent is rotated by `parent_turn`.
Eigen::Quaterniond bone_turn(const Skeleton& rest, int bone, const Eigen::Quaterniond& parent_turn,
                             const Vec3& direction);

PlacedBones place_bones(const Skeleton& rest, const Posture& posture);
/// Returns the same bits, faster: reuses rotations of `near`, a posture that differs in a few bones only.
PlacedBones place_bones(const Skeleton& rest, const Posture& posture, const PlacedBones& near);
Pose pose_of(const Skeleton& rest, const Posture& posture);
Posture posture_of(const Skeleton& rest, const Pose& pose);

/// Rotates the whole body about the origin.
Posture rotate(Posture posture, const Eigen::Quaterniond& turn);

}  // namespace garmentfit
