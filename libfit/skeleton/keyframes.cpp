// SPDX-License-Identifier: GPL-3.0-or-later
#include "keyframes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "parallel.h"
#include "posture.h"

namespace garmentfit {
namespace {

constexpr double k_degree = std::numbers::pi / 180;
constexpr double k_clavicle_lift = 25 * k_degree;  // of an arm that points up; literature: [aaos_1994_joint_motion]
constexpr int k_steps = 8;  // of a cycle; a matter of taste

/// Where a limb points: outwards (away from the other side), up, front. Of any length.
struct Limb {
    Vec3 upper, lower;
};

/// Degrees: forwards, to the left side, turned to the left.
struct Bend {
    double forwards = 0, sideways = 0, turned = 0;
};

struct Described {
    const char* name;
    Limb left_leg, right_leg;  // in the axes of the body
    Limb left_arm, right_arm;  // in the axes of the chest
    Bend trunk = {}, head = {};
};

const Vec3 k_down(0, -1, 0), k_up(0, 1, 0), k_front(0, 0, 1), k_out(1, 0, 0);
const Limb k_leg { { 0.08, -1, 0 }, { 0.02, -1, -0.05 } };
const Limb k_hanging { { 0.35, -1, 0 }, { 0.25, -1, 0.15 } };
const Limb k_slanted { { 1, -0.9, 0 }, { 1, -0.9, 0.1 } };
const Limb k_level { k_out, k_out };

// Own choice: what people do in clothes, with the ends of the range of shoulders, elbows, hips, knees and trunk.
const std::array<Described, 20> k_poses { {
    { "stand", k_leg, k_leg, k_hanging, k_hanging },
    { "a pose", k_leg, k_leg, k_slanted, k_slanted },
    { k_t_pose, k_leg, k_leg, k_level, k_level },
    { "arms up", k_leg, k_leg, { { 0.5, 1, 0 }, { 0.1, 1, 0 } }, { { 0.5, 1, 0 }, { 0.1, 1, 0 } } },
    { "arms forward", k_leg, k_leg, { { 0.1, 0, 1 }, { 0, 0.05, 1 } }, { { 0.1, 0, 1 }, { 0, 0.05, 1 } } },
    { "hands on hips",
      k_leg,
      k_leg,
      { { 0.8, -1, -0.3 }, { -0.7, -0.8, 0.5 } },
      { { 0.8, -1, -0.3 }, { -0.7, -0.8, 0.5 } } },
    { "reach up", k_leg, k_leg, { { 0.3, 1, 0.2 }, { 0.1, 1, 0.3 } }, k_hanging, { 0, -15, 0 } },
    { "wave", k_leg, k_leg, { { 1, 0.2, 0 }, { 0.3, 1, 0.2 } }, k_hanging, {}, { 0, 0, 30 } },
    { "hands at mouth",
      k_leg,
      k_leg,
      { { 0.4, -0.8, 0.6 }, { -0.5, 0.8, 0.5 } },
      { { 0.4, -0.8, 0.6 }, { -0.5, 0.8, 0.5 } },
      {},
      { 15, 0, 0 } },
    { "elbows behind",
      k_leg,
      k_leg,
      { { 0.3, -0.8, -0.7 }, { 0.1, -0.2, 1 } },
      { { 0.3, -0.8, -0.7 }, { 0.1, -0.2, 1 } } },
    { "step",
      { { 0.08, -1, 0.4 }, { 0.02, -1, 0.05 } },
      { { 0.08, -1, -0.25 }, { 0.02, -1, -0.6 } },
      k_hanging,
      k_hanging },
    { "lunge",
      { { 0.1, -0.35, 1 }, { 0, -1, -0.05 } },
      { { 0.1, -1, -0.3 }, { 0.05, -0.7, -1 } },
      k_hanging,
      k_hanging,
      { 10, 0, 0 } },
    { "knee up", { { 0.1, 0.1, 1 }, { 0, -1, 0 } }, k_leg, k_slanted, k_slanted },
    { "kick", { { 0.1, -0.5, 1 }, { 0.1, -0.4, 1 } }, k_leg, k_slanted, k_slanted, { -5, 0, 0 } },
    { "straddle", { { 0.7, -1, 0 }, { 0.65, -1, -0.05 } }, { { 0.7, -1, 0 }, { 0.65, -1, -0.05 } }, k_level, k_level },
    { "sit", { { 0.15, -0.05, 1 }, { 0.05, -1, 0 } }, { { 0.15, -0.05, 1 }, { 0.05, -1, 0 } }, k_hanging, k_hanging },
    { "squat",
      { { 0.4, 0.1, 1 }, { 0.1, -1, -0.6 } },
      { { 0.4, 0.1, 1 }, { 0.1, -1, -0.6 } },
      { { 0.1, -0.3, 1 }, { 0, 0, 1 } },
      { { 0.1, -0.3, 1 }, { 0, 0, 1 } },
      { 30, 0, 0 } },
    { "bow",
      k_leg,
      k_leg,
      { { 0.2, -0.6, 1 }, { 0.1, -0.5, 1 } },
      { { 0.2, -0.6, 1 }, { 0.1, -0.5, 1 } },
      { 60, 0, 0 } },
    { "bend sideways", k_leg, k_leg, k_hanging, k_slanted, { 0, 30, 0 }, { 0, 10, 0 } },
    { "look back", k_leg, k_leg, k_hanging, k_hanging, { 0, 0, 40 }, { 0, 0, 40 } },
} };

/// How limbs swing in a cycle; degrees.
struct Gait {
    const char* name;
    double thigh, thigh_middle, knee, arm, elbow, lean, twist;
};

// fitted: guess, after the usual ranges of gait; for looks, not for medicine.
constexpr std::array<Gait, 2> k_gaits { { { "walk", 25, 5, 55, 20, 15, 2, 5 },
                                          { "run", 45, 15, 100, 40, 85, 8, 10 } } };

Vec3 swung(double degrees, double outwards)
{
    return { outwards, -std::cos(degrees * k_degree), std::sin(degrees * k_degree) };
}

/// @param phase  rad; the left leg is foremost at 0
Limb swinging_leg(const Gait& gait, double phase)
{
    const double thigh = gait.thigh_middle + gait.thigh * std::cos(phase);
    // The knee bends most while the leg swings forwards, half of the cycle after the foot left the ground.
    const double knee = 5 + gait.knee * std::pow(std::max(0.0, -std::sin(phase)), 2);
    return { swung(thigh, 0.06), swung(thigh - knee, 0.01) };
}

Limb swinging_arm(const Gait& gait, double phase)
{
    const double arm = gait.arm * std::cos(phase);
    return { swung(arm, 0.3), swung(arm + gait.elbow, 0.15) };
}

std::vector<Described> cycle(const Gait& gait)
{
    std::vector<Described> result;
    for (int step = 0; step < k_steps; ++step) {
        const double left = 2 * std::numbers::pi * step / k_steps, right = left + std::numbers::pi;
        result.push_back({ gait.name,
                           swinging_leg(gait, left),
                           swinging_leg(gait, right),
                           swinging_arm(gait, right),
                           swinging_arm(gait, left),
                           { gait.lean, 0, -gait.twist * std::cos(left) } });
    }
    return result;
}

/// Brings a description to the axes and the rest pose of one rig.
class Poser {
public:
    explicit Poser(const Rig& rig) : rest_(rig.skeleton)
    {
        axes_.col(1) = rig.up.normalized();
        axes_.col(0) = rig.up.cross(rig.front).normalized();  // the body's left
        axes_.col(2) = axes_.col(0).cross(axes_.col(1));
    }

