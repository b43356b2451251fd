// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/body_place.h"
#include "garmentfit/filters/frame_choice.h"

#include <cmath>

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

TEST(FrameChoice, ABodyStandsAlongTheTrunkOfItsSkeleton)
{
    const TriangleMesh& mesh = person();
    BodyChoice choice;
    choice.trunk = Vec3(0.1, -0.05, 1);
    EXPECT_EQ(body_frame(mesh.positions, mesh.triangles, choice).frame.up, Vec3::UnitZ());
    choice.trunk = Vec3(0.7, 0, 0.7);
    EXPECT_EQ(body_frame(mesh.positions, mesh.triangles, choice).frame.up, Vec3::UnitY()) << "between two axes";
    choice.trunk = Vec3::UnitX();
    choice.up = "+y";
    EXPECT_EQ(body_frame(mesh.positions, mesh.triangles, choice).frame.up, Vec3::UnitY()) << "the user knows better";
}

TEST(FrameChoice, TheAxisOfTheFormatIsLikelier)
{
    TriangleMesh mesh = person();
    mesh.positions.col(0) *= 6;  // arms of five times the height
    EXPECT_EQ(body_frame(mesh.positions, mesh.triangles).frame.up.cwiseAbs(), Vec3::UnitX());
    BodyChoice choice;
    choice.usual_up = Vec3::UnitY();
    EXPECT_EQ(body_frame(mesh.positions, mesh.triangles, choice).frame.up, Vec3::UnitY());
    const Positions lying = Frame { 1, Vec3::UnitZ() }.to_file(person().positions);
    EXPECT_EQ(body_frame(lying, mesh.triangles, choice).frame.up, Vec3::UnitZ()) << "the shape may still decide";
}

