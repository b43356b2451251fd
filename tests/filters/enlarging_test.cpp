// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/filters/outcome.h"
#include "stages.h"

namespace {

using namespace garmentfit;

/// One garment that is worn, and lacks girth in the end.
Scene tight_scene(double size, double missing)
{
    Scene scene;
    scene.garments.resize(1);
    scene.recovered.emplace();
    Dressing& end = *scene.recovered;
    end.garments.resize(1);
    end.garments[0].positions.setZero(3, 3);
    end.garments[0].size = size;
    end.fabric_stretches = { 0.2 };
    end.too_tight = { { 0, "hips", 0.1, missing } };
    return scene;
}

TEST(Enlarging, AGarmentThatIsTooSmallInTheEndIsEnlargedWhereThatIsAllowed)
{
    Parameters parameters;
    Scene scene = tight_scene(1.1, 0.4);
    ASSERT_EQ(outcome_of(*final_dressing(scene)), Outcome::too_small);
    EXPECT_FALSE(enlarge_too_small(scene, parameters));
    parameters.drape.cloth.largest_enlargement = 0.35;
    EXPECT_FALSE(enlarge_too_small(scene, parameters)) << "not by 40 %";
    EXPECT_EQ(scene.garments[0].size, 1);
    parameters.drape.cloth.largest_enlargement = 0.5;
    EXPECT_TRUE(enlarge_too_small(scene, parameters));
    EXPECT_NEAR(scene.garments[0].size, 1.4, 1e-9) << "half of what its fabric gives is left to it";

    Scene not_put_on = tight_scene(1, 0.1);
    not_put_on.recovered->scale_reached = 0.8;
    EXPECT_FALSE(enlarge_too_small(not_put_on, parameters)) << "draping did that already";
    Scene fits = tight_scene(1, 0.1);
    fits.recovered->too_tight.clear();
    EXPECT_FALSE(enlarge_too_small(fits, parameters));
}

TEST(SmallerSteps, AreTakenWhereClothIsCaught)
{
    Scene scene = tight_scene(1, 0.1);
    EXPECT_FALSE(is_caught(scene)) << "it is too small everywhere";
    Overstretch torn;
    torn.largest = 5;
    torn.longer = 0.05;
    scene.recovered->overstretches = { torn };
    EXPECT_TRUE(is_caught(scene));
    scene.recovered->too_tight.clear();
    EXPECT_TRUE(is_caught(scene)) << "not certified";
    scene.recovered->overstretches.clear();
    EXPECT_FALSE(is_caught(scene)) << "the cloth crosses itself, say";
    scene.recovered->held_back = { { "chest", 0.02 } };
    EXPECT_TRUE(is_caught(scene)) << "it holds the body back";
    scene.recovered->overlaps = { { "chest", "left upper arm", 0.02 } };
    EXPECT_FALSE(is_caught(scene)) << "no cloth fits between them";
    scene.recovered->overstretches = { torn };
    EXPECT_FALSE(is_caught(scene)) << "nor where the cloth is torn";
    scene.recovered->overlaps = { { "left thigh", "right thigh", 0.02 } };
    EXPECT_TRUE(is_caught(scene)) << "the body crosses itself elsewhere";
    scene.recovered->certified = true;
    EXPECT_FALSE(is_caught(scene));
    scene.recovered.reset();
    EXPECT_FALSE(is_caught(scene));

    const Parameters given, slowly = growing_slowly(given), smaller = moving_slowly(slowly);
    EXPECT_GT(slowly.drape.growing_steps, given.drape.growing_steps);
    EXPECT_EQ(slowly.recover.step_length, given.recover.step_length);
    EXPECT_EQ(smaller.drape.growing_steps, slowly.drape.growing_steps);
    EXPECT_LT(smaller.recover.step_length, given.recover.step_length);
    EXPECT_NEAR(smaller.recover.step_length * smaller.recover.largest_steps,
                given.recover.step_length * given.recover.largest_steps, 1e-12)
        << "they lead as far";
}

TEST(SoftCloth, IsPutOnWhereAGarmentMayStillBeWorn)
{
    Scene scene = tight_scene(1, 0.1);
    EXPECT_TRUE(may_be_worn_in_the_end(scene)) << "it is too small in this pose";
    EXPECT_FALSE(may_be_worn_in_the_end(tight_scene(1, 0.5))) << "it is so in any";
    scene.recovered->too_tight.clear();
    scene.recovered->held_back = { { "chest", 0.02 } };
    EXPECT_TRUE(may_be_worn_in_the_end(scene));
    scene.recovered->overlaps = { { "chest", "left upper arm", 0.02 } };
    EXPECT_FALSE(may_be_worn_in_the_end(scene)) << "no cloth fits between them";
    scene.recovered->overlaps = { { "left thigh", "right thigh", 0.02 } };
    EXPECT_TRUE(may_be_worn_in_the_end(scene)) << "the body crosses itself elsewhere";
    scene.recovered->certified = true;
    EXPECT_FALSE(may_be_worn_in_the_end(scene)) << "it is worn";

    const Parameters given, soft = putting_on_softly(given);
    EXPECT_LT(material_of(soft.drape.cloth).stretch_stiffness, material_of(given.drape.cloth).stretch_stiffness);
    EXPECT_EQ(material_of(soft.recover.cloth).stretch_stiffness, material_of(given.recover.cloth).stretch_stiffness);
    EXPECT_EQ(material_of(soft.recover.cloth).largest_stretch, material_of(given.recover.cloth).largest_stretch);
}

TEST(Enlarging, AGarmentWithoutAUnitThatHoldsTheBodyBackIsLoosened)
{
    Scene scene = tight_scene(1, 0);
    scene.recovered->too_tight.clear();
    scene.recovered->held_back = { { "left thigh", 0.01 } };
    ASSERT_EQ(outcome_of(*final_dressing(scene)), Outcome::not_certified);
    EXPECT_FALSE(loosen(scene, 1.05)) << "its size is no guess";
    scene.garments[0].has_unit = false;
    EXPECT_TRUE(loosen(scene, 1.05));
    EXPECT_EQ(scene.garments[0].size, 1.05);
    EXPECT_FALSE(loosen(scene, 1.05)) << "it is as large already";
    scene.recovered->held_back.clear();
    EXPECT_FALSE(loosen(scene, 1.1)) << "the cloth crosses itself, say";
    scene.recovered->held_back = { { "left thigh", 0.01 } };
    scene.recovered->certified = true;
    EXPECT_FALSE(loosen(scene, 1.1));
}

TEST(Enlarging, AGarmentIsMadeWiderAndFittedAnewBeforeItIsEnlarged)
{
    const fixtures::Person person = fixtures::capsule_person({ .arm_angle = 20 });
    Scene scene;
    scene.body = make_body(person.mesh.positions, person.mesh.triangles);
    const TriangleMesh small = fixtures::garment_round(
        person.skeleton, -0.016, [](const Vec3& p) { return p.y() > 0.2 && p.y() < 1 && std::abs(p.x()) < 0.26; });
    scene.garments = { { make_garment(small.positions, small.triangles), GarmentType::trousers, "legs.obj" } };
    Parameters parameters;
    parameters.recover.quality = Quality::draft;
    parameters.drape.cloth.largest_enlargement = 1;
    filter_of("dress").run(scene, parameters);
    ASSERT_TRUE(scene.recovered);
    EXPECT_TRUE(scene.recovered->certified);
    const WornGarment& worn = scene.recovered->garments[0];
    EXPECT_EQ(worn.size, 1);
    EXPECT_GT(worn.girth, 1.05);
    const auto height = [](const Positions& p) { return p.col(1).maxCoeff() - p.col(1).minCoeff(); };
    EXPECT_NEAR(height(worn.rest.positions), height(small.positions), 0.03);
    EXPECT_EQ(scene.garments[0].mesh.positions, small.positions) << "what was given stays";
}

/// A person in a skirt, fitted.
Scene fitted_scene()
{
    const fixtures::Person person = fixtures::capsule_person({ .arm_angle = 20 });
    Scene scene;
    scene.body = make_body(person.mesh.positions, person.mesh.triangles);
    scene.rig = fixtures::simple_rig(person);
    const TriangleMesh skirt
        = fixtures::garment_round(person.skeleton, 0.02, [](const Vec3& p) { return p.y() > 0.4 && p.y() < 1.1; });
    scene.garments = { { make_garment(skirt.positions, skirt.triangles), GarmentType::automatic, "skirt.obj" } };
    fit_stage(scene, {}, {});
    return scene;
}

TEST(SoftCloth, IsWornWhereItsOwnFabricGivesEnoughInTheEnd)
{
    const fixtures::Person person = fixtures::capsule_person({ .arm_angle = 20 });
    const TriangleMesh tight
        = fixtures::garment_round(person.skeleton, -0.002, [](const Vec3& p) { return p.y() > 0.7 && p.y() < 1.1; });
    Scene scene;
    scene.body = make_body(person.mesh.positions, person.mesh.triangles);
    scene.garments = { { make_garment(tight.positions, tight.triangles), GarmentType::skirt, "skirt.obj" } };
    Parameters parameters;
    parameters.recover.quality = Quality::draft;
    parameters.drape.cloth.largest_stretch = 0.05;  // too small for the pose in which it is put on
    filter_of("dress").run(scene, parameters);
    ASSERT_TRUE(scene.recovered);
    EXPECT_EQ(outcome_of(*scene.recovered), Outcome::done);
    EXPECT_EQ(scene.recovered->garments[0].size, 1);
}

TEST(UsualKnits, AreTakenForGarmentsThatAreTooSmallAndOfWhichNothingElseWasSaid)
{
    const auto fabric_of
        = [](GarmentType type, double missing, const Parameters& parameters, std::optional<Fabric> given = {}) {
              Scene scene = tight_scene(1, missing);
              if (missing == 0)
                  scene.recovered->too_tight.clear();
              scene.fits.resize(1);
              scene.fits[0].type = type;
              scene.garments[0].fabric = given;
              take_usual_knits(scene, parameters);
              EXPECT_EQ(scene.garments[0].fabric_is_guessed, scene.garments[0].fabric != given);
              return scene.garments[0].fabric;
          };
    EXPECT_EQ(fabric_of(GarmentType::tshirt, 0.2, {}), Fabric::jersey);
    EXPECT_EQ(fabric_of(GarmentType::hoodie, 0.2, {}), Fabric::fleece);
    EXPECT_EQ(fabric_of(GarmentType::trousers, 0.2, {}), std::nullopt) << "most are woven";
    EXPECT_EQ(fabric_of(GarmentType::tshirt, 0, {}), std::nullopt) << "it is not too small";
    EXPECT_EQ(fabric_of(GarmentType::tshirt, 0.2, {}, Fabric::cotton), Fabric::cotton) << "the user says so";
    Parameters denim, drill;
    denim.recover.cloth.fabric = Fabric::denim;
    EXPECT_EQ(fabric_of(GarmentType::tshirt, 0.2, denim), std::nullopt);
    drill.recover.cloth.largest_stretch = 0.1;
    EXPECT_EQ(fabric_of(GarmentType::tshirt, 0.2, drill), std::nullopt) << "its figures are given";
}

TEST(UsualKnits, AreForgottenInAnotherWayOfWearing)
{
    Scene scene = tight_scene(1, 0.2);
    scene.fits.resize(1);
    scene.fits[0].type = GarmentType::tshirt;
    take_usual_knits(scene, {});
    ASSERT_TRUE(scene.garments[0].fabric);
    take_as_given(scene.garments[0]);
    EXPECT_FALSE(scene.garments[0].fabric);
    EXPECT_FALSE(scene.garments[0].fabric_is_guessed);
}

TEST(UsualKnits, AreNoReasonToWearWhatIsStretchedAllOver)
{
    Scene scene = tight_scene(1, 0.2);
    scene.recovered->loads = { { { "chest", 1, 0.2, 0 }, { "waist", 1, 0.2, 0 }, { "neck", 0.5, 0.1, 0 } } };
    EXPECT_FALSE(is_knit_stretched_all_over(scene)) << "its fabric was given";
    scene.garments[0].fabric_is_guessed = true;
    EXPECT_TRUE(is_knit_stretched_all_over(scene));
    scene.recovered->loads[0][0].stretch = 0.1;
    EXPECT_FALSE(is_knit_stretched_all_over(scene)) << "cotton gives as much at two of three parts";
}

/// A tube round the trunk that is too narrow for cotton at the waist alone, or everywhere.
Scene dressed_in_tube(double narrowest, bool is_narrow_everywhere, std::optional<Fabric> fabric = {})
{
    const fixtures::Person person = fixtures::capsule_person({ .arm_angle = 20 });
    TriangleMesh tube = fixtures::garment_round(
        person.skeleton, 0.01, [](const Vec3& p) { return p.y() > 0.7 && p.y() < 1.1 && std::abs(p.x()) < 0.26; });
    for (Eigen::Index v = 0; v < tube.positions.rows(); ++v) {
        const double from_waist = (tube.positions(v, 1) - 0.9) / 0.05,
                     factor = 1 - (1 - narrowest) * (is_narrow_everywhere ? 1 : std::exp(-from_waist * from_waist));
        tube.positions(v, 0) *= factor;
        tube.positions(v, 2) *= factor;
    }
    Scene scene;
    scene.body = make_body(person.mesh.positions, person.mesh.triangles);
    scene.garments = { { make_garment(tube.positions, tube.triangles), GarmentType::strapless, "tube.obj" } };
    scene.garments[0].fabric = fabric;
    Parameters parameters;
    parameters.recover.quality = Quality::draft;
    filter_of("dress").run(scene, parameters);
    return scene;
}

TEST(UsualKnits, LetAGarmentBeWornThatIsTooNarrowForCottonAtOnePlace)
{
    const Scene knitted = dressed_in_tube(0.84, false);
    EXPECT_EQ(outcome_of(*final_dressing(knitted)), Outcome::done);
    EXPECT_EQ(final_dressing(knitted)->fabrics, std::vector { Fabric::jersey });
    EXPECT_EQ(final_dressing(knitted)->guessed_fabrics, std::vector { true });
    const Scene woven = dressed_in_tube(0.84, false, Fabric::cotton);
    EXPECT_EQ(outcome_of(*final_dressing(woven)), Outcome::too_small);
    EXPECT_EQ(final_dressing(woven)->guessed_fabrics, std::vector { false });
}

/// A dressing whose garment, so far off the skin, ended below the left hip.
Dressing judged_below_hip(double ease)
{
    Scene scene = fitted_scene();
    const TriangleMesh skirt = fixtures::garment_round(fixtures::person_skeleton({ .arm_angle = 20 }), ease,
                                                       [](const Vec3& p) { return p.y() > 0.4 && p.y() < 1.1; });
    scene.garments[0].mesh = make_garment(skirt.positions, skirt.triangles);
    Dressing dressing;
    dressing.certified = true;
    dressing.fabric_stretches = { 0.2 };
    dressing.below_hips = { { lhipjoint } };
    judge_hips(scene, dressing);
    return dressing;
}

TEST(Enlarging, AGarmentBelowHipsForWhichItIsTooNarrowIsTooSmall)
{
    const Dressing narrow = judged_below_hip(-0.02), wide = judged_below_hip(0.02);
    EXPECT_FALSE(narrow.certified);
    ASSERT_EQ(narrow.too_tight.size(), 1);
    EXPECT_EQ(narrow.too_tight[0].part, "hips");
    EXPECT_GT(narrow.too_tight[0].enlargement, 0.05);
    EXPECT_TRUE(wide.certified) << "it hangs there as it is too large";
    EXPECT_TRUE(wide.too_tight.empty());
}

TEST(Enlarging, AGarmentThatIsFarTooNarrowIsMadeWiderBeforeItIsPutOn)
{
    Scene scene = fitted_scene();
    EXPECT_FALSE(widen_far_too_narrow(scene, {}, 1));
    const TriangleMesh narrow = fixtures::garment_round(fixtures::person_skeleton({ .arm_angle = 20 }), -0.035,
                                                        [](const Vec3& p) { return p.y() > 0.4 && p.y() < 1.1; });
    scene.garments[0].mesh = make_garment(narrow.positions, narrow.triangles);
    Scene slightly = scene;
    EXPECT_TRUE(widen_far_too_narrow(slightly, {}, 0.1));
    EXPECT_NEAR(largest_factor(slightly.garments[0].widening), 1.1, 1e-9) << "no more than is allowed";
    EXPECT_TRUE(widen_far_too_narrow(scene, {}, 1));
    EXPECT_GT(factor_of(scene.garments[0].widening, "hips"), 1.2);
    EXPECT_EQ(factor_of(scene.garments[0].widening, "left upper arm"), 1);
    const auto depth = [](const Positions& p) { return p.col(2).maxCoeff() - p.col(2).minCoeff(); };
    EXPECT_GT(depth(scene.garments[0].mesh.positions), 1.05 * depth(narrow.positions));
    take_as_given(scene.garments[0]);
    EXPECT_EQ(scene.garments[0].mesh.positions, narrow.positions);
}

TEST(Enlarging, AWiderGarmentIsFittedForTheSameWayOfWearing)
{
    Scene scene = fitted_scene();
    FitResult& fit = scene.fits[0];
    fit.front = -fit.front;
    fit.probability = 0.07;
    fit.rejected.resize(1);
    const FitResult before = fit;
    scene.garments[0].skipped = 1;
    ASSERT_TRUE(fit_again(scene, {}, {}));
    EXPECT_EQ(scene.fits[0].type, before.type);
    EXPECT_GT(scene.fits[0].front.dot(before.front), 0.9) << "back to front, as before";
    EXPECT_EQ(scene.fits[0].probability, before.probability);
    EXPECT_EQ(scene.fits[0].rejected.size(), 1);
    EXPECT_FALSE(scene.fits[0].front_given);
    EXPECT_EQ(scene.garments[0].type, GarmentType::automatic) << "is not given by the user";
    EXPECT_FALSE(scene.garments[0].front);
    EXPECT_EQ(scene.garments[0].skipped, 1);
}

TEST(Enlarging, AWiderGarmentThatIsFittedForAnotherWayOfWearingIsNotTaken)
{
    Scene scene = fitted_scene();
    scene.fits[0].covered = { upperneck };
    const Pose pose = scene.fits[0].pose;
    EXPECT_FALSE(fit_again(scene, {}, {}));
    EXPECT_TRUE(is_same(scene.fits[0].pose, pose));
    EXPECT_EQ(scene.fits[0].covered, std::vector<Bone> { upperneck });
}

}  // namespace