    Pose pose(const Described& described) const
    {
        Pose pose;
        for (const int bone : { lowerback, upperback, thorax })
            pose.rotations[std::size_t(bone)] = turn(described.trunk, 1.0 / 3);
        for (const int bone : { lowerneck, upperneck })
            pose.rotations[std::size_t(bone)] = turn(described.head, 0.5);
        point(pose, lfemur, described.left_leg, 1);
        point(pose, rfemur, described.right_leg, -1);
        lift_clavicle(pose, lclavicle, described.left_arm, 1);
        lift_clavicle(pose, rclavicle, described.right_arm, -1);
        const Eigen::Quaterniond chest = world_turn(pose, thorax);
        point(pose, lhumerus, described.left_arm, 1, chest);
        point(pose, rhumerus, described.right_arm, -1, chest);
        return pose;
    }

private:
    Eigen::Quaterniond about(int axis, double radians) const
    {
        return Eigen::Quaterniond(Eigen::AngleAxisd(radians, Vec3(axes_.col(axis))));
    }

    Eigen::Quaterniond turn(const Bend& bend, double share) const
    {
        return about(1, share * bend.turned * k_degree) * about(2, -share * bend.sideways * k_degree)
            * about(0, share * bend.forwards * k_degree);
    }

    Eigen::Quaterniond world_turn(const Pose& pose, int bone) const
    {
        Eigen::Quaterniond result = pose.rotations[std::size_t(bone)];
        for (int up = parent_of(bone); up >= 0; up = parent_of(up))
            result = pose.rotations[std::size_t(up)] * result;
        return pose.root_rotation * result;
    }

