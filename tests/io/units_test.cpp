// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/units.h"

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/error.h"

namespace {

using namespace garmentfit;

constexpr const char* k_axis_names[] = { "+y", "+z", "-y", "-z", "+x", "-x" };

Frame frame_of(const char* unit, const char* up) { return { metres_per(unit), axis_of(up) }; }

TEST(Units, KnowsUnitsAndAxesByName)
{
    EXPECT_EQ(metres_per("dm"), 0.1);
    EXPECT_EQ(metres_per("in"), 0.0254);
    EXPECT_EQ(axis_of("-z"), Vec3(0, 0, -1));
    EXPECT_EQ(axis_of("y"), Vec3(0, 1, 0));
    for (const char* wrong : { "", "+", "w", "+yy", "up" }) {
        EXPECT_THROW(axis_of(wrong), InvalidInput);
        EXPECT_THROW(metres_per(wrong), InvalidInput);
    }
}

TEST(Units, LengthsAreToldInTheUnitOfTheFile)
{
    EXPECT_EQ(length_text(0.1523, {}), "152 mm");
    for (const char* unit : { "m", "dm", "cm", "mm", "in", "ft" })
        EXPECT_EQ(unit_of(frame_of(unit, "+y")).name, unit);
    EXPECT_EQ(length_text(0.1523, unit_of(frame_of("dm", "+z"))), "1.52 dm");
    EXPECT_EQ(length_text(0.000195, unit_of(frame_of("m", "+y"))), "0.195 mm");
    EXPECT_EQ(length_text(0.9, unit_of({ 0.09, Vec3::UnitY() })), "10 units");
}

TEST(Units, EachUpAxisBecomesPlusYByARotation)
{
    for (const char* up : k_axis_names) {
        const Eigen::Matrix3d rotation = frame_of("m", up).rotation();
        EXPECT_EQ(Vec3(rotation * axis_of(up)), Vec3(0, 1, 0)) << up;
        EXPECT_EQ(rotation.determinant(), 1) << up;
        EXPECT_EQ(Eigen::Matrix3d(rotation * rotation.transpose()), Eigen::Matrix3d(Eigen::Matrix3d::Identity())) << up;
    }
    EXPECT_EQ(Vec3(frame_of("m", "+z").rotation() * Vec3(1, 2, 3)), Vec3(1, 3, -2));
    EXPECT_EQ(frame_of("m", "+y").rotation(), Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
}

TEST(Units, ThereAndBackAgainIsTheSame)
{
    const Positions positions = Positions::Random(20, 3);
    EXPECT_EQ(Frame().to_metres(positions), positions);
    for (const char* up : k_axis_names) {
        const Frame frame = frame_of("cm", up);
        EXPECT_TRUE(frame.to_file(frame.to_metres(positions)).isApprox(positions, 1e-15));
    }
}

struct PosedPerson {
    const char* name;
    fixtures::PersonOptions options;
};

std::vector<PosedPerson> people()
{
    std::vector<PosedPerson> people { { "A", { .arm_angle = 45 } },
                                      { "T", { .arm_angle = 0, .elbow_angle = 0 } },
                                      { "arms down", { .arm_angle = 75 } },
                                      { "arms up", { .arm_angle = -60 } },
                                      { "sitting", { .arm_angle = 70, .knee_angle = 90, .hip_angle = 90 } },
                                      { "child", { .scale = 0.6 } } };
    for (PosedPerson& person : people)
        person.options.spacing = 0.07;
    return people;
}

const TriangleMesh& standing_person()
{
    static const TriangleMesh mesh = fixtures::capsule_person(people().front().options).mesh;
    return mesh;
}

TEST(Units, FindsUnitAndUpAxisOfABodyInAnyPose)
{
    for (const PosedPerson& person : people()) {
        const TriangleMesh mesh = fixtures::capsule_person(person.options).mesh;
        for (const char* up : { "+y", "+z" })
            for (const char* unit : { "m", "cm", "in" }) {
                const Frame frame = frame_of(unit, up);
                const FrameGuess guess = guess_body_frame(frame.to_file(mesh.positions), mesh.triangles);
                EXPECT_EQ(guess.frame.up, frame.up) << person.name << up << unit << ": " << guess.why;
                EXPECT_EQ(guess.frame.metres_per_unit, frame.metres_per_unit)
                    << person.name << up << unit << ": " << guess.why;
                EXPECT_GT(guess.unit_confidence, 0);
                EXPECT_GT(guess.up_confidence, 0);
                EXPECT_LE(guess.up_confidence, 1);
            }
    }
}

TEST(Units, FindsABodyOnItsHeadOrItsSide)
{
    const TriangleMesh& mesh = standing_person();
    for (const char* up : { "+x", "-x", "+z" }) {
        const Frame frame = frame_of("m", up);
        EXPECT_EQ(guess_body_frame(frame.to_file(mesh.positions), mesh.triangles).frame.up, frame.up) << up;
    }
}

/// A cone, wide and open below, with a ball on top and two soles: most of the surface is below.
TriangleMesh person_in_a_gown()
{
    const auto distance = [](const Vec3& p) {
        const double gown = std::hypot(p.x(), p.z()) - (0.08 + 0.22 * (1.4 - p.y()));
        const Vec3 from_sole = (p - Vec3(p.x() < 0 ? -0.12 : 0.12, 0, 0.05)).cwiseAbs() - Vec3(0.05, 0.04, 0.13);
        return std::min({ std::max(std::abs(gown) - 0.02, std::abs(p.y() - 0.7) - 0.7),
                          (p - Vec3(0, 1.55, 0.02)).norm() - 0.13, from_sole.maxCoeff() });
    };
    return fixtures::polygonise(distance, Vec3(-0.5, -0.1, -0.5), Vec3(0.5, 1.8, 0.5), 0.03);
}

TEST(Units, ABodyInAGownIsNotTakenForOneOnItsHead)
{
    const TriangleMesh mesh = person_in_a_gown();
    for (const char* up : { "+y", "+z" }) {
        const FrameGuess guess = guess_body_frame(frame_of("m", up).to_file(mesh.positions), mesh.triangles);
        EXPECT_EQ(guess.frame.up, axis_of(up)) << guess.why;
    }
}

TEST(Units, ThePlaceOfABodyDoesNotMatter)
{
    const TriangleMesh& mesh = standing_person();
    const Positions away = mesh.positions.rowwise() + Eigen::RowVector3d(30, -200, 7);
    const FrameGuess here = guess_body_frame(mesh.positions, mesh.triangles),
                     there = guess_body_frame(away, mesh.triangles);
    EXPECT_EQ(here.frame.up, there.frame.up);
    EXPECT_EQ(here.why, there.why);
}

TEST(Units, SaysSoWhenNoUnitMakesAHuman)
{
    const TriangleMesh& mesh = standing_person();
    const FrameGuess guess = guess_body_frame(1e-6 * mesh.positions, mesh.triangles);
    EXPECT_EQ(guess.unit_confidence, 0);
    EXPECT_NE(guess.why.find("no human"), std::string::npos) << guess.why;
    EXPECT_EQ(guess_body_frame(Positions(), Triangles()).unit_confidence, 0);
}

/// An open tube with two open tubes for sleeves, 1.2 m wide, 0.7 m tall and 0.3 m deep.
TriangleMesh shirt()
{
    const auto distance = [](const Vec3& p) {
        const double trunk = std::hypot(p.x() / 0.22, p.z() / 0.14) - 1;
        const double sleeve = std::hypot((p.y() - 1.25) / 0.09, p.z() / 0.09) - 1;
        return std::min(std::max(trunk, std::abs(p.y() - 1.05) / 0.35 - 1),
                        std::max(sleeve, std::abs(p.x()) / 0.6 - 1));
    };
    TriangleMesh mesh = fixtures::polygonise(distance, Vec3(-0.7, 0.6, -0.25), Vec3(0.7, 1.5, 0.25), 0.04);
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        const Vec3 a = mesh.positions.row(mesh.triangles(f, 0)), b = mesh.positions.row(mesh.triangles(f, 1)),
                   c = mesh.positions.row(mesh.triangles(f, 2));
        const Vec3 centre = (a + b + c) / 3;
        if (centre.y() > 0.73 && std::abs(centre.x()) < 0.57)  // without its lids at hem and cuffs
            mesh.triangles.row(kept++) = mesh.triangles.row(f);
    }
    mesh.triangles.conservativeResize(kept, 3);
    return mesh;
}

TEST(Units, AGarmentFollowsItsBody)
{
    const TriangleMesh mesh = shirt();
    for (const char* up : { "+y", "+z" })
        for (const char* unit : { "m", "dm", "cm", "mm", "in", "ft" }) {
            const Frame body = frame_of(unit, up);
            const FrameGuess guess = guess_garment_frame(body.to_file(mesh.positions), mesh.triangles, body);
            EXPECT_EQ(guess.frame.up, body.up) << guess.why;
            EXPECT_EQ(guess.frame.metres_per_unit, body.metres_per_unit) << guess.why;
            EXPECT_NE(guess.why.find("like the body"), std::string::npos);
        }
}

TEST(Units, AGarmentForABodyOfAGivenHeightIsInTheNearestUnit)
{
    const TriangleMesh mesh = shirt();
    Frame body = frame_of("m", "+y");
    body.metres_per_unit = 0.83;
    const FrameGuess guess = guess_garment_frame(mesh.positions, mesh.triangles, body);
    EXPECT_EQ(guess.frame.metres_per_unit, 1);
    EXPECT_NE(guess.why.find("m in m, the unit nearest to the body's"), std::string::npos) << guess.why;
}

TEST(Units, AGarmentOfOtherUnitsOrAxesIsNoticed)
{
    const TriangleMesh mesh = shirt();
    for (const char* up : { "+y", "+z" })
        for (const char* unit : { "m", "cm", "mm" }) {
            const Frame own = frame_of(unit, up), body = frame_of("dm", up[1] == 'y' ? "+z" : "+y");
            const FrameGuess guess = guess_garment_frame(own.to_file(mesh.positions), mesh.triangles, body);
            EXPECT_EQ(guess.frame.up, own.up) << guess.why;
            EXPECT_EQ(guess.frame.metres_per_unit, own.metres_per_unit) << guess.why;
            EXPECT_NE(guess.why.find("unlike the body"), std::string::npos);
        }
}

TEST(Units, InAnotherUnitTheShapeAloneDecidesTheAxis)
{
    TriangleMesh deep = shirt();
    deep.positions.col(2) *= 4;  // as a cape: deeper than tall, so the shape says little
    const Frame body = frame_of("m", "+y"), other = frame_of("cm", "+z"), same = frame_of("m", "+z");
    EXPECT_EQ(guess_garment_frame(other.to_file(deep.positions), deep.triangles, body).frame.up, other.up);
    EXPECT_EQ(guess_garment_frame(same.to_file(deep.positions), deep.triangles, body).frame.up, body.up);
}

TEST(Units, ATriangleThatNamesNoVertexIsRefusedNotRead)
{
    TriangleMesh mesh = shirt();
    mesh.triangles(4, 1) = 1000000;
    fixtures::expect_invalid([&] { guess_body_frame(mesh.positions, mesh.triangles); }, "triangle 4");
    mesh.triangles(4, 1) = -1;
    fixtures::expect_invalid([&] { guess_garment_frame(mesh.positions, mesh.triangles, {}); }, "triangle 4");
}

}  // namespace
