// SPDX-License-Identifier: GPL-3.0-or-later
#include "evidence.h"

#include <numeric>

#include <gtest/gtest.h>

namespace {

using namespace garmentfit;

TEST(Evidence, ProbabilitiesSumToOne)
{
    const auto p = probabilities({ 3, -1, 0.5, 2 });
    EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1, 1e-12);
    EXPECT_GT(p[0], p[3]);
    EXPECT_NEAR(p[0] / p[3], std::exp(1), 1e-12) << "the ratio of two is the exponential of their difference";
    EXPECT_TRUE(probabilities({}).empty());
}

TEST(Evidence, LargeLogOddsDoNotOverflow)
{
    const auto p = probabilities({ 5000, 4990 });
    EXPECT_NEAR(p[0], 1 / (1 + std::exp(-10)), 1e-12);
}

TEST(Evidence, EachKindHasItsName)
{
    for (const std::string_view name : evidence_names())
        EXPECT_FALSE(name.empty());
    EXPECT_EQ(evidence_names()[as_given_evidence], "as_given");
    EXPECT_EQ(evidence_names()[jumpsuit_evidence], "jumpsuit");
    EXPECT_EQ(evidence_names()[jumpsuit_divided_evidence], "jumpsuit_divided");
    EXPECT_EQ(evidence_names()[jumpsuit_arms_evidence], "jumpsuit_arms");
    EXPECT_EQ(evidence_names()[input_front_evidence], "input_front");
}

TEST(Evidence, OfEqualsTheInputBodysFrontIsProbable)
{
    WearEvidence same {}, opposite {};
    same[input_front_evidence] = 1;
    opposite[input_front_evidence] = -1;
    EXPECT_GT(log_odds(same), log_odds(opposite));
}

TEST(Evidence, AClearShapeOutweighsTheFileItCameIn)
{
    WearEvidence same {}, opposite {};
    same[input_front_evidence] = 1;
    same[openings_evidence] = -1;
    same[bare_evidence] = -1;
    opposite[input_front_evidence] = -1;
    opposite[openings_evidence] = 1;
    opposite[bare_evidence] = 1;
    EXPECT_GT(log_odds(opposite), log_odds(same));
}

}  // namespace
