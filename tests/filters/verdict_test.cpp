// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/verdict.h"

#include <gtest/gtest.h>

#include "garmentfit/filters/outcome.h"

namespace garmentfit {
namespace {

/// A garment of jersey, which gives 35 %, worn round chest and waist; both have 5 % of ease and no stretch.
Dressing worn()
{
    Dressing dressing;
    dressing.certified = true;
    dressing.garments = { { {}, Positions::Zero(1, 3), {} } };
    dressing.girths = { { { "chest", 1.0, 1.05 }, { "waist", 0.8, 0.84 } } };
    dressing.loads = { { { "chest", 1.05, 0, 0 }, { "waist", 0.84, 0, 0 } } };
    dressing.fabrics = { Fabric::jersey };
    dressing.fabric_stretches = { 0.35 };
    return dressing;
}

TEST(FitVerdict, FitsBetweenTightAndRoomy)
{
    const auto verdict = fit_verdict(worn(), 0);
    ASSERT_TRUE(verdict);
    EXPECT_EQ(verdict->verdict, Verdict::fits);
    ASSERT_EQ(verdict->places.size(), 2u);
    EXPECT_EQ(verdict->places[1].place, "waist");
    EXPECT_EQ(verdict_in_words(worn(), 0), ", fits");
}

TEST(FitVerdict, IsRoomyOnlyWhereAllPlacesAre)
{
    Dressing dressing = worn();
    dressing.girths[0][0].garment = 1.2;
    EXPECT_EQ(fit_verdict(dressing, 0)->verdict, Verdict::fits);
    EXPECT_EQ(fit_verdict(dressing, 0)->places[0].verdict, Verdict::roomy);
    dressing.girths[0][1].garment = 1.0;
    EXPECT_EQ(fit_verdict(dressing, 0)->verdict, Verdict::roomy);
}

TEST(FitVerdict, IsTightByPressureOrByWhatTheFabricGives)
{
    Dressing pressed = worn(), stretched = worn();
    pressed.loads[0][1].pressure = 2000;
    EXPECT_EQ(fit_verdict(pressed, 0)->verdict, Verdict::tight);
    EXPECT_EQ(fit_verdict(pressed, 0)->places[1].verdict, Verdict::tight);
    stretched.loads[0][0].stretch = 0.16;
    EXPECT_EQ(fit_verdict(stretched, 0)->verdict, Verdict::fits) << "less than half of 35 %";
    stretched.loads[0][0].stretch = 0.2;
    EXPECT_EQ(fit_verdict(stretched, 0)->verdict, Verdict::tight);
    EXPECT_EQ(outcome_of(stretched), Outcome::done) << "tight is not too small";
}

TEST(FitVerdict, NamesTheFabricInWhichASmallGarmentWouldDo)
{
    Dressing dressing = worn();
    dressing.certified = false;
    dressing.fabrics = { Fabric::cotton };
    dressing.fabric_stretches = { 0.15 };
    dressing.too_tight = { { 0, "chest", 0.21, 0.27 } };
    const auto verdict = fit_verdict(dressing, 0);
    EXPECT_EQ(verdict->verdict, Verdict::too_small);
    EXPECT_EQ(verdict->places[0].verdict, Verdict::too_small);
    EXPECT_EQ(verdict->places[1].verdict, Verdict::fits);
    EXPECT_EQ(verdict->would_do, Fabric::jersey) << "the least stretchy that gives 27 %";
    EXPECT_NE(explain(dressing, { "top" }).find("in jersey, which gives 35%, it would do"), std::string::npos);
    dressing.too_tight[0].enlargement = 0.9;
    EXPECT_FALSE(fit_verdict(dressing, 0)->would_do);
}

TEST(FitVerdict, IsTooLargeWhereItSlippedDown)
{
    Dressing dressing = worn();
    dressing.garments[0].slipped = 0.3;
    EXPECT_EQ(fit_verdict(dressing, 0)->verdict, Verdict::too_large);
}

TEST(FitVerdict, IsTooLargeWhereItSlippedOffAShoulder)
{
    Dressing dressing = worn();
    dressing.off_shoulders = { { rclavicle } };
    EXPECT_EQ(fit_verdict(dressing, 0)->verdict, Verdict::too_large);
}

TEST(FitVerdict, IsTooLargeWhereItHangsBelowAHip)
{
    Dressing dressing = worn();
    dressing.below_hips = { { lhipjoint } };
    EXPECT_EQ(fit_verdict(dressing, 0)->verdict, Verdict::too_large);
}

TEST(FitVerdict, FallenOffIsWhatLiesBelowTheBody)
{
    Dressing dressing = worn();
    dressing.body = Positions::Zero(1, 3);
    dressing.garments[0].positions = Positions::Constant(1, 3, -0.1);
    EXPECT_TRUE(has_fallen_off(dressing, 0));
    dressing.certified = false;
    EXPECT_EQ(outcome_of(dressing), Outcome::not_certified);
    EXPECT_NE(explain(dressing, { "top" }).find("it fell off the body"), std::string::npos);
    dressing.body(0, 1) = -0.2;
    EXPECT_FALSE(has_fallen_off(dressing, 0));
}

TEST(FitVerdict, OfSpikesIsNeverTooSmall)
{
    Dressing small = worn();
    small.certified = false;
    small.scale_reached = 0.8;
    small.too_tight = { { 0, "chest", 0.21, 0.27 } };
    EXPECT_EQ(outcome_of(small), Outcome::too_small);
    Dressing body = small, cloth = small;
    body.spiked_share = 0.02;
    body.spikes = { 400, 5, "left thigh" };
    EXPECT_EQ(outcome_of(body), Outcome::not_certified);
    EXPECT_EQ(explain(body, { "top" }),
              "top could not be certified: it holds parts of the body far from where they belong, at left thigh");
    Dressing strand = small;
    strand.overstretches = { { 3, 200, "right forearm", 0.5, 0.3 } };
    EXPECT_EQ(outcome_of(strand), Outcome::not_certified);
    EXPECT_EQ(explain(strand, { "top" }),
              "top could not be certified: its cloth is drawn out to several times its length, so it is caught");
    Dressing web = worn();
    web.overstretches = { { 400, 3, "right forearm", 0.5, 0.05, 0.03 } };
    EXPECT_TRUE(ends_in_spikes(web, 0));
    web.too_tight = small.too_tight;
    EXPECT_FALSE(ends_in_spikes(web, 0)) << "it is too small";
    web.too_tight.clear();
    web.overstretches[0].gained = 0.01;
    EXPECT_FALSE(ends_in_spikes(web, 0));
    cloth.garments[0].certificate.strain.p95 = 2.5;
    EXPECT_EQ(outcome_of(cloth), Outcome::not_certified);
    EXPECT_FALSE(is_too_small(cloth, 0));
}

TEST(FitVerdict, IsThereForGarmentsThatAreWornOrTooSmallForThat)
{
    Dressing dressing = worn();
    dressing.garments.resize(2);
    EXPECT_FALSE(fit_verdict(dressing, 1));
    dressing.outermost = 1;
    dressing.scale_reached = 0.7;
    ASSERT_TRUE(fit_verdict(dressing, 1));
    EXPECT_EQ(fit_verdict(dressing, 1)->verdict, Verdict::too_small);
}

}  // namespace
}  // namespace garmentfit
