// SPDX-License-Identifier: GPL-3.0-or-later
#include "coverage.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "garmentfit/error.h"
#include "type_guess.h"

namespace {

using namespace garmentfit;

/// A ring about the y axis.
Opening opening_at(double height, double facing)
{
    Opening opening;
    opening.centre = { 0, height, 0 };
    opening.facing = { 0, facing, 0 };
    opening.rim = (Positions(4, 3) << 0.2, height, 0, 0, height, 0.2, -0.2, height, 0, 0, height, -0.2).finished();
    opening.low = opening.rim.colwise().minCoeff();
    opening.high = opening.rim.colwise().maxCoeff();
    opening.girth = opening.tube_girth = opening.tube_waist = 1;
    opening.tube_length = opening.piece_height = 0.5;
    return opening;
}

/// A sleeve that hangs beside the hem of k_tube and faces it, as draped sleeves do.
Opening cuff_at(double x, double tube_length)
{
    Opening cuff = opening_at(0, -1);
    cuff.centre.x() = x;
    cuff.facing = Vec3(x > 0 ? -0.3 : 0.3, -0.95, 0);
    cuff.rim = 0.2 * cuff.rim;
    cuff.rim.col(0).array() += x;
    cuff.low = cuff.rim.colwise().minCoeff();
    cuff.high = cuff.rim.colwise().maxCoeff();
    cuff.girth = cuff.tube_girth = cuff.tube_waist = 0.3;
    cuff.tube_length = tube_length;
    return cuff;
}

const std::vector<Opening> k_tube { opening_at(0, -1), opening_at(0.5, 1) };

std::vector<CoverageKind> kinds_of(GarmentType given, const std::vector<Opening>& openings)
{
    std::vector<CoverageKind> kinds;
    for (const Coverage& coverage : possible_coverages(given, openings)) {
        EXPECT_FALSE(is_coarse(coverage.type));
        EXPECT_FALSE(coverage.bones.empty());
        kinds.push_back(coverage.kind);
    }
    return kinds;
}

TEST(Coverage, NewTypesKeepTheNumbersOfTheOthers)
{
    EXPECT_EQ(int(GarmentType::suit), 13);
    EXPECT_EQ(garment_type_names().size(), std::size_t(GarmentType::whole) + 1);
    EXPECT_EQ(name_of(GarmentType::tanktop), "tanktop");
    EXPECT_EQ(name_of(GarmentType::overalls), "overalls");
    EXPECT_EQ(name_of(GarmentType::whole), "whole");
}

TEST(Coverage, AGivenTypeLeavesOnlyItsOwnBones)
{
    for (int t = 1; t <= int(GarmentType::whole); ++t) {
        const GarmentType type = GarmentType(t);
        if (is_coarse(type))
            continue;
        SCOPED_TRACE(name_of(type));
        const auto coverages = possible_coverages(type, k_tube);
        ASSERT_EQ(coverages.size(), 1u);
        EXPECT_EQ(coverages[0].type, type);
        const bool has_thighs = std::count(coverages[0].bones.begin(), coverages[0].bones.end(), lfemur) > 0;
        EXPECT_EQ(has_thighs, coverage_kind_of(type) != CoverageKind::top);
    }
}

TEST(Coverage, ForearmsAreBareInShortSleevesOfWhateverType)
{
    const auto covers_forearms = [](const std::vector<Opening>& openings) {
        const auto bones = possible_coverages(GarmentType::jacket, openings).front().bones;
        return std::count(bones.begin(), bones.end(), lradius) > 0;
    };
    const auto with_cuffs = [](std::vector<Opening> openings, double tube_length) {
        openings.push_back(cuff_at(-0.5, tube_length));
        openings.push_back(cuff_at(0.5, tube_length));
        return openings;
    };
    EXPECT_FALSE(covers_forearms(with_cuffs(k_tube, 0.15)));
    EXPECT_TRUE(covers_forearms(with_cuffs(k_tube, 0.45)));
    EXPECT_TRUE(covers_forearms(k_tube)) << "the type says so, and no sleeve is seen";
    EXPECT_TRUE(covers_forearms(with_cuffs(with_cuffs(k_tube, 0.1), 0.45))) << "slits in sleeves are no cuffs";
}

TEST(Coverage, CuffsArePairsWhereTheirSleevesAreAsWide)
{
    const auto type_with = [](double girth, double waist) {
        std::vector<Opening> openings = k_tube;
        openings.push_back(cuff_at(-0.5, 0.45));
        openings.push_back(cuff_at(0.5, 0.45));
        openings.back().girth = girth;
        openings.back().tube_waist = waist;
        return resolve_type(GarmentType::automatic, openings);
    };
    EXPECT_EQ(type_with(0.3, 0.3), GarmentType::longsleeve);
    EXPECT_EQ(type_with(0.55, 0.3), GarmentType::longsleeve) << "the edge of one is folded in";
    EXPECT_NE(type_with(0.55, 0.55), GarmentType::longsleeve) << "it is another tube";
}

TEST(Coverage, ACoarseWordLeavesTheKindsOfItsGroup)
{
    using enum CoverageKind;
    EXPECT_EQ(kinds_of(GarmentType::automatic, k_tube), (std::vector { skirt, top, legs, dress, jumpsuit, top }));
    EXPECT_EQ(kinds_of(GarmentType::top, k_tube), (std::vector { top, top })) << "with and without shoulders";
    EXPECT_EQ(kinds_of(GarmentType::bottom, k_tube), (std::vector { skirt, legs }));
    EXPECT_EQ(kinds_of(GarmentType::whole, k_tube), (std::vector { dress, jumpsuit }));
}

TEST(Coverage, OnlyTheGuessOfTheShapeCountsAsGuessed)
{
    EXPECT_TRUE(possible_coverages(GarmentType::bottom, k_tube)[0].is_guessed);
    EXPECT_FALSE(possible_coverages(GarmentType::top, k_tube)[0].is_guessed);
}

TEST(Coverage, OnlyAGivenNameIsCertain)
{
    EXPECT_EQ(possible_coverages(GarmentType::skirt, k_tube)[0].name_probability, 1);
    for (const Coverage& coverage : possible_coverages(GarmentType::automatic, k_tube)) {
        EXPECT_LT(coverage.name_probability, 1);
        EXPECT_GT(coverage.name_probability, 0.95);  // else nothing is said with more than 0.9
    }
}

TEST(Coverage, OneOpeningNeedsAWordAboutTheType)
{
    const std::vector<Opening> one { opening_at(0, -1) };
    EXPECT_THROW(possible_coverages(GarmentType::automatic, one), InvalidInput);
    EXPECT_THROW(resolve_type(GarmentType::automatic, one), InvalidInput);
    EXPECT_EQ(kinds_of(GarmentType::top, one), (std::vector { CoverageKind::top }));
}

TEST(Coverage, ACoarseWordIsResolvedToATypeOfItsGroup)
{
    EXPECT_EQ(resolve_type(GarmentType::automatic, k_tube), GarmentType::skirt);
    EXPECT_EQ(resolve_type(GarmentType::bottom, k_tube), GarmentType::skirt);
    EXPECT_EQ(resolve_type(GarmentType::top, k_tube), GarmentType::vest);
    EXPECT_EQ(resolve_type(GarmentType::whole, k_tube), GarmentType::dress);
}

TEST(Coverage, TrousersThatLeaveTheShinsUncoveredAreShorts)
{
    EXPECT_EQ(type_when_worn(GarmentType::trousers, { lfemur, rfemur }), GarmentType::shorts);
    EXPECT_EQ(type_when_worn(GarmentType::trousers, { lfemur, rfemur, ltibia }), GarmentType::trousers);
    EXPECT_EQ(type_when_worn(GarmentType::skirt, { lfemur, rfemur }), GarmentType::skirt);
}

TEST(Coverage, LongSleevesThatHangBesideTheHemAreSleeves)
{
    const auto holds_arms = [](double distance, double tube_length) {
        std::vector<Opening> openings = k_tube;
        openings.push_back(cuff_at(-distance / 2, tube_length));
        openings.push_back(cuff_at(distance / 2, tube_length));
        const std::vector<Bone> bones = possible_coverages(GarmentType::automatic, openings)[0].bones;
        return std::count(bones.begin(), bones.end(), lradius) > 0;
    };
    constexpr double hem = 0.4;
    EXPECT_TRUE(holds_arms(1.3 * hem, 0.45));
    EXPECT_FALSE(holds_arms(1.3 * hem, 0.1)) << "short tubes may be anything";
    EXPECT_FALSE(holds_arms(0.9 * hem, 0.45)) << "legs hang below the waist, not beside it";
}

// A solid hoodie with its arms on its trunk: its sleeves are tubes only near the cuffs.
TEST(Coverage, ShortTubesWhollyBesideTheHemAreSleeves)
{
    const auto has_arms = [](double distance, double tube_length, std::vector<Opening> openings) {
        openings.push_back(cuff_at(-distance / 2, tube_length));
        openings.push_back(cuff_at(distance / 2, tube_length));
        return cues_of(openings).has_arms;
    };
    constexpr double hem = 0.4;
    EXPECT_TRUE(has_arms(1.3 * hem, 0.14, k_tube));
    EXPECT_FALSE(has_arms(1.1 * hem, 0.14, k_tube)) << "they overlap the hem";
    EXPECT_FALSE(has_arms(1.3 * hem, 0.05, k_tube)) << "hardly a tube";
    EXPECT_FALSE(has_arms(1.3 * hem, 0.14, { opening_at(0.5, 1) })) << "trousers have no hem between their legs";
}

// A shirt modelled with one arm hanging and the other bent, its hand in front of the belly.
TEST(Coverage, SleevesOfAPosedWearerAreSleeves)
{
    const auto posed = [](std::vector<Opening> openings, double tube_length) {
        Opening hanging = cuff_at(-0.3, tube_length), bent = cuff_at(0, tube_length);
        for (Opening* cuff : { &hanging, &bent })
            cuff->tube_end = Vec3(cuff == &bent ? 0.22 : -0.22, 0.42, 0);
        bent.centre = Vec3(0.05, 0.25, 0.3);
        bent.facing = Vec3(-0.6, 0, 0.8);
        bent.rim.rowwise() += bent.centre.transpose();
        bent.low = bent.rim.colwise().minCoeff();
        bent.high = bent.rim.colwise().maxCoeff();
        openings.insert(openings.end(), { hanging, bent });
        return openings;
    };
    const auto has_arms = [](const std::vector<Opening>& openings) { return cues_of(openings).has_arms; };
    EXPECT_TRUE(has_arms(posed(k_tube, 0.45)));
    EXPECT_FALSE(has_arms(posed(k_tube, 0.1))) << "short tubes may be anything";
    EXPECT_FALSE(has_arms(posed({ opening_at(0.5, 1) }, 0.45))) << "trousers with one leg lifted have a waist only";
    Opening front = opening_at(0.25, 0);
    front.low.y() = 0;
    front.high.y() = 0.5;
    EXPECT_TRUE(has_arms(posed({ front }, 0.45))) << "an open front is neck and hem";
    const Vec3 across = cues_of(posed(k_tube, 0.45)).across.normalized();
    EXPECT_GT(std::abs(across.x()), 0.99) << "from shoulder to shoulder, wherever the hands are";
}

TEST(Coverage, ATubeMayBeATopThatLeavesTheShouldersBare)
{
    const auto may_be_strapless = [](GarmentType given, const std::vector<Opening>& openings) {
        const std::vector<Coverage> coverages = possible_coverages(given, openings);
        return std::any_of(coverages.begin(), coverages.end(), [](const Coverage& coverage) {
            return coverage.type == GarmentType::strapless && coverage.kind == CoverageKind::top
                && std::count(coverage.bones.begin(), coverage.bones.end(), lclavicle) == 0;
        });
    };
    EXPECT_TRUE(may_be_strapless(GarmentType::automatic, k_tube));
    EXPECT_TRUE(may_be_strapless(GarmentType::top, k_tube));
    EXPECT_FALSE(may_be_strapless(GarmentType::bottom, k_tube));
    EXPECT_FALSE(may_be_strapless(GarmentType::vest, k_tube));
    std::vector<Opening> with_arms = k_tube;
    with_arms.push_back(cuff_at(-0.5, 0.45));
    with_arms.push_back(cuff_at(0.5, 0.45));
    EXPECT_FALSE(may_be_strapless(GarmentType::automatic, with_arms));
}

TEST(Coverage, DressesWithoutOpeningsForArmsLeaveTheShouldersBare)
{
    const auto covers_shoulders = [](GarmentType given, const std::vector<Opening>& openings, CoverageKind kind) {
        for (const Coverage& coverage : possible_coverages(given, openings))
            if (coverage.kind == kind)
                return std::count(coverage.bones.begin(), coverage.bones.end(), lclavicle) > 0;
        ADD_FAILURE() << "no such coverage";
        return false;
    };
    std::vector<Opening> with_arms = k_tube;
    with_arms.push_back(cuff_at(-0.5, 0.45));
    with_arms.push_back(cuff_at(0.5, 0.45));
    for (const GarmentType given : { GarmentType::dress, GarmentType::automatic }) {
        EXPECT_FALSE(covers_shoulders(given, k_tube, CoverageKind::dress));
        EXPECT_TRUE(covers_shoulders(given, with_arms, CoverageKind::dress));
    }
    EXPECT_FALSE(covers_shoulders(GarmentType::automatic, k_tube, CoverageKind::jumpsuit));
    EXPECT_TRUE(covers_shoulders(GarmentType::automatic, k_tube, CoverageKind::top)) << "a poncho";
}

}  // namespace
