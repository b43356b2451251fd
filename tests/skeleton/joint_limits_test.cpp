// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_limits.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "posture.h"

namespace {

using namespace garmentfit;

constexpr double k_degree = std::numbers::pi / 180;

/// Excess of a bone of the standing body that is rotated by an angle about an axis of the world, degrees.
double excess(int bone, double degrees, const Vec3& axis)
{
    const Rig rig = fixtures::simple_rig(fixtures::capsule_person({ .elbow_angle = 0 }));
    const Vec3 straight = rig.skeleton.direction(parent_of(bone));
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(degrees * k_degree, axis));
    return JointLimits(rig).excess(bone, Eigen::Quaterniond::Identity(), turn * straight) / k_degree;
}

TEST(JointLimits, TheComfortableBodyIsWithinAllLimits)
{
    const Rig rig = fixtures::simple_rig(fixtures::capsule_person());
    const JointLimits limits(rig);
    std::array<Eigen::Quaterniond, bone_count> turns;
    for (int b = 0; b < bone_count; ++b) {
        const Eigen::Quaterniond parent = parent_of(b) < 0 ? Eigen::Quaterniond::Identity() : turns[parent_of(b)];
        const Vec3 direction = limits.comfort_direction(b, parent);
        EXPECT_LT(limits.excess(b, parent, direction), 1e-6) << bone_name(b);
        turns[b] = bone_turn(rig.skeleton, b, parent, direction);
    }
}

TEST(JointLimits, AKneeBendsBackwardsOnly)
{
    EXPECT_NEAR(excess(ltibia, 60, Vec3::UnitX()), 0, 1);
    EXPECT_NEAR(excess(ltibia, -60, Vec3::UnitX()), 55, 3);  // it may overstretch by 5 degrees
    EXPECT_NEAR(excess(rtibia, -60, Vec3::UnitX()), 55, 3);
}

TEST(JointLimits, AnElbowBendsForwardsOnly)
{
    const Vec3 upper = fixtures::person_skeleton({ .elbow_angle = 0 }).direction(lhumerus);
    const Vec3 axis = upper.cross(Vec3::UnitZ()).normalized();  // turns the forearm to the front
    EXPECT_NEAR(excess(lradius, 100, axis), 0, 1);
    EXPECT_NEAR(excess(lradius, -60, axis), 52, 3);  // it may overstretch by 8 degrees
}

TEST(JointLimits, AForearmBehindItsClavicleFoldsIntoTheChest)
{
    EXPECT_TRUE(folds_into_chest(Vec3::UnitX(), Vec3(-0.1, 1, 0)));
    EXPECT_FALSE(folds_into_chest(Vec3::UnitX(), Vec3(0.1, 1, 0)));
}

}  // namespace
