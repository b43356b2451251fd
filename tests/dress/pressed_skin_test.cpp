// SPDX-License-Identifier: GPL-3.0-or-later
#include "pressed_skin.h"

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

/// A flat skin of 11 x 11 vertices that looks up along +y, and one vertex of it pressed down by a millimetre.
struct PressedSheet {
    TriangleMesh own = sheet(11, 0.01, [](double, double) { return 0.0; });
    Positions pressed = own.positions;
    Eigen::Index middle = 60;

    PressedSheet() { pressed(middle, 1) -= 1e-3; }
};

TEST(PressedSkin, DrawsBackIntoTheBodyAndItsNeighboursLess)
{
    const PressedSheet s;
    const Positions made = give_way(s.pressed, s.own.positions, s.own.triangles, 2e-3);
    const Eigen::VectorXd back = (s.pressed - made).col(1);
    EXPECT_NEAR(back(s.middle), 2e-3, 1e-12);
    EXPECT_GT(back(s.middle + 1), 0);
    EXPECT_LT(back(s.middle + 1), 2e-3);
    EXPECT_LT(back(s.middle + 2), back(s.middle + 1));
    EXPECT_EQ(back(0), 0) << "far from it";
    EXPECT_LT((s.pressed - made)(Eigen::all, { 0, 2 }).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(PressedSkin, StaysToTheBitWhereNothingIsPressed)
{
    const PressedSheet s;
    EXPECT_EQ(give_way(s.own.positions, s.own.positions, s.own.triangles, 2e-3), s.own.positions);
}

}  // namespace
