// SPDX-License-Identifier: GPL-3.0-or-later
#include "other_wearings.h"

#include <vector>

#include <gtest/gtest.h>

namespace garmentfit {
namespace {

// A way of wearing a garment, and how dressing ends then.
struct Way {
    double probability = 0;
    End end = End::worn;
    Vec3 front = Vec3::UnitZ();
    std::vector<Bone> covered = { lfemur, rfemur };
    double size = 1;
};

FitResult fit_of(const Way& way)
{
    FitResult fit;
    fit.probability = way.probability;
    fit.front = way.front;
    fit.covered = way.covered;
    return fit;
}

void end_with(Scene& scene, End end)
{
    if (end == End::refused)
        return;
    Dressing dressing;
    dressing.garments.resize(scene.garments.size());
    dressing.overstretches.resize(scene.garments.size());
    dressing.certified = end == End::worn || end == End::torn_or_slipped;
    if (end == End::torn_or_slipped)
        dressing.garments[0].slipped = 1;
    if (end == End::too_small)
        dressing.too_tight = { { 0, "chest", 0.031, 0.034 } };
    scene.draped = dressing;
}

void make_larger(Scene& scene, double size)
{
    if (!scene.draped)
        return;
    scene.draped->garments[0].positions.setZero(3, 3);
    scene.draped->garments[0].size = size;
}

// The ways of the first garment, the most probable first.
struct Trial {
    std::vector<Way> ways;
    Scene scene = {};
    int fitted = 0, draped = 0;

    explicit Trial(std::vector<Way> of_first) : ways(std::move(of_first))
    {
        scene.garments.resize(2);
        scene.fits = { fit_of(ways[0]), {} };
        end_with(scene, ways[0].end);
        make_larger(scene, ways[0].size);
    }

    void run(std::size_t refused = 0)
    {
        const auto fit = [&](Scene& s) {
            ++fitted;
            if (s.garments[0].skipped >= int(ways.size()))
                throw InvalidInput("no other way");
            s.fits[0] = fit_of(ways[s.garments[0].skipped]);
        };
        const auto drape = [&](Scene& s) {
            ++draped;
            const End end = ways[s.garments[0].skipped].end;
            if (end == End::refused)
                throw RefusedGarment(0, "it lies across the bones");
            end_with(s, end);
            make_larger(s, ways[s.garments[0].skipped].size);
        };
        try_other_wearings(scene, { fit, drape }, refused, {});
    }

    double probability() const { return scene.fits[0].probability; }
};

/// One garment whose size is a guess, and how it ends; in its most probable unit it is twice as large.
struct SizeTrial {
    Scene scene = {};
    int fitted = 0;

    SizeTrial(End end, double size_in_unit)
    {
        scene.garments.resize(1);
        scene.garments[0].mesh.positions.setOnes(3, 3);
        scene.garments[0].size_in_unit = size_in_unit;
        scene.fits.resize(1);
        end_with(scene, end);
    }

    void run(End end)
    {
        const auto fit = [&](Scene&) { ++fitted; };
        try_size_in_unit(scene, { fit, [&](Scene& s) { end_with(s, end); } }, {});
    }
};

TEST(SizeInUnit, ReplacesAGuessAtWhichTheGarmentIsTooSmallWhereItIsWorn)
{
    SizeTrial trial(End::too_small, 2);
    trial.run(End::worn);
    EXPECT_EQ(trial.fitted, 1);
    EXPECT_TRUE(trial.scene.draped->certified);
    EXPECT_EQ(trial.scene.garments[0].share, 2);
    EXPECT_EQ(trial.scene.garments[0].mesh.positions(0, 0), 2);

    SizeTrial slipping(End::too_small, 2);
    slipping.run(End::torn_or_slipped);
    EXPECT_FALSE(slipping.scene.draped->certified) << "that was no better guess";
    EXPECT_EQ(slipping.scene.garments[0].share, 1);
    EXPECT_EQ(slipping.scene.garments[0].mesh.positions(0, 0), 1);
}

TEST(SizeInUnit, IsNotTriedWhereTheGarmentIsLargeEnoughOrWouldBeSmaller)
{
    SizeTrial worn(End::worn, 2), smaller(End::too_small, 0.5), has_unit(End::too_small, 1);
    for (SizeTrial* trial : { &worn, &smaller, &has_unit }) {
        trial->run(End::worn);
        EXPECT_EQ(trial->fitted, 0);
    }
}

/// A skirt whose file has no unit, how it ends, and how in each size that is tried.
struct SkirtOfAnySize {
    struct Attempt {
        End end = End::worn;
        double slipped = 0;  ///< m
        GarmentType type = GarmentType::skirt;
        double piece_shift = 0;  ///< m
    };
    Scene scene = {};
    std::size_t fitted = 0;

