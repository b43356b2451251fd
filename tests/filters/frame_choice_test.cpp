// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/frame_choice.h"

#include "fixtures.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

const TriangleMesh& person()
{
    static const TriangleMesh mesh = capsule_person({}).mesh;
    return mesh;
}

TEST(FrameChoice, PutsWhatTheUserSaysBeforeTheGuess)
{
    const FrameGuess guess = body_frame(person().positions, person().triangles, { "in", "-z" });
    EXPECT_EQ(guess.frame.metres_per_unit, 0.0254);
    EXPECT_EQ(guess.frame.up, -Vec3::UnitZ());
    EXPECT_EQ(guess.unit_confidence, 1);
    EXPECT_EQ(guess.up_confidence, 1);
}

TEST(FrameChoice, UnderstandsAllThatItOffers)
{
    for (const std::string_view unit : unit_choices())
        EXPECT_NO_THROW(body_frame(person().positions, person().triangles, { std::string(unit), "auto" })) << unit;
    for (const std::string_view axis : axis_choices())
        EXPECT_NO_THROW(garment_frame(person().positions, person().triangles, {}, { "auto", std::string(axis) }))
            << axis;
}

TEST(FrameChoice, MakesABodyAsTallAsItIsSaidToBe)
{
    const TriangleMesh& mesh = person();
    const Positions in_cm = 100 * mesh.positions;
    const FrameGuess guess = body_frame(in_cm, mesh.triangles, { { "mm", "+y" }, 1.2 });
    EXPECT_NEAR(height_of(in_cm, guess.frame), 1.2, 1e-12) << "the height overrides the unit";
    EXPECT_EQ(guess.unit_confidence, 1);
    EXPECT_NE(guess.why.find("1.2 m as given"), std::string::npos) << guess.why;
    EXPECT_EQ(garment_frame(in_cm, mesh.triangles, guess.frame).frame.metres_per_unit, 0.01)
        << "garments keep their own scale";
    for (const double height : { 0.1, 11.0 })
        expect_invalid([&] { body_frame(in_cm, mesh.triangles, { {}, height }); }, "height");
}

TEST(FrameChoice, ScalesAGarmentAfterItsUnit)
{
    GarmentChoice choice { { "cm", "+y" }, 1.5 };
    const FrameGuess guess = garment_frame(100 * person().positions, person().triangles, { 0.01 }, choice);
    EXPECT_DOUBLE_EQ(guess.frame.metres_per_unit, 0.015);
    EXPECT_NE(guess.why.find("scaled by 1.5"), std::string::npos) << guess.why;
    choice.scale = 0;
    expect_invalid([&] { garment_frame(person().positions, person().triangles, {}, choice); }, "garment_scale");
}

TEST(FrameChoice, OfAGarmentOnItsBodyIsThatOfTheBody)
{
    const Frame odd { 0.0123, Vec3::UnitZ() };
    const FrameGuess guess = garment_frame(person().positions, person().triangles, odd, { {}, 1, true });
    EXPECT_EQ(guess.frame.metres_per_unit, odd.metres_per_unit);
    EXPECT_EQ(guess.frame.up, odd.up);
    const GarmentChoice in_cm { { "cm", "auto" }, 1, true };
    EXPECT_EQ(garment_frame(person().positions, person().triangles, odd, in_cm).frame.metres_per_unit, 0.01);
}

TEST(FrameChoice, TurnsTheFrontOfAGarmentWithItsAxes)
{
    const Frame up_is_z { 1, Vec3::UnitZ() };
    EXPECT_FALSE(front_of_garment(up_is_z, "auto"));
    EXPECT_EQ(front_of_garment(up_is_z, "-y"), Vec3(0, 0, 1));
    EXPECT_EQ(front_of_garment(up_is_z, "+x"), Vec3(1, 0, 0));
    for (const char* along : { "+z", "-z" })
        expect_invalid([&] { front_of_garment(up_is_z, along); }, "along the up axis");
    expect_invalid([&] { front_of_garment(up_is_z, "forwards"); }, "unknown axis");
    GarmentChoice choice { { "auto", "+y" } };
    choice.front = "-y";
    expect_invalid([&] { garment_frame(person().positions, person().triangles, {}, choice); }, "garment_front");
}

TEST(FrameChoice, RefusesOtherUnitsAndListsThem)
{
    expect_invalid([] { body_frame(person().positions, person().triangles, { "cubit", "auto" }); }, "cubit");
}

}  // namespace
