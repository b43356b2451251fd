// SPDX-License-Identifier: GPL-3.0-or-later

// The energy of the fast method, its moves, and starting hypotheses that a caller gives.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "best_start.h"
#include "coordinate_ascent.h"
#include "fixtures.h"
#include "garmentfit/mesh.h"
#include "limb_search.h"
#include "outward_cloth.h"
#include "posture_moves.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

// A long-sleeved shirt whose sleeves bend forwards, so that it has a front, and its energy.
class Shirt : public testing::Test {
protected:
    static TriangleMesh make_shirt()
    {
        const TriangleMesh cloth
            = garment_round(person_skeleton({ .arm_angle = 40, .elbow_angle = 40 }), 0.02,
                            [](const Vec3& p) { return p.y() > 0.85 && p.y() < 1.46 && std::abs(p.x()) < 0.5; });
        return outward_cloth(make_garment(cloth.positions, cloth.triangles));
    }

    static Rig make_rig()
    {
        Rig rig;
        rig.skeleton = person_skeleton({ .arm_angle = 70 });
        return rig;
    }

    Posture moved(Posture posture, std::mt19937& random) const
    {
        std::uniform_real_distribution<double> step(-0.1, 0.1);
        std::uniform_int_distribution<int> bone(0, bone_count - 1);
        Vec3& direction = posture.directions[bone(random)];
        direction = (direction + Vec3(step(random), step(random), step(random))).normalized();
        if (bone(random) == 0)
            posture = rotate_about_trunk(energy, posture, Vec3(step(random), step(random), step(random)));
        return posture;
    }

    double front_z(const Posture& posture) const { return (posture.turn * rig.front).z(); }

    const TriangleMesh outward = make_shirt();
    const Rig rig = make_rig();
    const std::vector<Opening> openings = openings_of(outward);
    const ClearanceField cloth { outward };
    const JointLimits limits { rig };
    const BoneMetric metric { cloth, limb_radii_of(rig, bones_covered_by(GarmentType::longsleeve, openings)) };
    const FitEnergy energy { rig, limits, metric, cues_of(openings) };
};

TEST_F(Shirt, TheEnergyNearAPostureHasTheBitsOfTheWholeOne)
{
    std::mt19937 random(1);
    Posture present = comfort_posture(energy, cloth.barycentre(), upright_turn(rig, 0));
    EnergyTerms terms = energy.evaluate(present);
    for (int i = 0; i < 300; ++i) {
        const Posture next = moved(present, random);
        ASSERT_EQ(energy.value(next, terms), energy.value(next)) << i;
        if (i % 5 == 0) {
            present = next;
            terms = energy.evaluate(next);
        }
    }
}

TEST_F(Shirt, AnAscentNeverLowersTheEnergy)
{
    const Posture start = comfort_posture(energy, cloth.barycentre(), upright_turn(rig, 0.3));
    const Posture end = ascend(energy, start, { 0.16, 0.08 });
    EXPECT_GT(energy.total(end), energy.total(start));
}

TEST_F(Shirt, ALimbIsSearchedWithoutPassingThroughCloth)
{
    const Limb& arm = k_limbs[2];
    Posture lowered = ascend_starts(energy, find_rough_starts(energy, facing_hypotheses(energy)), {}).front();
    for (const int b : arm.bones)
        lowered.directions[b] = -Vec3::UnitY();
    const Posture found = search_limb(energy, lowered, arm, { std::numbers::pi, 0.2, 8, true });
    EXPECT_EQ(energy.crossing_cost(found, arm), 0);
    EXPECT_GT(energy.total(found), energy.total(lowered));
    for (const int b : { lfemur, rfemur, rhumerus, rradius })
        EXPECT_EQ(found.directions[b], lowered.directions[b]) << "other limbs keep their directions";
}

TEST_F(Shirt, AnArmBesideTheSpineMissesItsSleeve)
{
    const Posture worn = ascend_starts(energy, find_rough_starts(energy, facing_hypotheses(energy)), {}).front();
    Posture beside = worn;
    const Vec3 shoulder = place_bones(rig.skeleton, worn).joints.tail(lclavicle),
               between_hips = place_bones(rig.skeleton, worn).joints.root;
    for (const int b : { lhumerus, lradius })
        beside.directions[b] = (between_hips - shoulder).normalized();
    const auto misses = [&](const Posture& posture, Bone bone) {
        const Skeleton joints = place_bones(rig.skeleton, posture).joints;
        return energy.misses_sleeve(bone, joints.tail(bone), joints);
    };
    EXPECT_FALSE(misses(worn, lhumerus) || misses(worn, rhumerus));
    EXPECT_TRUE(misses(beside, lhumerus));
    EXPECT_FALSE(misses(beside, rhumerus) || misses(beside, lfemur));
    EXPECT_EQ(energy.crossing_cost(worn, k_limbs[2]), 0);
    EXPECT_GE(energy.crossing_cost(beside, k_limbs[2]), energy.weights().arm_in_trunk);
}

TEST_F(Shirt, AscentsKeepTheBestOfEachFacing)
{
    const std::vector<Posture> rough = find_rough_starts(energy, facing_hypotheses(energy)),
                               starts = ascend_starts(energy, rough, {});
    const auto is_forwards = [&](const Posture& posture) { return front_z(posture) > 0.8; };
    const auto is_backwards = [&](const Posture& posture) { return front_z(posture) < -0.8; };
    const auto forwards = std::find_if(starts.begin(), starts.end(), is_forwards),
               backwards = std::find_if(starts.begin(), starts.end(), is_backwards);
    ASSERT_NE(forwards, starts.end());
    ASSERT_NE(backwards, starts.end());
    EXPECT_GT(energy.total(*forwards), energy.total(*backwards)) << "elbows bend forwards";
    EXPECT_EQ(energy.total(starts.front()), energy.total(*forwards)) << "the best comes first";
    EXPECT_GE(energy.total(*forwards), energy.total(*std::find_if(rough.begin(), rough.end(), is_forwards)));
}

TEST_F(Shirt, OtherPosturesAreAscendedToo)
{
    const Posture input = input_posture(rig.skeleton);
    const std::vector<Posture> alone = ascend_starts(energy, {}, { input });
    ASSERT_EQ(alone.size(), 1u);
    EXPECT_GT(energy.total(alone[0]), energy.total(input));
}

TEST_F(Shirt, FarFromTheClothAPostureGainsNothingByHeight)
{
    const Posture high = comfort_posture(energy, cloth.barycentre() + Vec3(5, 5, 0), upright_turn(rig, 0));
    Posture higher = high;
    higher.root.y() += 5;
    EXPECT_LT(energy.value(higher), energy.value(high) + 0.5) << "an ascent would never end";
}

TEST_F(Shirt, SleevesTellTwoFacings)
{
    const std::vector<StartHypothesis> hypotheses = facing_hypotheses(energy);
    ASSERT_EQ(hypotheses.size(), 2u);
    EXPECT_NEAR(hypotheses[0].turn.angularDistance(hypotheses[1].turn), std::numbers::pi, 0.3);
}

}  // namespace
