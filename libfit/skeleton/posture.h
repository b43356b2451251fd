// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A pose as the fit searches it: where the root is, how the body is turned, and where each bone points.

#include <array>

#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Directions say all: every bone turns from its own direction by the shortest arc, relative to its parent, so that the
/// skin is never wrung.
struct Posture {
    Vec3 root = Vec3::Zero();                                           // m, world
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();           // of the whole body: world from own axes
    std::array<Vec3, bone_count> directions {};                         // unit, world
};

/// A posture worked out.
struct PlacedBones {
    Skeleton joints;                                      // world
    std::array<Vec3, bone_count> directions {};           // as the posture's
    std::array<Eigen::Quaterniond, bone_count> turns;     // world from own axes, of each bone
    Eigen::Quaterniond root_turn;

    const Eigen::Quaterniond& parent_turn(int bone) const
    {
        return parent_of(bone) < 0 ? root_turn : turns[parent_of(bone)];
    }
};

/// The shortest rotation that takes one unit vector to another.
Eigen::Quaterniond shortest_arc(const Vec3& from, const Vec3& to);

double angle_between(const Vec3& a, const Vec3& b);  ///< rad, of unit vectors

/// The turn of a bone that points along `direction` and hangs on a bone turned by `parent_turn`.
Eigen::Quaterniond bone_turn(const Skeleton& own, int bone, const Eigen::Quaterniond& parent_turn, const Vec3& direction);

PlacedBones placed(const Skeleton& own, const Posture& posture);
/// The same to the last bit, given what is known of a posture that may differ in a few bones only.
PlacedBones placed(const Skeleton& own, const Posture& posture, const PlacedBones& near);
Pose pose_of(const Skeleton& own, const Posture& posture);
Posture posture_of(const Skeleton& own, const Pose& pose);

/// About the origin, the whole body.
Posture turned(Posture posture, const Eigen::Quaterniond& turn);

}  // namespace garmentfit