    void lift_clavicle(Pose& pose, int bone, const Limb& arm, double side) const
    {
        const double lift = std::max(0.0, arm.upper.normalized().y()) * k_clavicle_lift;
        pose.rotations[std::size_t(bone)] = about(2, side * lift);
    }

    /// Of a limb of two bones.
    void point(Pose& pose, int upper, const Limb& limb, double side,
               const Eigen::Quaterniond& frame = Eigen::Quaterniond::Identity()) const
    {
        for (const int bone : { upper, upper + 1 }) {
            const Vec3& given = bone == upper ? limb.upper : limb.lower;
            const Vec3 direction = frame * (axes_ * Vec3(side * given.x(), given.y(), given.z())).normalized();
            const Eigen::Quaterniond parent = world_turn(pose, parent_of(bone));
            pose.rotations[std::size_t(bone)] = parent.conjugate() * bone_turn(rest_, bone, parent, direction);
        }
    }

    const Skeleton& rest_;
    Eigen::Matrix3d axes_;  // columns: left, up, front
};

}  // namespace

std::vector<Keyframe> keyframes_of(const Rig& rig)
{
    const Poser poser(rig);
    std::vector<Keyframe> result;
    for (const Described& described : k_poses)
        result.push_back({ described.name, poser.pose(described) });
    for (const Gait& gait : k_gaits)
        for (const Described& described : cycle(gait))
            result.push_back(
                { gait.name + std::string(" ") + std::to_string(result.size() % k_steps), poser.pose(described) });
    return result;
}

Positions blend_linearly(const Positions& rest_positions, const SkinWeights& weights, const BoneTransforms& transforms)
{
    Positions posed(rest_positions.rows(), 3);
    parallel_for(std::size_t(posed.rows()), [&](std::size_t v) {
        Eigen::Matrix<double, 3, 4> blended = Eigen::Matrix<double, 3, 4>::Zero();
        for (int k = 0; k < 4; ++k)
            if (const double weight = weights.weights(Eigen::Index(v), k); weight > 0)
                blended += weight * transforms[std::size_t(weights.bones(Eigen::Index(v), k))].affine();
        posed.row(Eigen::Index(v)) = (blended * Vec3(rest_positions.row(Eigen::Index(v))).homogeneous()).transpose();
    });
    return posed;
}

}  // namespace garmentfit
