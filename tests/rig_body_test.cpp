// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/rig_body.h"

#include <gtest/gtest.h>

#include "fit/error.h"
#include "fixtures.h"

namespace {

using namespace fit;
using fixtures::capsule_person;

BodyMesh body_of(const TriangleMesh& mesh)
{
    return make_body(mesh.positions, mesh.triangles);
}

TEST(RigBody, FindsTheJointsThatAPersonWasBuiltRound)
{
    const fixtures::Person person = capsule_person();
    const Rig rig = rig_body(body_of(person.mesh));
    for (int bone = 0; bone < bone_count; ++bone)
        EXPECT_LT((rig.skeleton.tail(bone) - person.skeleton.tail(bone)).norm(), 0.12) << bone_name(bone);
    EXPECT_GT(rig.front.z(), 0.9);
    EXPECT_GT(rig.up.y(), 0.9);
}

TEST(RigBody, WeightsOfEveryVertexArePositiveAndSumToOne)
{
    const fixtures::Person person = capsule_person();
    const SkinWeights weights = rig_body(body_of(person.mesh)).weights;
    ASSERT_EQ(weights.weights.rows(), person.mesh.positions.rows());
    EXPECT_GE(weights.weights.minCoeff(), 0);
    EXPECT_GE(weights.bones.minCoeff(), 0);
    EXPECT_LT(weights.bones.maxCoeff(), bone_count);
    EXPECT_LT((weights.weights.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
}

TEST(RigBody, CanBeStopped)
{
    const BodyMesh body = body_of(capsule_person().mesh);
    EXPECT_THROW(rig_body(body, {}, Progress([](double fraction, std::string_view) { return fraction < 0.3; })), Cancelled);
    EXPECT_NO_THROW(rig_body(body));
}

TEST(RigBody, RefusesWhatIsNotAHuman)
{
    const auto ball = [](const Vec3& p) { return p.norm() - 0.4; };
    const Vec3 corner = Vec3::Constant(0.6);
    EXPECT_THROW(rig_body(body_of(fixtures::polygonise(ball, -corner, corner, 0.05))), InvalidInput);
}

}  // namespace
