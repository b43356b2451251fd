// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/warnings.h"

#include <gtest/gtest.h>

#include "fixtures.h"

namespace garmentfit {
namespace {

using Lines = std::vector<std::string>;

/// Two garments worn, no warning about either.
Scene worn_scene()
{
    Scene scene;
    scene.rig.emplace().side_confidence = 1;
    scene.fits.resize(2);
    for (FitResult& fit : scene.fits)
        fit.type_probability = 1;
    scene.draped.emplace().garments.resize(2);
    for (WornGarment& garment : scene.draped->garments)
        garment.positions.setZero(3, 3);
    return scene;
}

Lines warnings_of(const Scene& scene) { return warnings_about_scene(scene, { "skirt", "coat" }, set_by_name); }

TEST(Warnings, AreNoneWhereEverythingIsSure)
{
    EXPECT_EQ(warnings_of(worn_scene()), Lines());
    EXPECT_EQ(warnings_about_frame("man", { {}, 1, 1, "" }, "", set_by_name), Lines());
}

TEST(Warnings, SayWhichParameterSettlesThem)
{
    Scene scene = worn_scene();
    scene.rig->side_confidence = 0.1;
    scene.fits[1].type = GarmentType::coat;
    scene.fits[1].type_probability = 0.1;
    EXPECT_EQ(warnings_of(scene),
              (Lines { "which side of the body is left is guessed with low confidence; if it is wrong, set swap_sides",
                       "the type of coat is uncertain: coat (probability 10%); if it is wrong, set type" }));
    EXPECT_EQ(
        warnings_about_frame("coat", { {}, 0.1, 0.1, "it is wide" }, "garment_", set_by_name),
        (Lines { "the unit of coat is guessed with low confidence (it is wide); if it is wrong, set garment_unit",
                 "the up axis of coat is guessed with low confidence (it is wide); if it is wrong, set garment_up" }));
}

TEST(Warnings, SayThatASkeletonIsProbablyWrongWhereItIsHardlyAHumans)
{
    Scene scene = worn_scene();
    scene.rig->not_human = "the ratio trunk to leg is 2.64, a human has 0.40 to 1.25";
    scene.rig->human_probability = 0.34;
    EXPECT_EQ(warnings_of(scene),
              (Lines { "the body is far from human (probability 34%): the ratio trunk to leg is 2.64, a human has 0.40 "
                       "to 1.25; look at its joints, and correct them (joints) if they are wrong" }));
    scene.rig->human_probability = 4e-9;
    EXPECT_EQ(
        warnings_of(scene),
        (Lines { "the skeleton is probably wrong, as the body is hardly like a human (probability below 0.1%): the "
                 "ratio trunk to leg is 2.64, a human has 0.40 to 1.25; correct its joints (joints), or set "
                 "humanlike strict to have such bodies refused" }));
}

TEST(Warnings, SayThatABodyIsUpsideDownWhereItsFeetAreAboveItsHead)
{
    Scene scene;
    scene.rig = fixtures::simple_rig(fixtures::capsule_person());
    scene.rig->side_confidence = 1;
    EXPECT_EQ(warnings_about_rig(scene, set_by_name), Lines());
    Skeleton& skeleton = scene.rig->skeleton;
    skeleton.root.y() *= -1;
    for (Vec3& tail : skeleton.tails)
        tail.y() *= -1;
    for (Vec3& tip : skeleton.tips)
        tip.y() *= -1;
    EXPECT_EQ(warnings_about_rig(scene, set_by_name),
              (Lines { "the feet of the body are above its hips and its head is below; if it does not stand on its "
                       "head, set up" }));
}

TEST(Warnings, SayThatTheWayUpIsUncertain)
{
    Scene scene = worn_scene();
    scene.fits[0].up_probability = 0.5;
    EXPECT_EQ(warnings_of(scene),
              (Lines { "which end of skirt is up is uncertain (probability 50%); if it is worn upside down or on its "
                       "side, set garment_up" }));
}

TEST(Warnings, SayWhatWasLeftOutOfAGarment)
{
    Scene scene = worn_scene();
    scene.garments.resize(2);
    scene.draped->garments[0].left_out = { .solids = 1, .faces = 208 };
    scene.draped->garments[1].left_out = { .solids = 2, .lids = 1, .specks = 1, .backdrops = 2, .faces = 301 };
    EXPECT_EQ(
        warnings_of(scene),
        (Lines { "skirt has 1 solid inside (208 faces); taken for no cloth, left out, and drawn into one point of "
                 "the cloth",
                 "coat has 2 solids and 1 lid inside, and 1 speck far from the cloth, and 2 backdrops beside "
                 "it (301 faces); taken for no cloth, left out, and drawn into one point of the cloth" }));
}

TEST(Warnings, SayThatAnotherGarmentStandsBesideIt)
{
    Scene scene = worn_scene();
    scene.garments.resize(2);
    scene.draped->garments[0].left_out = { .garments = 1, .faces = 208 };
    EXPECT_EQ(
        warnings_of(scene),
        (Lines { "skirt has 1 other garment beside it; left out, and drawn into one point of the cloth; to dress in "
                 "another one, give it in a file of its own" }));
}

TEST(Warnings, SayThatAFrontIsUncertain)
{
    Scene scene = worn_scene();
    scene.fits[0].front_probability = 0.62;
    EXPECT_EQ(
        warnings_of(scene),
        (Lines {
            "the front of skirt is uncertain (probability 62%); if it is worn back to front, set garment_front" }));
}

TEST(Warnings, SayHowManyPiecesLieOnNoOther)
{
    Scene scene = worn_scene();
    scene.draped->garments[0].pieces = { 5, 2, 2, 0 };
    scene.draped->garments[1].pieces = { 5, 1, 1, 2 };
    EXPECT_EQ(warnings_of(scene),
              Lines { "coat has 5 pieces, of which 2 lie on no other; they are layers of their own" });
}

TEST(Warnings, SayThatAGarmentWasMadeSmaller)
{
    Scene scene = worn_scene();
    scene.draped->garments[0].size = 0.8;
    const Lines lines = warnings_of(scene);
    EXPECT_EQ(
        std::count(lines.begin(), lines.end(),
                   "skirt was made 20% smaller, as it slips off this body in the size guessed; to keep that, give "
                   "its unit"),
        1);
}

TEST(Warnings, SayThatAFabricWasGuessed)
{
    Scene scene = worn_scene();
    scene.draped->fabrics = { Fabric::jersey, Fabric::cotton };
    scene.draped->guessed_fabrics = { true, false };
    EXPECT_EQ(
        warnings_of(scene),
        (Lines { "skirt is too small in cotton, so it was taken to be of jersey, as most clothes of its type are; if "
                 "it is not, give its fabric" }));
}

TEST(Warnings, SayWhatCameOutOtherThanAskedFor)
{
    Scene scene = worn_scene();
    scene.draped->residual = { 0.35, 2 };
    scene.draped->garments.pop_back();
    scene.draped->garments[0].size = 1.08;
    scene.draped->garments[0].slipped = 0.214;
    scene.draped->off_shoulders = { { lclavicle } };
    scene.draped->below_hips = { { lhipjoint, rhipjoint } };
    scene.draped->garments[0].piece_shift = 0.12;
    EXPECT_EQ(
        warnings_of(scene),
        (Lines { "the cloth is not at rest: forces on it are out of balance by 35 % of its weight on the mean; "
                 "cloth that passes through itself, is far too tight, or has small pieces on it, such as buttons, may "
                 "have no rest, and quality draft looks for none",
                 "skirt was made 8% larger",
                 "a piece of skirt went 120 mm away from the cloth that it lay on; join its border to that cloth "
                 "in the garment's file",
                 "skirt slipped down by 214 mm: it is too wide for this body to stay where it is worn",
                 "skirt slipped off the left shoulder: it is too wide there for this body to stay where it is worn",
                 "skirt hangs below the hips, which it should cover: it does not stay on this body",
                 "coat was not put on, because the garments under it were not certified" }));
}

TEST(Warnings, SayWhereClothPressesTheSkinIn)
{
    Scene scene = worn_scene();
    scene.draped->held_back = { { "chest", 0.027 }, { "waist", 4e-4 } };
    scene.draped->certified = false;
    EXPECT_EQ(warnings_of(scene), Lines()) << "it is only held back";
    scene.draped->certified = true;
    EXPECT_EQ(warnings_of(scene),
              Lines { "cloth presses the skin in at chest (by 27 mm), waist (by 0.4 mm): the result is certified on "
                      "the body so pressed, and crosses the body as it was given there" });
}

TEST(Warnings, ForcesFarBeyondItsWeightAreNotCounted)
{
    Scene scene = worn_scene();
    scene.draped->residual = { 21281, 94944 };
    const Lines lines = warnings_of(scene);
    ASSERT_FALSE(lines.empty());
    EXPECT_NE(lines[0].find("by more than 10 times its weight on the mean"), std::string::npos) << lines[0];
}

TEST(Warnings, SayThatAGarmentTooSmallIsLeftOut)
{
    Scene scene = worn_scene();
    scene.draped->garments.pop_back();
    scene.draped->too_tight = { { 1, "hips", 0.1, 0.2 } };
    EXPECT_EQ(warnings_of(scene),
              (Lines { "coat is left out of the result: it is too small to go over body and garments under it" }));
}

TEST(Warnings, SayWhereClothIsOverstretched)
{
    Scene scene = worn_scene();
    scene.draped->overstretches = { { 0, 0.49, "" }, { 3, 17.6, "left forearm" } };
    EXPECT_EQ(warnings_of(scene),
              (Lines { "coat is overstretched: 3 edges by more than 50%, the most by 1760%, at left forearm" }));
}

TEST(Warnings, SayThatFramesAreMissing)
{
    Scene scene = worn_scene();
    scene.draped->frames_asked = 3;
    scene.draped->frames.resize(3);
    EXPECT_EQ(warnings_of(scene), Lines());
    scene.draped->frames.pop_back();
    EXPECT_EQ(warnings_of(scene), (Lines { "of 3 frames there are 2: frames that cannot be certified are left out" }));
}

TEST(Warnings, SayThatCrossingsAsGivenAreStillThere)
{
    Scene scene = worn_scene();
    scene.draped->garments[1].certificate.input_self_crossings = 9;
    EXPECT_EQ(warnings_of(scene), Lines()) << "all of them came apart";
    scene.draped->garments[1].certificate.kept_self_crossings = { { 0, 5 }, { 1, 7 } };
    EXPECT_EQ(
        warnings_of(scene),
        (Lines {
            "coat crossed itself as it was given, and could not be parted everywhere: 2 of 9 crossings are left" }));
}

}  // namespace
}  // namespace garmentfit
