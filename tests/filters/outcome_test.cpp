// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/outcome.h"

#include <gtest/gtest.h>

namespace garmentfit {
namespace {

WornGarment clean_garment() { return { {}, {}, {} }; }

/// One garment draped, clean and in place.
Scene draped_scene()
{
    Scene scene;
    scene.draped.emplace();
    scene.draped->garments = { clean_garment() };
    scene.draped->certified = true;
    return scene;
}

TEST(DressingOutcome, NamesThePartsAtWhichAGarmentIsTooSmall)
{
    Scene scene = draped_scene();
    scene.draped->certified = false;
    scene.draped->scale_reached = 0.876;
    scene.draped->too_tight = { { 0, "chest", 0.031, 0.034 } };
    EXPECT_EQ(outcome_of(*final_dressing(scene)), Outcome::too_small);
    EXPECT_EQ(
        explain(*final_dressing(scene), { "coat" }),
        "coat is too small: it lacks 31 mm of girth at chest; a body of 87% of the thickness would fit; a garment 4% "
        "larger would not be stretched there; in fleece, which gives 18%, it would do");
}

TEST(DressingOutcome, TellsLengthsInTheUnitOfTheFile)
{
    Scene scene = draped_scene();
    scene.draped->certified = false;
    scene.draped->scale_reached = 0.876;
    scene.draped->too_tight = { { 0, "chest", 0.031, 0.034 } };
    scene.draped->unit = { 0.1, "dm" };
    EXPECT_NE(explain(*final_dressing(scene), { "coat" }).find("it lacks 0.31 dm of girth"), std::string::npos);
}

TEST(DressingOutcome, NamesTheGarmentThatIsTightestAndItsOwnParts)
{
    Scene scene = draped_scene();
    scene.draped->certified = false;
    scene.draped->too_tight = { { 1, "chest", 0.031, 0.034 }, { 0, "waist", 0.02, 0.5 }, { 1, "waist", 0.01, 0.04 } };
    EXPECT_EQ(explain(*final_dressing(scene), { "coat", "shirt" }),
              "shirt is too small for the input pose: it lacks 31 mm of girth at chest, 10 mm of girth at waist; a "
              "garment 4% "
              "larger would not be stretched there; in fleece, which gives 18%, it would do");
}

TEST(DressingOutcome, OfTimeThatRanOutIsNoGarmentThatIsTooSmall)
{
    Scene scene = draped_scene();
    scene.draped->certified = false;
    scene.draped->scale_reached = 0.612;
    scene.draped->out_of_time = Stage::drape;
    EXPECT_EQ(outcome_of(*final_dressing(scene)), Outcome::not_certified);
    EXPECT_EQ(explain(*final_dressing(scene), { "coat" }),
              "coat could not be certified: the time limit was reached while draping, with the body at 61% of its "
              "size; give more as time_limit, or 0 for no limit");
    scene.draped->scale_reached = 1;
    scene.draped->pose_reached = 0.4;
    scene.draped->out_of_time = Stage::recover;
    EXPECT_EQ(explain(*final_dressing(scene), { "coat" }),
              "coat could not be certified: the time limit was reached while recovering the pose, at 40% of the path "
              "between two poses; give more as time_limit, or 0 for no limit");
    scene.draped->pose_reached = 1;
    scene.draped->too_tight = { { 0, "chest", 0.163, 0.44 } };  // of cloth that was still on its way
    EXPECT_EQ(outcome_of(*final_dressing(scene)), Outcome::not_certified);
    EXPECT_EQ(explain(*final_dressing(scene), { "coat" }),
              "coat could not be certified: the time limit was reached while recovering the pose; give more as "
              "time_limit, or 0 for no limit");
}

TEST(DressingOutcome, CountsCrossingsWhereCleanlinessWasLost)
{
    Scene scene = draped_scene();
    scene.draped->certified = false;
    scene.draped->garments[0].certificate.body_crossings = 3;
    EXPECT_EQ(outcome_of(*final_dressing(scene)), Outcome::not_certified);
    EXPECT_EQ(explain(*final_dressing(scene), { "coat" }).substr(0, 51),
              "coat could not be certified: 3 crossings with the b");
}

TEST(DressingOutcome, AGarmentWhoseStandInIsCleanGoesOn)
{
    Scene scene = draped_scene();
    EXPECT_TRUE(all_put_on(scene));
    WornGarment& worn = scene.draped->garments[0];
    worn.certificate.self_crossings = 2;
    EXPECT_FALSE(all_put_on(scene));
    worn.stand_in = WornStandIn { worn.rest, worn.positions, true };
    EXPECT_TRUE(all_put_on(scene)) << "it follows to the input pose, where it may be clean";
    worn.stand_in->is_clean = false;
    EXPECT_FALSE(all_put_on(scene));
}

TEST(DressingOutcome, ComesFromThePoseReachedLast)
{
    Scene scene = draped_scene();
    scene.recovered = scene.draped;
    scene.recovered->certified = false;
    scene.recovered->pose_reached = 0.999;
    EXPECT_EQ(explain(*final_dressing(scene), { "coat" }),
              "coat could not be certified: the body stopped at 99% of the path between two poses; give a wider "
              "garment, or a pose with more space between arms, legs and trunk");
}

TEST(DressingOutcome, SaysWhereTheBodyItselfLeavesNoSpace)
{
    Scene scene = draped_scene();
    scene.draped->certified = false;
    scene.draped->held_back = { { "chest", 0.028 } };
    scene.draped->overlaps = { { "chest", "left upper arm", 0.027 }, { "chest", "right upper arm", 0.026 } };
    const std::string why
        = "coat could not be certified: parts of the body are not in their places; too little space for the cloth "
          "at chest (held back by 28 mm); the body crosses itself, and no cloth fits between chest and left upper arm "
          "(27 mm deep), chest and right upper arm (26 mm deep); give a wider garment, ";
    EXPECT_EQ(explain(*final_dressing(scene), { "coat" }),
              why + "a pose with more space between arms, legs and trunk, or 0.04 m as press: the skin gives way then");
    scene.draped->to_human_size = 10;  // more than may be asked for
    EXPECT_EQ(explain(*final_dressing(scene), { "coat" }),
              why + "or a pose with more space between arms, legs and trunk");
}

TEST(DressingOutcome, OffersPressWhereAGarmentIsTooSmallBecauseTheBodyCrossesItself)
{
    Scene scene = draped_scene();
    scene.draped->certified = false;
    scene.draped->too_tight = { { 0, "right shoulder", 0.083, 0.17 } };
    scene.draped->held_back = { { "chest", 0.028 } };
    EXPECT_EQ(explain(*final_dressing(scene), { "coat" }).find("press"), std::string::npos);
    scene.draped->overlaps = { { "chest", "right upper arm", 0.027 } };
    const std::string text = explain(*final_dressing(scene), { "coat" });
    EXPECT_NE(text.find("too small"), std::string::npos) << text;
    EXPECT_NE(text.find("with 0.04 m as press the skin gives way there"), std::string::npos) << text;
}

TEST(DressingOutcome, TellsCrossingsThatTheGarmentWasGivenWithFromNewOnes)
{
    WornGarment garment = clean_garment();
    garment.certificate.min_distance = 1e-3;
    EXPECT_EQ(in_one_line("coat", GarmentType::coat, garment),
              "coat (coat): 0 crossings, minimum distance 1 mm, strain 0% at the 95th percentile");
    garment.certificate.kept_self_crossings = { { 0, 5 }, { 1, 7 } };
    EXPECT_EQ(in_one_line("coat", GarmentType::coat, garment),
              "coat (coat): 0 new crossings, 2 with itself kept as given, minimum distance 1 mm, strain 0% at the 95th "
              "percentile");
}

TEST(DressingOutcome, IsOfPositionsAsTheyAreKept)
{
    Dressing dressing;
    const Positions triangle = (Positions(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished();
    const Triangles face = (Triangles(1, 3) << 0, 1, 2).finished();
    dressing.body = triangle;
    dressing.garments = { { { triangle, face }, triangle.rowwise() + Eigen::RowVector3d(0, 0, 0.1), {} } };
    dressing.certified = true;
    Positions kept = triangle.rowwise() + Eigen::RowVector3d(0.1, 0.1, 0.1);
    kept(2, 2) = -0.1;
    certify_as_kept(dressing, face, { kept });
    EXPECT_EQ(dressing.garments[0].positions, kept);
    EXPECT_GT(dressing.garments[0].certificate.body_crossings, 0);
    EXPECT_FALSE(dressing.certified);
}

}  // namespace
}  // namespace garmentfit
