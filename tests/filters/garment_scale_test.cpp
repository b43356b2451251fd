// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "garment_scale.h"
#include "garmentfit/filters/body_scale.h"
#include "garmentfit/filters/frame_choice.h"
#include "garmentfit/filters/warnings.h"

#include "fixtures.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

constexpr PersonOptions k_person { .arm_angle = 40 };

const TriangleMesh& shirt()
{
    static const TriangleMesh mesh = [] {
        const Skeleton s = person_skeleton(k_person);
        const double cuff = std::abs(s.tail(lradius).x()) - 0.03;
        return garment_round(s, 0.03,
                             [&](const Vec3& p) { return p.y() > 0.95 && p.y() < 1.47 && std::abs(p.x()) < cuff; });
    }();
    return mesh;
}

double body_stature()
{
    static const double stature = [] {
        const Person person = capsule_person(k_person);
        return stature_of(make_body(person.mesh.positions, person.mesh.triangles));
    }();
    return stature;
}

/// Of the shirt, its coordinates multiplied by `size`, with a body in metres.
FrameGuess guess_of(double size, const GarmentChoice& choice = {}, double body = 1)
{
    return garment_frame(size * shirt().positions, shirt().triangles, { body }, choice, body * body_stature());
}

TEST(GarmentScale, AGarmentWithAUnitKeepsItsSize)
{
    for (const double metres : { 1.0, 0.01, 0.001 }) {
        const FrameGuess guess = guess_of(1 / metres);
        EXPECT_EQ(guess.frame.metres_per_unit, metres) << guess.why;
        EXPECT_EQ(guess.scale, 1);
        EXPECT_TRUE(guess.frame.has_unit);
        EXPECT_GT(guess.scale_probability, 0.8) << guess.why;
    }
}

// Two metres from cuff to cuff are too wide for most shirts, and usual for models that were scaled to two units.
TEST(GarmentScale, AGarmentOfExactlyTwoUnitsHasHardlyAUnit)
{
    const double longest = extents_of(shirt().positions, shirt().triangles).maxCoeff();
    const FrameGuess near = guess_of(2.02 / longest), exact = guess_of(2 / longest);
    EXPECT_NEAR(exact.frame.metres_per_unit, longest / 2, 0.15 * longest / 2) << exact.why;
    EXPECT_GT(exact.scale_probability, near.scale_probability);
    GarmentChoice in_metres;
    in_metres.unit = "m";
    EXPECT_EQ(guess_of(2 / longest, in_metres).frame.metres_per_unit, 1);
}

// The tallest people are taller than this body by a tenth, and clothes are made a little larger as a style.
TEST(GarmentScale, AGarmentForSomebodyTallerThanPeopleAreHasHardlyAUnit)
{
    EXPECT_EQ(guess_of(1.3).frame.metres_per_unit, 1);
    EXPECT_LT(guess_of(1.3).scale_probability, guess_of(1.1).scale_probability);
    EXPECT_FALSE(guess_of(1.6).frame.has_unit);
    const FrameGuess adults = garment_frame(shirt().positions, shirt().triangles, { 1 }, {}, 1.3);
    EXPECT_EQ(adults.frame.metres_per_unit, 1) << "on a child of 1.3 m: " << adults.why;
}

// A body in decimetres, a garment in metres: read in decimetres, no opening is as large as a body's.
TEST(GarmentScale, AGarmentOfAnotherUnitThanTheBodyIsRead)
{
    for (const double body : { 0.1, 0.01, 0.001 }) {
        const FrameGuess guess = garment_frame(shirt().positions, shirt().triangles, { body }, {}, body_stature());
        EXPECT_NEAR(guess.frame.metres_per_unit, 1, 0.25) << body << ": " << guess.why;
    }
}

// Five units wide: in decimetres it is for somebody half as tall.
TEST(GarmentScale, AFormatWithAUnitDoesNotTakeThatOfTheBody)
{
    const double size = 5.2;
    GarmentChoice in_metres;
    in_metres.usual_unit = 1;
    const auto guess = [&](const GarmentChoice& choice) {
        return garment_frame(size * shirt().positions, shirt().triangles, { 0.1 }, choice, body_stature());
    };
    EXPECT_EQ(guess({}).frame.metres_per_unit, 0.1) << guess({}).why;
    EXPECT_NEAR(size * guess(in_metres).frame.metres_per_unit, 1, 0.25) << guess(in_metres).why;
    EXPECT_FALSE(guess(in_metres).frame.has_unit);
}

TEST(GarmentScale, ClothesOfOtherPeopleKeepTheirSize)
{
    for (const double size : { 0.7, 0.85, 1.15, 1.3 })
        EXPECT_EQ(guess_of(size).scale, 1) << size;
}

