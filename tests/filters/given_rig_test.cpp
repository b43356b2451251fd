// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/given_rig.h"

#include "fixtures.h"
#include "garmentfit/filters/warnings.h"

namespace garmentfit {
namespace {

using namespace fixtures;

struct GivenRig : testing::Test {
    const Person person = capsule_person();
    const Positions own = person.mesh.positions;
    const Rig rig = rig_on(simple_rig(person), own);
};

TEST_F(GivenRig, HasItsRadiiMeasured)
{
    EXPECT_EQ(rig.radii, bone_radii(rig.skeleton, rig.weights, own));
    EXPECT_GT(rig.radii[lfemur], 0.02);
}

TEST_F(GivenRig, IsKnownAgainOnABodyThatWasKeptAsFloats)
{
    const Positions kept = own.cast<float>().cast<double>();
    EXPECT_EQ(rig_on(rig, kept).skeleton.tails, rig.skeleton.tails);
}

TEST_F(GivenRig, IsNotThatOfABodyOfOtherVertices)
{
    expect_invalid([&] { rig_on(rig, own.topRows(9), "man.rig.json"); }, "man.rig.json belongs to a body of");
}

TEST_F(GivenRig, IsNotThatOfAnotherBodyWithAsManyVertices)
{
    expect_invalid([&] { rig_on(rig, 1.06 * own); }, "belongs to another body");
}

TEST_F(GivenRig, IsNotThatOfABodyThatWasMovedSince)
{
    expect_invalid([&] { rig_on(rig, own.rowwise() + Vec3(0.05, 0, 0).transpose()); }, "was moved since");
}

TEST_F(GivenRig, IsNotOneWhoseDirectionsOrWeightsWereSpoilt)
{
    Rig spoilt = rig;
    spoilt.up = spoilt.front = Vec3::Zero();
    expect_invalid([&] { rig_on(spoilt, own); }, "up and front of the rig");
    spoilt = rig;
    spoilt.front = spoilt.up;
    expect_invalid([&] { rig_on(spoilt, own); }, "at right angles");
    spoilt = rig;
    spoilt.weights.weights.row(5).setZero();
    expect_invalid([&] { rig_on(spoilt, own); }, "vertex 5 sum to 0");
}

TEST_F(GivenRig, IsDoubtedWhereItsSkeletonIsWrong)
{
    const BodyMesh body = make_body(person.mesh.positions, person.mesh.triangles);
    EXPECT_EQ(doubt_about(rig, body), "");
    Rig wrong = rig;
    for (const int left : { lhipjoint, lfemur, ltibia })
        std::swap(wrong.skeleton.tails[left], wrong.skeleton.tails[mirror_of(left)]);
    EXPECT_NE(doubt_about(wrong, body).find("lie on different sides"), std::string::npos) << doubt_about(wrong, body);
    EXPECT_TRUE(warnings_about_given_rig(rig, body, "man.rig.json").empty());
    EXPECT_EQ(warnings_about_given_rig(wrong, body, "man.rig.json"),
              std::vector<std::string> { "man.rig.json may be wrong: " + doubt_about(wrong, body) });
}

}  // namespace
}  // namespace garmentfit
