// SPDX-License-Identifier: GPL-3.0-or-later
#include "growing_body.h"

#include <gtest/gtest.h>

#include "fixtures.h"

namespace garmentfit {
namespace {

TEST(GrowingBody, LiesBetweenCoreAndBridgedSkinAndNotBelowItsLeastScale)
{
    GrowingBody body;
    body.core = Positions::Zero(2, 3);
    body.bridged = Positions::Constant(2, 3, 4);
    body.min_scale = { 0, 0.75 };
    EXPECT_EQ(body.at(0.5).row(0), Eigen::RowVector3d(2, 2, 2));
    EXPECT_EQ(body.at(0.5).row(1), Eigen::RowVector3d(3, 3, 3));
    EXPECT_EQ(body.at(1), body.bridged);
}

/// A person whose skin all hangs on its left forearm.
struct Sleeved : testing::Test {
    const fixtures::Person person = fixtures::capsule_person();
    BodyMesh body;
    Rig rig;
    DressedBody bare;

    Sleeved()
    {
        body.surface = body.closed = person.mesh;
        rig.skeleton = person.skeleton;
        rig.weights = fixtures::on_bone(lradius, person.mesh.positions.rows());
    }
    GrowingBody grow_in(const GarmentMesh& garment) const
    {
        return make_growing_body({ rig, body, bare, HandStretch(rig, body.surface.positions), rig.skeleton }, garment,
                                 nullptr);
    }
};

TEST_F(Sleeved, StartsOnTheBonesAndEndsAsTheBody)
{
    const GrowingBody inside = grow_in(fixtures::sleeve_round(person.skeleton, lradius, 0.2, 0.05, 0.2));
    EXPECT_EQ(inside.full.positions, person.mesh.positions);
    EXPECT_EQ(inside.body_vertices, person.mesh.positions.rows());
    const Vec3 elbow = person.skeleton.head(lradius), along = person.skeleton.direction(lradius);
    for (const auto& p : inside.core.rowwise())
        EXPECT_LT((p.transpose() - elbow).cross(along).norm(), 1e-9) << "all skin hangs on this bone";
}

}  // namespace
}  // namespace garmentfit
