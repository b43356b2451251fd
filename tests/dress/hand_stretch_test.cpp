// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_stretch.h"

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/rig_body.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

/// Arms held out, with hands that hang down at right angles.
struct HangingHands : testing::Test {
    HangingHands()
    {
        PersonOptions options;
        options.arm_angle = 10;
        options.elbow_angle = 0;
        options.wrist_angle = 90;
        options.spacing = 0.03;
        const Person person = capsule_person(options);
        input = person.mesh.positions;
        rig = rig_body(make_body(input, person.mesh.triangles));
        rig.skeleton = person.skeleton;
        turned.rotations[lhumerus] = Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vec3::UnitZ()));
    }

    double bend(const Skeleton& skeleton, int bone, Extremity tip) const
    {
        const Vec3 hand = (skeleton.tips[tip] - skeleton.tail(bone)).normalized();
        return std::acos(std::clamp(hand.dot(skeleton.direction(bone)), -1.0, 1.0));
    }

    /// A sleeve round the left forearm, longer than the hand, in the turned pose.
    GarmentMesh sleeve(double radius) const
    {
        return sleeve_round(garmentfit::pose_skeleton(rig.skeleton, turned), lradius, radius, 0.05, 0.5);
    }

    Positions input;
    Rig rig;
    Pose turned;
};

TEST_F(HangingHands, LieAlongTheForearmsWhenStretched)
{
    const HandStretch hands(rig, input);
    EXPECT_NEAR(bend(rig.skeleton, lradius, lhand_tip), M_PI / 2, 1e-9);
    const Skeleton straight = hands.stretch_skeleton({ 1, 0 });
    EXPECT_NEAR(bend(straight, lradius, lhand_tip), 0, 1e-6);
    EXPECT_NEAR(bend(straight, rradius, rhand_tip), M_PI / 2, 1e-9) << "the other hand moved";
    const Positions stretched = hands.stretch_skin({ 1, 0 });
    EXPECT_LT((stretched.rowwise() - straight.tips[lhand_tip].transpose()).rowwise().norm().minCoeff(), 0.03);
    for (Eigen::Index v = 0; v < input.rows(); ++v)
        if ((input.row(v).transpose() - rig.skeleton.tail(lradius)).norm() > 0.25) {
            EXPECT_EQ(stretched.row(v), input.row(v)) << v;
        }
}

TEST_F(HangingHands, StayAsTheyAreWithoutStretch) { EXPECT_EQ(HandStretch(rig, input).stretch_skin({ 0, 0 }), input); }

TEST_F(HangingHands, AreStretchedForASleeveThatTheyWouldPassThrough)
{
    const HandStretch hands(rig, input);
    const HandStretch::Shares left { 1, 0 }, none { 0, 0 };
    EXPECT_EQ(hands.find_clear_stretch(sleeve(0.08), turned), left);
    EXPECT_EQ(hands.find_clear_stretch(sleeve(0.3), turned), none);
}

TEST_F(HangingHands, AreKnownByWhereTheyWereLeft)
{
    const HandStretch hands(rig, input);
    const HandStretch::Shares left { 1, 0 }, none { 0, 0 };
    const auto in_pose = [&](const HandStretch::Shares& stretch) {
        return skin(hands.stretch_skin(stretch), rig.weights, bone_transforms(rig.skeleton, turned));
    };
    EXPECT_EQ(hands.find_stretch(in_pose(left), turned), left);
    EXPECT_EQ(hands.find_stretch(in_pose(none), turned), none);
    EXPECT_EQ(hands.find_stretch(Positions(0, 3), turned), none);
}

}  // namespace