    explicit SkirtOfAnySize(const Attempt& first)
    {
        scene.garments.resize(1);
        scene.garments[0].mesh.positions.setOnes(3, 3);
        scene.garments[0].has_unit = false;
        scene.garments[0].skipped = 1;
        scene.fits.resize(1);
        scene.fits[0].type = GarmentType::skirt;
        end_as(scene, first);
    }

    static void end_as(Scene& s, const Attempt& attempt)
    {
        end_with(s, attempt.end);
        if (!s.draped)
            return;
        s.draped->garments[0].positions.setZero(3, 3);
        s.draped->garments[0].slipped = attempt.slipped;
        s.draped->garments[0].piece_shift = attempt.piece_shift;
    }

    /// @return the size it has in the end, as a share of the one guessed
    double size_after(const std::vector<Attempt>& attempts)
    {
        const auto fit = [&](Scene& s) { s.fits[0].type = attempts.at(fitted++).type; };
        const auto drape = [&](Scene& s) {
            end_as(s, attempts[fitted - 1]);
            if (!s.draped)
                throw RefusedGarment(0, "it lies across the bones");
        };
        try_other_sizes(scene, { fit, drape }, 0, {});
        EXPECT_EQ(scene.garments[0].share, scene.garments[0].mesh.positions(0, 0));
        return scene.garments[0].share;
    }
};

TEST(OtherSizes, AreLargerWhereAGarmentWithoutUnitIsTooSmallOrCannotBePutOn)
{
    for (const End end : { End::too_small, End::refused }) {
        SkirtOfAnySize skirt({ end });
        EXPECT_EQ(skirt.size_after({ { end }, { End::worn } }), 1.5);
        EXPECT_EQ(skirt.fitted, 2U);
        EXPECT_EQ(skirt.scene.garments[0].skipped, 0);
    }
}

TEST(OtherSizes, AreSmallerWhereItSlipsOff)
{
    SkirtOfAnySize skirt({ End::worn, 0.5 });
    EXPECT_EQ(skirt.size_after({ { End::worn, 0.01 } }), 0.8);
    EXPECT_EQ(skirt.scene.draped->garments[0].slipped, 0.01);
}

TEST(OtherSizes, AreNotTakenWhereItSinksLosesAPieceOrIsWornInAnotherWay)
{
    using Attempt = SkirtOfAnySize::Attempt;
    for (const Attempt& last : { Attempt { End::worn, 0.1 }, Attempt { End::worn, 0, GarmentType::vest },
                                 Attempt { End::worn, 0, GarmentType::skirt, 1 }, Attempt { End::not_certified } }) {
        SkirtOfAnySize skirt({ End::worn, 0.5 });
        EXPECT_EQ(skirt.size_after({ { End::too_small }, last }), 1);
        EXPECT_EQ(skirt.fitted, 2U);
        EXPECT_EQ(skirt.scene.draped->garments[0].slipped, 0.5);
    }
    SkirtOfAnySize refused({ End::refused });
    EXPECT_EQ(refused.size_after({ { End::worn, 0, GarmentType::dress } }), 1.25) << "there was no way before";
}

TEST(OtherSizes, AreNotTriedWhereTheFileHasAUnitOrTheGarmentIsWorn)
{
    SkirtOfAnySize has_unit({ End::too_small }), worn({ End::worn, 0.1 }), crosses({ End::not_certified });
    has_unit.scene.garments[0].has_unit = true;
    for (SkirtOfAnySize* skirt : { &has_unit, &worn, &crosses })
        EXPECT_EQ(skirt->size_after({}), 1);
}

TEST(OtherWearings, AreNotTriedWhereTheGarmentIsWorn)
{
    Trial trial({ { 0.5, End::worn }, { 0.5, End::worn } });
    trial.run();
    EXPECT_EQ(trial.fitted, 0);
}

TEST(OtherWearings, OfSmallProbabilityDoNotReplaceAGarmentThatIsTooSmall)
{
    Trial trial({ { 0.8, End::too_small }, { 0.2, End::worn, -Vec3::UnitZ() } });
    trial.run();
    EXPECT_EQ(trial.probability(), 0.8);
    EXPECT_EQ(trial.draped, 0) << "no end of it could be more plausible";
}

TEST(OtherWearings, ThatAreAboutAsProbableReplaceAGarmentThatIsTooSmall)
{
    Trial trial({ { 0.4, End::too_small }, { 0.38, End::worn, -Vec3::UnitZ() } });
    trial.run();
    EXPECT_EQ(trial.probability(), 0.38);
    ASSERT_EQ(trial.scene.fits[0].rejected.size(), 1u);
    EXPECT_EQ(trial.scene.fits[0].rejected[0].probability, 0.4);
}

TEST(OtherWearings, OnTheSameBonesAreTheSameWayUnderAnotherName)
{
    const std::vector<Bone> shirt { upperback, thorax }, dress { upperback, thorax, lfemur, rfemur };
    Trial trial({ { 0.8, End::too_small, Vec3::UnitZ(), shirt }, { 0.1, End::worn, Vec3::UnitZ(), dress } });
    trial.scene.fits[0].type = GarmentType::tshirt;
    trial.run();
    EXPECT_NEAR(trial.probability(), 0.9, 1e-12);
    EXPECT_EQ(trial.scene.fits[0].type, GarmentType::tshirt);
    EXPECT_EQ(trial.scene.fits[0].covered, dress);

    Trial turned({ { 0.8, End::too_small, Vec3::UnitZ(), shirt }, { 0.1, End::worn, -Vec3::UnitZ(), dress } });
    turned.run();
    EXPECT_EQ(turned.probability(), 0.8);
}

TEST(OtherWearings, ReplaceWhatCannotBeDrapedAlsoAmongSeveralGarments)
{
    Trial trial({ { 0.7, End::refused }, { 0.2, End::refused, -Vec3::UnitZ() }, { 0.1, End::worn, Vec3::UnitX() } });
    trial.run();
    EXPECT_EQ(trial.probability(), 0.1);
    EXPECT_EQ(trial.scene.fits[0].rejected.size(), 2u);

    Trial hopeless({ { 0.7, End::refused }, { 0.3, End::refused, -Vec3::UnitZ() } });
    hopeless.run();
    EXPECT_EQ(hopeless.probability(), 0.7);
    EXPECT_FALSE(hopeless.scene.draped);
}

TEST(OtherWearings, InTheSizeOfTheGarmentReplaceOneForWhichItIsMadeMuchLarger)
{
    const std::vector<Bone> shirt { upperback, thorax }, skirt { lfemur, rfemur };
    Trial trial({ { 0.56, End::worn, Vec3::UnitZ(), skirt, 1.72 }, { 0.3, End::worn, Vec3::UnitZ(), shirt, 1.1 } });
    trial.run();
    EXPECT_EQ(trial.probability(), 0.3);
    ASSERT_EQ(trial.scene.fits[0].rejected.size(), 1u);
    EXPECT_EQ(trial.scene.fits[0].rejected[0].reason, "it has to be 72% larger");

    Trial next_size({ { 0.56, End::worn, Vec3::UnitZ(), skirt, 1.15 }, { 0.3, End::worn, Vec3::UnitZ(), shirt } });
    next_size.run();
    EXPECT_EQ(next_size.fitted, 0) << "clothes of two sizes are worn alike";
}

TEST(OtherWearings, AreLessPlausibleTheLargerTheGarmentHasToBe)
{
    EXPECT_EQ(plausibility(0.5, End::worn, 1.2), 0.5);
    EXPECT_LT(plausibility(0.5, End::worn, 1.3), plausibility(0.5, End::worn, 1.2));
    EXPECT_LT(plausibility(0.5, End::worn, 1.7), 0.05 * 0.5);
}

TEST(OtherWearings, AreNotTriedWhereOnlyShortEdgesArePinched)
{
    Trial trial({ { 0.5, End::worn }, { 0.5, End::worn, -Vec3::UnitZ() } });
    Overstretch& stretch = trial.scene.draped->overstretches[0];
    stretch.largest = 2.1;
    stretch.longer = 0.004;
    trial.run();
    EXPECT_EQ(trial.draped, 0);
    stretch.longer = 0.04;
    trial.run();
    EXPECT_EQ(trial.draped, 1);
}

TEST(OtherWearings, ThatFellOffOrTornDoNotReplaceAMoreProbableOne)
{
    Trial trial({ { 0.5, End::too_small }, { 0.45, End::torn_or_slipped, -Vec3::UnitZ() } });
    trial.run();
    EXPECT_EQ(trial.probability(), 0.5);
    EXPECT_EQ(trial.draped, 1);
}

}  // namespace
}  // namespace garmentfit
