// SPDX-License-Identifier: GPL-3.0-or-later
#include "limb_end.h"

#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace garmentfit;

constexpr double k_step = 0.01;  // shares of the stature, as all lengths here

/// A line with these girths at its end, and before them the first one for as long as a limb.
/// @param bent  number of cuts at the end that turn by a right angle, as a foot does
Centreline limb(const std::vector<double>& end, int bent)
{
    const int before = 40, n = before + int(end.size());
    Centreline line;
    Vec3 place = Vec3::Zero();
    for (int i = 0; i < n; ++i) {
        const Vec3 axis = i < n - bent ? Vec3(0, -1, 0) : Vec3(0, 0, 1);
        line.points.push_back(place);
        line.axes.push_back(axis);
        place += k_step * axis;
        line.arcs.push_back(i * k_step);
        line.girths.push_back(i < before ? end.front() : end[std::size_t(i - before)]);
        line.free.push_back(true);
        line.across.push_back(true);
    }
    line.first_free = 0;
    return line;
}

// A shin, a heel of two cuts, the instep, and toes; the same without toes, as trousers that flare and are closed.
const std::vector<double> k_foot { 0.15,  0.14,  0.13,  0.12, 0.115, 0.125, 0.145, 0.145,
                                   0.125, 0.115, 0.112, 0.11, 0.11,  0.10,  0.07,  0.044 };
const std::vector<double> k_hem { 0.15,  0.14,  0.13,  0.12, 0.115, 0.125, 0.145, 0.145,
                                  0.145, 0.145, 0.145, 0.15, 0.15,  0.15,  0.15,  0.14 };

TEST(LimbEnd, ASlimFootShowsThoughItsHeelIsShort)
{
    EXPECT_TRUE(shows_foot(limb(k_foot, 9), 1));
    EXPECT_FALSE(shows_foot(limb(k_foot, 0), 1));  // does not point forwards
    EXPECT_FALSE(shows_foot(limb(k_hem, 0), 1));
    EXPECT_FALSE(shows_foot(limb(k_hem, 9), 1));
}

/// Goes to and fro in the ankle, n times, before it goes on to the toes.
Centreline with_zigzag(const Centreline& line, int heel, int n)
{
    Centreline result = line;
    result.points.assign(line.points.begin(), line.points.begin() + heel);
    for (int i = 0; i < 2 * n; ++i)
        result.points.push_back(line.points[std::size_t(heel)] + Vec3(0, i % 2 == 0 ? 0.05 : 0, 0));
    result.points.insert(result.points.end(), line.points.begin() + heel, line.points.end());
    result.axes.assign(result.points.size(), -Vec3::UnitY());
    result.girths.assign(result.points.size(), 0.15);
    result.free.assign(result.points.size(), true);
    result.across.assign(result.points.size(), true);
    result.arcs = { 0 };
    for (std::size_t i = 1; i < result.points.size(); ++i)
        result.arcs.push_back(result.arcs.back() + (result.points[i] - result.points[i - 1]).norm());
    return result;
}

TEST(LimbEnd, AFootIsToldByItsDirectionThoughTheLineGoesToAndFroAtTheAnkle)
{
    const std::vector<double> thick(20, 0.15);  // neither thin nor wider at its end
    EXPECT_TRUE(has_foot(limb(thick, 12), 1));
    EXPECT_FALSE(has_foot(limb(thick, 0), 1));
    EXPECT_TRUE(has_foot(with_zigzag(limb(thick, 12), 48, 4), 1));
    EXPECT_FALSE(has_foot(with_zigzag(limb(thick, 0), 48, 4), 1));
}

TEST(LimbEnd, AHandShowsByItsThinFingers)
{
    const std::vector<double> hand { 0.10, 0.09, 0.085, 0.09, 0.10, 0.10, 0.09, 0.07, 0.05, 0.03, 0.02 },
        cuff { 0.10, 0.09, 0.085, 0.09, 0.10, 0.11, 0.12, 0.12, 0.12, 0.12, 0.12 },
        cone { 0.10, 0.095, 0.09, 0.085, 0.08, 0.075, 0.07, 0.06, 0.05, 0.03, 0.02 };
    EXPECT_TRUE(shows_hand(limb(hand, 0), 1));
    EXPECT_FALSE(shows_hand(limb(cuff, 0), 1));
    EXPECT_FALSE(shows_hand(limb(cone, 0), 1));
}

}  // namespace
