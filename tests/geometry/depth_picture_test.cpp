// SPDX-License-Identifier: GPL-3.0-or-later
#include "depth_picture.h"

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;

struct Meetings {
    std::vector<int> fronts, backs;
    std::vector<float> nearest;
};

Meetings meetings(const PictureFrame& frame, const Positions& positions, const Triangles& triangles)
{
    Meetings result { std::vector<int>(frame.pixels()), std::vector<int>(frame.pixels()),
                      std::vector<float>(frame.pixels(), 1e9F) };
    paint_triangles(frame, frame.project(positions), triangles, [&](std::size_t at, float depth, int, bool is_front) {
        ++(is_front ? result.fronts : result.backs)[at];
        result.nearest[at] = std::min(result.nearest[at], depth);
    });
    return result;
}

/// A square of two triangles at z = 2, wound against the clock as seen from +z.
struct Square {
    Positions positions { { 0, 0, 2 }, { 1, 0, 2 }, { 1, 1, 2 }, { 0, 1, 2 } };
    Triangles triangles { { 0, 1, 2 }, { 0, 2, 3 } };
};

TEST(DepthPicture, HasDepthsAlongItsDirection)
{
    const Square square;
    const PictureFrame frame(-Vec3::UnitZ(), 0.1, square.positions);
    const Meetings met = meetings(frame, square.positions, square.triangles);
    EXPECT_EQ(frame.width(), 11) << "a pixel more than the square is wide, so that no point lies outside";
    int count = 0;
    for (std::size_t p = 0; p < frame.pixels(); ++p)
        if (met.fronts[p] > 0) {
            ++count;
            EXPECT_FLOAT_EQ(met.nearest[p], -2);
        }
    EXPECT_EQ(count, 100);
    EXPECT_EQ(std::count(met.backs.begin(), met.backs.end(), 0), std::ptrdiff_t(frame.pixels()));
}

TEST(DepthPicture, ShowsTheBackFromTheOtherSide)
{
    const Square square;
    const PictureFrame frame(Vec3::UnitZ(), 0.1, square.positions);
    const Meetings met = meetings(frame, square.positions, square.triangles);
    EXPECT_EQ(std::count(met.fronts.begin(), met.fronts.end(), 0), std::ptrdiff_t(frame.pixels()));
    EXPECT_GT(std::count(met.backs.begin(), met.backs.end(), 1), 80);
}

TEST(DepthPicture, LeavesNoGapBetweenTrianglesAndMeetsBothSidesOfAClosedSurface)
{
    const fixtures::Person person = fixtures::capsule_person();
    for (int i = 0; i < 20; ++i) {
        const Vec3 direction(std::cos(i), 0.3 * i - 3, std::sin(i));
        const PictureFrame frame(direction, 0.01, person.mesh.positions);
        const Meetings met = meetings(frame, person.mesh.positions, person.mesh.triangles);
        for (std::size_t p = 0; p < frame.pixels(); ++p)
            EXPECT_EQ(met.fronts[p] > 0, met.backs[p] > 0) << i << ", pixel " << p;
    }
}

TEST(DepthPicture, CutsOffWhatLiesFarOutside)
{
    const Square square;
    const PictureFrame frame(-Vec3::UnitZ(), 0.1, square.positions);
    Positions far = square.positions;
    far.row(1).x() = 1e12;
    far.row(3).y() = -1e12;
    for (const int count : meetings(frame, far, square.triangles).fronts)
        EXPECT_LE(count, 2);
    EXPECT_LE(PictureFrame(-Vec3::UnitZ(), 0.1, far).pixels(), 5000U * 5000U);
}

}  // namespace