TEST(GarmentScale, AGarmentOfNormalisedSizeFitsTheBody)
{
    for (const double size : { 1.9, 2.1, 2.6, 17.0, 19.0, 1e-4, 1e5 }) {
        const FrameGuess guess = guess_of(size);
        EXPECT_NEAR(size * guess.frame.metres_per_unit, 1, 0.25) << size << ": " << guess.why;
        EXPECT_FALSE(guess.frame.has_unit);
        EXPECT_GT(guess.scale_probability, 0.5);
    }
}

// It may be as large as the body needs it, then.
TEST(GarmentScale, AGarmentHasAUnitOnlyIfThatIsProbable)
{
    int doubtful = 0;
    for (double size = 0.6; size < 1.5; size += 0.05)
        if (const FrameGuess guess = guess_of(size); guess.scale == 1) {
            EXPECT_EQ(guess.frame.has_unit, guess.scale_probability >= 0.8) << size << ": " << guess.scale_probability;
            doubtful += !guess.frame.has_unit;
        }
    EXPECT_GT(doubtful, 0);
}

// Where the unit has lost by little, it may be the right one after all.
TEST(GarmentScale, AGuessTellsTheSizeInTheMostProbableUnit)
{
    int told = 0;
    for (double size = 1; size < 2.5; size += 0.05)
        if (const Frame frame = guess_of(size).frame; frame.size_in_unit != 1) {
            EXPECT_FALSE(frame.has_unit) << size;
            const double unit = frame.metres_per_unit * frame.size_in_unit;
            EXPECT_NEAR(unit / nearest_unit(unit), 1, 1e-9) << size;
            ++told;
        }
    EXPECT_GT(told, 0);
    EXPECT_EQ(guess_of(17).frame.size_in_unit, 1) << "in no unit has it a size that anybody wears";
}

TEST(GarmentScale, AScaleThatTheUserGivesIsNoGuess)
{
    GarmentChoice given;
    given.scale = 1 / 17.0;
    EXPECT_TRUE(guess_of(17, given).frame.has_unit);
}

/// The shirt with its trunk drawn out below the sleeves.
TriangleMesh gown(double factor)
{
    constexpr double k_below_sleeves = 1.2;
    TriangleMesh mesh = shirt();
    for (double& y : mesh.positions.col(1))
        if (y < k_below_sleeves)
            y = k_below_sleeves - factor * (k_below_sleeves - y);
    return mesh;
}

double length_of(const TriangleMesh& mesh)
{
    const Eigen::VectorXd heights = mesh.positions(mesh.triangles.reshaped(), 1);
    return heights.maxCoeff() - heights.minCoeff();
}

// Slim limbs of usual girth on a garment far longer than its wearer: the size is not that of any unit.
TEST(GarmentScale, NoGarmentIsLongerThanItsWearerIsTall)
{
    const TriangleMesh mesh = gown(7);
    ASSERT_GT(length_of(mesh), 1.2 * body_stature());
    const FrameGuess guess = garment_frame(mesh.positions, mesh.triangles, {}, {}, body_stature());
    EXPECT_LT(guess.scale, 0.95) << guess.why;
    EXPECT_LT(length_of(mesh) * guess.frame.metres_per_unit, body_stature());
}

TEST(GarmentScale, SlimTrousersAreNoLongerThanTheLegs)
{
    // their girths are those of a person of 1.4 m, so they were scaled by a quarter too much
    const double size = 3.3, height = 1.75;
    const std::vector<WearerHeight> girths { { size * 1.4, 0.16 }, { size * 1.4, 0.18 } };
    std::vector<WearerHeight> all = girths;
    all.push_back({ size * 1.75, 0.05, true });
    const auto length_of = [&](const std::vector<WearerHeight>& wearers) {
        return size * guess_scale(wearers, size * 1.08, height, 1, 1).factor;
    };
    EXPECT_GT(length_of(girths), 1.2);
    EXPECT_NEAR(length_of(all), 1, 0.08);

    all.back().height = size * 1.2;  // short ones say nothing of it
    EXPECT_NEAR(length_of(all), length_of(girths), 0.03);
}

// A stout T-shirt of two units, whose measures disagree, kept decimetres on a body in decimetres, and was refused.
TEST(GarmentScale, AUnitInWhichAGarmentIsADollsIsNotItsOwn)
{
    const double height = 1.6;
    const std::vector<WearerHeight> wearers {
        { 0.38, 0.14 }, { 1.08, 0.19 }, { 0.69, 0.18 }, { 0.74, 0.19 }, { 0.46, 0.37 }
    };
    EXPECT_GT(guess_scale(wearers, 0.25, height, 0.1, 0.1).factor, 1.5);
    EXPECT_EQ(guess_scale(wearers, 0.25, 0.9, 0.1, 0.1).factor, 1) << "a child's";
}

