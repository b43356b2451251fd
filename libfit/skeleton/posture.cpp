// SPDX-License-Identifier: GPL-3.0-or-later
#include "posture.h"

#include <algorithm>
#include <cmath>

namespace garmentfit {

double angle_between(const Vec3& a, const Vec3& b) { return std::acos(std::clamp(a.dot(b), -1.0, 1.0)); }

Eigen::Quaterniond shortest_arc(const Vec3& from, const Vec3& to)
{
    const double w = 1 + from.dot(to);
    if (w < 1e-9) {  // unit: opposite directions; any fixed axis across them is valid
        const Vec3 axis = from.unitOrthogonal();
        return { 0, axis.x(), axis.y(), axis.z() };
    }
    const Vec3 axis = from.cross(to);
    return Eigen::Quaterniond(w, axis.x(), axis.y(), axis.z()).normalized();
}

Eigen::Quaterniond bone_turn(const Skeleton& rest, int bone, const Eigen::Quaterniond& parent_turn,
                             const Vec3& direction)
{
    return (shortest_arc(parent_turn * rest.direction(bone), direction) * parent_turn).normalized();
}

namespace {

template <class Turn>
PlacedBones place_bones(const Skeleton& rest, const Posture& posture, const Turn& turn_of)
{
    PlacedBones result;
    result.root_turn = posture.turn;
    result.joints.root = posture.root;
    result.directions = posture.directions;
    for (int b = 0; b < bone_count; ++b) {
        result.turns[b] = turn_of(b, result.parent_turn(b));
        result.joints.tails[b] = result.joints.head(b) + rest.length(b) * posture.directions[b];
    }
    for (int e = 0; e < extremity_count; ++e) {
        const int b = bone_before(Extremity(e));
        result.joints.tips[e] = result.joints.tail(b) + result.turns[b] * (rest.tips[e] - rest.tail(b));
    }
    return result;
}

}  // namespace

PlacedBones place_bones(const Skeleton& rest, const Posture& posture)
{
    return place_bones(rest, posture, [&](int b, const Eigen::Quaterniond& parent_turn) {
        return bone_turn(rest, b, parent_turn, posture.directions[b]);
    });
}

PlacedBones place_bones(const Skeleton& rest, const Posture& posture, const PlacedBones& near)
{
    return place_bones(rest, posture, [&](int b, const Eigen::Quaterniond& parent_turn) {
        const bool is_same
            = posture.directions[b] == near.directions[b] && parent_turn.coeffs() == near.parent_turn(b).coeffs();
        return is_same ? near.turns[b] : bone_turn(rest, b, parent_turn, posture.directions[b]);
    });
}

Pose pose_of(const Skeleton& rest, const Posture& posture)
{
    const PlacedBones bones = place_bones(rest, posture);
    Pose pose;
    pose.root_translation = posture.root - rest.root;
    pose.root_rotation = posture.turn;
    for (int b = 0; b < bone_count; ++b)
        pose.rotations[b] = (bones.parent_turn(b).conjugate() * bones.turns[b]).normalized();
    return pose;
}

Posture posture_of(const Skeleton& rest, const Pose& pose)
{
    const Skeleton joints = pose_skeleton(rest, pose);
    Posture posture { joints.root, pose.root_rotation, {} };
    for (int b = 0; b < bone_count; ++b)
        posture.directions[b] = joints.direction(b);
    return posture;
}

Posture rotate(Posture posture, const Eigen::Quaterniond& turn)
{
    posture.root = turn * posture.root;
    posture.turn = (turn * posture.turn).normalized();
    for (Vec3& direction : posture.directions)
        direction = turn * direction;
    return posture;
}

}  // namespace garmentfit
