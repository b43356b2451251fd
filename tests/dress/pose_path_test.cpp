// SPDX-License-Identifier: GPL-3.0-or-later
#include "pose_path.h"

#include <gtest/gtest.h>

#include "fixtures.h"

namespace garmentfit {
namespace {

/// A person in its A-pose, and the same with the left forearm bent by a right angle.
struct BentForearm : testing::Test {
    BentForearm()
    {
        const fixtures::Person person = fixtures::capsule_person();
        body.surface = body.closed = person.mesh;
        rig.skeleton = person.skeleton;
        rig.weights = fixtures::on_bone(lradius, person.mesh.positions.rows());
        bent.rotations[lradius] = Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY()));
    }
    PosePath path(const Pose& from, const Pose& to, const Positions& cloth) const
    {
        return PosePath(rig, body, from, to, Positions(0, 3), cloth);
    }

    BodyMesh body;
    Rig rig;
    Pose input, bent;
    const Positions far_away = Positions::Constant(1, 3, 1000);
};

TEST_F(BentForearm, EndsInThePoseOfTheInputBitForBit)
{
    const PosePath back = path(bent, input, far_away);
    EXPECT_EQ(back.end(), body.surface.positions);
    EXPECT_EQ(back.at(1), body.surface.positions);
    EXPECT_EQ(back.at(0), skin(body.surface.positions, rig.weights, bone_transforms(rig.skeleton, bent)));
}

TEST_F(BentForearm, HasTheLengthOfTheArcThatClothGoes)
{
    constexpr double k_radius = 0.2;  // m, from the elbow, across the axis of the turn
    const Positions cloth = (rig.skeleton.head(lradius) + k_radius * Vec3::UnitX()).transpose();
    const double arc = k_radius * M_PI / 2;
    EXPECT_NEAR(path(input, bent, cloth).length(cloth, fixtures::on_bone(lradius, 1)), arc, 4e-4 * arc);
    EXPECT_NEAR(path(input, bent, cloth).length(cloth, fixtures::on_bone(lhumerus, 1)), 0, 1e-12);
}

TEST_F(BentForearm, BridgesNoCreaseWithoutClothNearIt)
{
    const PosePath back = path(bent, input, far_away);
    for (const double share : { 0.0, 0.25, 0.5, 1.0 })
        EXPECT_EQ(back.bridged_at(share), back.at(share)) << share;
}

}  // namespace
}  // namespace garmentfit
