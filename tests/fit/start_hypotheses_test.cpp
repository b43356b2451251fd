// SPDX-License-Identifier: GPL-3.0-or-later

// The energy of the fast method, its moves, and starting hypotheses that a caller gives.

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
    const BestStart best = find_best_start(energy, facing_hypotheses(energy), {});
    const Limb& arm = k_limbs[2];
    Posture lowered = best.posture;
    for (const int b : arm.bones)
        lowered.directions[b] = -Vec3::UnitY();
    const Posture found = search_limb(energy, lowered, arm, { std::numbers::pi, 0.2, 8, true });
    EXPECT_EQ(energy.crossing_cost(found, arm), 0);
    EXPECT_GT(energy.total(found), energy.total(lowered));
    for (const int b : { lfemur, rfemur, rhumerus, rradius })
        EXPECT_EQ(found.directions[b], lowered.directions[b]) << "other limbs keep their directions";
}

TEST_F(Shirt, EachHypothesisIsScoredByItself)
{
    const std::vector<StartHypothesis> hypotheses { { upright_turn(rig, 0) }, { upright_turn(rig, std::numbers::pi) } };
    const std::vector<HypothesisScore> scores = score_hypotheses(energy, hypotheses, {});
    ASSERT_EQ(scores.size(), 2u);
    EXPECT_GT(front_z(scores[0].posture), 0.8) << "the first faces the front";
    EXPECT_LT(front_z(scores[1].posture), -0.8) << "the second faces the back";
    EXPECT_GT(scores[0].energy, scores[1].energy) << "elbows bend forwards";
    for (const HypothesisScore& score : scores) {
        EXPECT_EQ(score.energy, energy.total(score.posture));
        EXPECT_EQ(score.clearance_share, energy.clearance_share(score.posture));
        EXPECT_EQ(score.bones_through_cloth, energy.bones_through_cloth(score.posture));
        EXPECT_GT(score.clearance_share, 0.3);
    }
    const std::vector<HypothesisScore> alone = score_hypotheses(energy, { hypotheses[1] }, {});
    EXPECT_EQ(alone[0].energy, scores[1].energy) << "no hypothesis depends on the others";
}

TEST_F(Shirt, SleevesTellTwoFacings)
{
    const std::vector<StartHypothesis> hypotheses = facing_hypotheses(energy);
    ASSERT_EQ(hypotheses.size(), 2u);
    EXPECT_NEAR(hypotheses[0].turn.angularDistance(hypotheses[1].turn), std::numbers::pi, 0.3);
}

}  // namespace
