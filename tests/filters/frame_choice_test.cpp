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
    EXPECT_EQ(guess.unit_margin, 1);
    EXPECT_EQ(guess.up_margin, 1);
}

TEST(FrameChoice, UnderstandsAllThatItOffers)
{
    for (const std::string_view unit : unit_choices())
        EXPECT_NO_THROW(body_frame(person().positions, person().triangles, { std::string(unit), "auto" })) << unit;
    for (const std::string_view axis : axis_choices())
        EXPECT_NO_THROW(garment_frame(person().positions, person().triangles, {}, { "auto", std::string(axis) }))
            << axis;
}

TEST(FrameChoice, RefusesOtherUnitsAndListsThem)
{
    expect_invalid([] { body_frame(person().positions, person().triangles, { "cubit", "auto" }); }, "cubit");
}

}  // namespace