TEST(GarmentScale, TrousersAndSleevesLimitTheirLength)
{
    const Skeleton s = person_skeleton(k_person);
    const TriangleMesh trousers
        = garment_round(s, 0.03, [](const Vec3& p) { return p.y() > 0.15 && p.y() < 1.0 && std::abs(p.x()) < 0.3; });
    const TriangleMesh skirt
        = garment_round(s, 0.03, [](const Vec3& p) { return p.y() > 0.92 && p.y() < 1.1 && std::abs(p.x()) < 0.3; });
    const auto limits = [](const TriangleMesh& mesh) {
        auto wearers = wearer_heights(make_garment(mesh.positions, mesh.triangles));
        std::erase_if(wearers, [](const WearerHeight& wearer) { return !wearer.is_least; });
        return wearers;
    };
    EXPECT_EQ(limits(skirt).size(), 0u);
    EXPECT_EQ(limits(trousers).size(), 1u);
    ASSERT_EQ(limits(shirt()).size(), 1u);
    EXPECT_LT(limits(shirt())[0].height, body_stature()) << "its sleeves are no longer than arms";
}

// It may be longer than a child is tall, who is not its wearer.
TEST(GarmentScale, AnAdultsGarmentKeepsItsSizeOnAChild)
{
    const TriangleMesh mesh = gown(4.8);
    const double child = 0.75 * body_stature();
    ASSERT_GT(length_of(mesh), 1.1 * child);
    ASSERT_LT(length_of(mesh), 0.9 * body_stature());
    const FrameGuess guess = garment_frame(mesh.positions, mesh.triangles, {}, {}, child);
    EXPECT_EQ(guess.frame.metres_per_unit, 1) << guess.why;
}

TEST(GarmentScale, WhatHasNoVerticesOrNoSizeIsLeftToItsPreparation)
{
    EXPECT_EQ(garment_frame(Positions(0, 3), Triangles(0, 3), {}, {}, body_stature()).scale, 1);
    EXPECT_EQ(garment_frame(Positions::Zero(3, 3), Triangles { { 0, 1, 2 } }, {}, {}, body_stature()).scale, 1);
    Positions none = shirt().positions;
    none(0, 0) = std::nan("");
    EXPECT_EQ(garment_frame(none, shirt().triangles, {}, {}, body_stature()).scale, 1);
}

TEST(GarmentScale, WhatTheUserSaysIsNotScaled)
{
    GarmentChoice in_metres;
    in_metres.unit = "m";
    EXPECT_EQ(guess_of(2.1, in_metres).frame.metres_per_unit, 1);
    GarmentChoice scaled;
    scaled.scale = 0.9;
    EXPECT_DOUBLE_EQ(guess_of(2.1, scaled).frame.metres_per_unit, 0.9);
    GarmentChoice placed;
    placed.as_placed = true;
    EXPECT_EQ(guess_of(2.1, placed).frame.metres_per_unit, 1);
}

// A tube without sleeves or legs, as skirts are.
TEST(GarmentScale, WidthAndDepthAreEvidenceWithoutParts)
{
    TriangleMesh tube = shirt();
    std::vector<Eigen::Index> rows;
    for (Eigen::Index f = 0; f < tube.triangles.rows(); ++f) {
        const Vec3 centre = tube.positions(tube.triangles.row(f), Eigen::all).colwise().mean().transpose();
        if (centre.y() < 1.2 && std::abs(centre.x()) < 0.25)
            rows.push_back(f);
    }
    const Triangles trunk = tube.triangles(rows, Eigen::all);
    for (const double size : { 1.0, 3.0, 33.0 }) {
        const FrameGuess guess = garment_frame(size * tube.positions, trunk, {}, {}, body_stature());
        EXPECT_NEAR(size * guess.frame.metres_per_unit, 1, 0.35) << guess.why;  // narrow, as a shirt's trunk is
    }
}

TEST(GarmentScale, AJacketAboveTrousersIsNoneOfTheirExtents)
{
    const TriangleMesh trousers = garment_round(person_skeleton(k_person), 0.02, [](const Vec3& p) {
        return p.y() > 0.15 && p.y() < 1.0 && std::abs(p.x()) < 0.26;
    });
    const auto heights_of
        = [](const TriangleMesh& mesh) { return wearer_heights(make_garment(mesh.positions, mesh.triangles)); };
    const auto alone = heights_of(trousers), suit = heights_of(joined(trousers, shirt()));
    ASSERT_EQ(suit.size(), alone.size());
    for (std::size_t i = 0; i < suit.size(); ++i)
        EXPECT_NEAR(suit[i].height, alone[i].height, 0.02 * alone[i].height) << i;
}

TEST(GarmentScale, IsSaidInAWarningWithTheOptionsThatSettleIt)
{
    const FrameGuess guess = guess_of(2.1);
    std::string all;
    for (const std::string& warning : warnings_about_frame("shirt.obj", guess, "garment_", set_by_name))
        all += warning + "\n";
    EXPECT_NE(all.find("it was scaled by 0."), std::string::npos) << all;
    EXPECT_NE(all.find("probability"), std::string::npos) << all;
    EXPECT_NE(all.find("set garment_unit"), std::string::npos) << all;
    EXPECT_NE(all.find("set garment_scale"), std::string::npos) << all;
}

}  // namespace