TEST(FrameChoice, TheUnitIsThatOfTheLengthAlongAGivenAxis)
{
    Positions wide = person().positions;  // a figure with arms of more than twice its height
    wide.col(0) *= 3;
    const FrameGuess guess = body_frame(wide, person().triangles, { "auto", "+y" });
    EXPECT_EQ(guess.frame.metres_per_unit, 1) << guess.why;
    EXPECT_NE(guess.why.find("along +y"), std::string::npos) << guess.why;
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
    EXPECT_NEAR(height_of(in_cm, mesh.triangles, guess.frame), 1.2, 1e-12) << "the height overrides the unit";
    EXPECT_EQ(guess.unit_confidence, 1);
    EXPECT_NE(guess.why.find("1.2 m as given"), std::string::npos) << guess.why;
    EXPECT_EQ(garment_frame(in_cm, mesh.triangles, guess.frame).frame.metres_per_unit, 0.01)
        << "garments keep their own scale";
    Positions with_stray(in_cm.rows() + 1, 3);
    with_stray << in_cm, Eigen::RowVector3d(0, 1000, 0);
    EXPECT_EQ(body_frame(with_stray, mesh.triangles, { { "mm", "+y" }, 1.2 }).frame.metres_per_unit,
              guess.frame.metres_per_unit)
        << "what no triangle has is no height";
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

// A band round the chest is flat: by its shape alone it hangs along another axis, and by its widths on somebody smaller.
TEST(FrameChoice, OfAGarmentThatLiesRoundTheBodyIsThatOfTheBody)
{
    const Person person = capsule_person({ .arm_angle = 45 });
    TriangleMesh band = garment_round(
        person.skeleton, 0.02, [](const Vec3& p) { return p.y() > 1.22 && p.y() < 1.34 && std::abs(p.x()) < 0.25; });
    const Frame decimetres { 0.1 };
    band.positions *= 10;
    const FrameGuess guess = garment_frame(band.positions, band.triangles, decimetres, {}, 1.7, person.mesh);
    EXPECT_EQ(guess.frame.metres_per_unit, 0.1) << guess.why;
    EXPECT_EQ(guess.frame.up, Vec3::UnitY()) << guess.why;
    EXPECT_EQ(guess.scale, 1) << guess.why;
    const GarmentChoice in_cm { { "cm", "auto" } };
    EXPECT_EQ(garment_frame(band.positions, band.triangles, decimetres, in_cm, 1.7, person.mesh).frame.metres_per_unit,
              0.01);
}

// In decimetres a tube of 3 units lies round a shin; nobody of the body's size wears a garment as narrow.
TEST(FrameChoice, OfASmallGarmentThatLiesRoundALimbByChanceIsAnother)
{
    const Person person = capsule_person({ .arm_angle = 45 });
    TriangleMesh tube
        = garment_round(person.skeleton, 0.02, [](const Vec3& p) { return p.y() > 0.15 && p.y() < 0.45 && p.x() > 0; });
    tube.positions *= 10;
    for (const double body_unit : { 1.0, 0.1 }) {
        const FrameGuess guess = garment_frame(tube.positions, tube.triangles, { body_unit }, {}, 1.7, person.mesh);
        EXPECT_EQ(guess.why.find("lies on the body"), std::string::npos) << guess.why;
        EXPECT_NE(guess.frame.metres_per_unit, 0.1) << guess.why;
    }
}

/// A wide T-shirt round the chest, in decimetres, for somebody smaller. @param share  of the size of a usual one
TriangleMesh small_t_shirt(const Person& person, double share)
{
    TriangleMesh shirt = garment_round(
        person.skeleton, 0.13, [](const Vec3& p) { return p.y() > 0.95 && p.y() < 1.42 && std::abs(p.x()) < 0.3; });
    const Eigen::RowVector3d chest(0, 1.2, 0);
    shirt.positions = (share * (shirt.positions.rowwise() - chest)).rowwise() + chest;
    EXPECT_TRUE(lies_on_body(shirt, person.mesh));
    shirt.positions *= 10;
    return shirt;
}

// In decimetres, a wide T-shirt of normalised size is for somebody little more than half as tall, and lies round the
// chest.
TEST(FrameChoice, OfASmallTShirtThatLiesRoundTheChestByChanceIsAnother)
{
    const Person person = capsule_person({ .arm_angle = 45 });
    const TriangleMesh shirt = small_t_shirt(person, 0.52);
    for (const double body_unit : { 1.0, 0.1 }) {
        const FrameGuess guess = garment_frame(shirt.positions, shirt.triangles, { body_unit }, {}, 1.7, person.mesh);
        EXPECT_EQ(guess.why.find("lies on the body"), std::string::npos) << guess.why;
    }
}

// The unit of the body's file explains a small garment, another unit does so by chance.
TEST(FrameChoice, OfASmallTShirtRoundTheChestIsThatOfTheBodyOnlyInItsUnit)
{
    const Person person = capsule_person({ .arm_angle = 45 });
    const TriangleMesh shirt = small_t_shirt(person, 0.62);
    for (const double body_unit : { 1.0, 0.1 }) {
        const FrameGuess guess = garment_frame(shirt.positions, shirt.triangles, { body_unit }, {}, 1.7, person.mesh);
        EXPECT_EQ(guess.why.find("lies on the body") != std::string::npos, body_unit == 0.1) << guess.why;
    }
}

// A pendant that a program left at the origin, 3 m below the shirt, made it 3.6 m tall.
TEST(FrameChoice, OfAGarmentWithASpeckFarFromItIsThatOfTheGarment)
{
    const Person person = capsule_person({ .arm_angle = 45 });
    TriangleMesh shirt = garment_round(person.skeleton, 0.03, [](const Vec3& p) { return p.y() > 0.9; });
    TriangleMesh speck
        = polygonise([](const Vec3& p) { return p.norm() - 0.02; }, Vec3::Constant(-0.03), Vec3::Constant(0.03), 0.01);
    shirt.positions.col(1).array() += 3;
    const TriangleMesh both = joined(shirt, speck);
    const auto guess = [&](const TriangleMesh& mesh) {
        return garment_frame(mesh.positions, mesh.triangles, {}, {}, 1.7, person.mesh).frame;
    };
    EXPECT_EQ(guess(both).metres_per_unit, guess(shirt).metres_per_unit);
    EXPECT_EQ(guess(both).up, guess(shirt).up);
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

// Wider and deeper than high: by its box, this skirt lies. But its waist is narrower than its hem.
TEST(FrameChoice, AsksTheOpeningsWhichAxisIsUp)
{
    const int around = 32, rings = 12;
    TriangleMesh skirt { Positions(around * rings, 3), Triangles(2 * around * (rings - 1), 3) };
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < around; ++k) {
            const double share = double(i) / (rings - 1), angle = 2 * M_PI * k / around, radius = 20 - 4 * share;
            skirt.positions.row(i * around + k) << radius * std::cos(angle), 8 * share, radius * std::sin(angle);
            if (i + 1 < rings) {
                const int here = i * around + k, next = i * around + (k + 1) % around;
                skirt.triangles.row(2 * here) << here, here + around, next;
                skirt.triangles.row(2 * here + 1) << next, here + around, next + around;
            }
        }
    EXPECT_EQ(guess_garment_frame(skirt.positions, skirt.triangles, {}).frame.up, Vec3::UnitZ()) << "by its box";
    EXPECT_EQ(garment_frame(skirt.positions, skirt.triangles, {}).frame.up, Vec3::UnitY());
    Positions up_is_z = skirt.positions;
    up_is_z.col(1) = -skirt.positions.col(2);
    up_is_z.col(2) = skirt.positions.col(1);
    EXPECT_EQ(garment_frame(up_is_z, skirt.triangles, {}).frame.up, Vec3::UnitZ());
    Positions upside_down = up_is_z;
    upside_down.col(2) *= -1;
    EXPECT_EQ(garment_frame(upside_down, skirt.triangles, {}).frame.up, Vec3::UnitZ()) << "the fit turns it over";
    EXPECT_EQ(garment_frame(up_is_z, skirt.triangles, {}, { { "auto", "+y" } }).frame.up, Vec3::UnitY()) << "as given";
}

TEST(FrameChoice, RefusesOtherUnitsAndListsThem)
{
    expect_invalid([] { body_frame(person().positions, person().triangles, { "cubit", "auto" }); }, "cubit");
}

}  // namespace
