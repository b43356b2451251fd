// SPDX-License-Identifier: GPL-3.0-or-later
#include "tightness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fixtures.h"

namespace garmentfit {
namespace {

/// Points round a bone, at this distance from it.
Positions tube(const Skeleton& skeleton, Bone bone, double radius)
{
    constexpr int k_rings = 10, k_round = 32;
    const Vec3 axis = skeleton.direction(bone), across = axis.unitOrthogonal(), third = axis.cross(across);
    Positions result(k_rings * k_round, 3);
    for (int i = 0; i < result.rows(); ++i) {
        const double angle = 2 * M_PI * (i % k_round) / k_round, along = (i / k_round + 0.5) / k_rings;
        result.row(i) = skeleton.head(bone) + along * skeleton.length(bone) * axis
            + radius * (std::cos(angle) * across + std::sin(angle) * third);
    }
    return result;
}

TEST(Slack, IsHowMuchWiderAGarmentIsThanWhatItGoesRound)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    const Positions thigh = tube(skeleton, lfemur, 0.08);
    const auto wider = slack(tube(skeleton, lfemur, 0.1), thigh, fixtures::on_bone(lfemur, thigh.rows()), skeleton);
    for (int p = 0; p < k_body_parts; ++p)
        EXPECT_NEAR(wider[p], p == part_of(lfemur) ? 0.25 : 0, 1e-9) << part_name(p);
}

TEST(GrowthLeft, IsWhatTheSkinUnderAGarmentStillLacks)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    const Positions thin = tube(skeleton, lfemur, 0.05), full = tube(skeleton, lfemur, 0.08);
    const auto growth
        = growth_left(tube(skeleton, lfemur, 0.055), thin, full, fixtures::on_bone(lfemur, thin.rows()), skeleton);
    for (int p = 0; p < k_body_parts; ++p)
        EXPECT_NEAR(growth[p], p == part_of(lfemur) ? 0.6 : 0, 1e-9) << part_name(p);
}

}  // namespace
}  // namespace garmentfit
