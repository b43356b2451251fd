// SPDX-License-Identifier: GPL-3.0-or-later
#include "facing.h"

#include <gtest/gtest.h>

namespace {

using namespace garmentfit;

FacingEvidence facing(double z, double energy, double openings) { return { z * Vec3::UnitZ(), energy, z, openings }; }

TEST(Facing, ProbabilitiesSumToOne)
{
    const auto p = facing_probabilities(
        { facing(1, 0, 0.3), facing(-1, -0.2, -0.3), { Vec3::UnitX(), -1, 0, 0 }, { -Vec3::UnitX(), -1.5, 0, 0 } });
    EXPECT_NEAR(p[0] + p[1] + p[2] + p[3], 1, 1e-12);
}

TEST(Facing, OfEqualsTheInputBodysOwnIsProbable)
{
    const auto p = facing_probabilities({ facing(-1, 0, 0), facing(1, 0, 0) });
    EXPECT_LT(p[0], 0.1);
    EXPECT_GT(p[1], 0.9);
}

TEST(Facing, ClearEvidenceOutweighsTheFileItCameIn)
{
    const auto p = facing_probabilities({ facing(-1, 0, 2), facing(1, -2.5, -2) });
    EXPECT_GT(p[0], 0.8) << "necklines, legs and clearance speak for the facing that the body does not have";
}

TEST(Facing, WithoutAFrameInCommonShapeDecides)
{
    const auto p = facing_probabilities({ { Vec3::UnitX(), 0, 0, 0.4 }, { -Vec3::UnitX(), -0.3, 0, -0.4 } });
    EXPECT_GT(p[0], 0.6);
    EXPECT_LT(p[0], 0.9) << "a little evidence is no certainty";
}

TEST(Facing, TwoStartsOfOneFacingAreOneHypothesis)
{
    const auto once = facing_probabilities({ facing(1, 0, 0.2), facing(-1, -0.1, -0.2) });
    const auto twice = facing_probabilities({ facing(1, -0.4, 0.2), facing(1, 0, 0.2), facing(-1, -0.1, -0.2) });
    EXPECT_DOUBLE_EQ(twice[0], once[0]);
    EXPECT_DOUBLE_EQ(twice[1], once[0]);
    EXPECT_DOUBLE_EQ(twice[2], once[1]);
}

}  // namespace
