// SPDX-License-Identifier: GPL-3.0-or-later
#include "bend.h"

#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace garmentfit;

constexpr double k_size = 1.75;  // m, stature
constexpr double k_usual_ratio = 0.51;

const Vec3 k_root(0, 1.4, 0), k_corner(0.3, 1.4, 0), k_end(0.3, 1.4, 0.28);

TEST(Bend, OfARightAngleIsItsCornerThoughTheLineCutsIt)
{
    const Centreline line = polyline({ k_root, { 0.25, 1.4, 0 }, { 0.3, 1.4, 0.05 }, k_end }, 0.0175);
    EXPECT_LT((place_bend(line, 0, line.size() - 1, k_root, k_usual_ratio, k_size) - k_corner).norm(), 0.01);
}

TEST(Bend, OfASlightAngleIsWhereTheLineBends)
{
    const Vec3 bend(0.28, 1.4, 0), end(0.52, 1.4, 0.1);
    const Centreline line = polyline({ k_root, bend, end }, 0.0175);
    EXPECT_LT((place_bend(line, 0, line.size() - 1, k_root, k_usual_ratio, k_size) - bend).norm(), 0.02);
}

TEST(Bend, OfAStraightLimbIsAtTheUsualRatio)
{
    const Centreline line = polyline({ k_root, { 0.55, 1.4, 0 } }, 0.0055);
    const Vec3 bend = place_bend(line, 0, line.size() - 1, k_root, k_usual_ratio, k_size);
    EXPECT_NEAR(bend.x(), k_usual_ratio * 0.55, 0.006);
}

}  // namespace
