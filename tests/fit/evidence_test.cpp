// SPDX-License-Identifier: GPL-3.0-or-later
#include "evidence.h"
#include "outline.h"
#include "tuning.h"

#include <cmath>
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
    EXPECT_EQ(evidence_names()[jumpsuit_taper_evidence], "jumpsuit_taper");
    EXPECT_EQ(evidence_names()[skirt_reach_evidence], "skirt_reach");
    EXPECT_EQ(evidence_names()[rise_evidence], "rise");
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

TEST(Evidence, OneDeceivedMeasureOfTheFrontIsNeverSure)
{
    for (int e = k_first_of_garment_front; e <= k_last_of_garment_front; ++e) {
        WearEvidence one {}, opposite {};
        one[e] = 100;
        opposite[e] = -100;
        EXPECT_NEAR(std::abs(log_odds(one) - log_odds(opposite)), 2 * k_most_of_a_front, 1e-9) << evidence_names()[e];
    }
}

TEST(Evidence, LapAndFileOutweighAWaistThatIsHigherInFront)
{
    WearEvidence forwards {}, backwards {};
    forwards[rise_evidence] = -0.7;
    forwards[lap_evidence] = 0.3;
    forwards[input_front_evidence] = 1;
    for (int e = 0; e < evidence_count; ++e)
        backwards[e] = -forwards[e];
    EXPECT_GT(log_odds(forwards), log_odds(backwards));
}

TEST(Evidence, ThePoseTellsLessBetweenFacingsThanBetweenCoverages)
{
    WearEvidence good {}, poor {};
    good[clearance_evidence] = 1;
    good[covered_inside_evidence] = 1;
    poor[clearance_evidence] = 0.6;
    poor[covered_inside_evidence] = 0.6;
    const double best = pose_log_odds(good);
    EXPECT_NEAR(log_odds(good, best), log_odds(good), 1e-9) << "the best facing stands for its coverage";
    EXPECT_NEAR(log_odds(good, best) - log_odds(poor, best), k_pose_between_facings * (log_odds(good) - log_odds(poor)),
                1e-9);
}

// A tube 0.5 m high with its rim at 0; it is `factor` times as wide 21 cm below the rim as there.
TEST(Evidence, AWaistIsNarrowerThanTheClothBelow)
{
    constexpr double leg = 0.85;
    const auto taper = [](double factor, bool has_neck) {
        std::vector<ClothPatch> cloth;
        Opening waist, hem;
        waist.rim.resize(50, 3);
        for (int i = 0; i < 50; ++i) {
            const double angle = i * 2 * M_PI / 50;
            waist.rim.row(i) << 0.1 * std::sin(angle), 0, 0.1 * std::cos(angle);
            for (double depth = 0; depth < 0.5; depth += 0.01) {
                const double radius = 0.1 * (1 + (factor - 1) * depth / (0.25 * leg));
                const Vec3 centre(radius * std::sin(angle), -depth, radius * std::cos(angle));
                cloth.push_back({ centre.cast<float>(), Eigen::Vector3f::UnitX() });
            }
        }
        waist.girth = 0.63;
        hem.girth = 3;
        hem.centre.y() = -0.5;
        GarmentCues cues;
        cues.is_strapless = !has_neck;
        return taper_of(cloth, { hem, waist }, cues, leg);
    };
    EXPECT_NEAR(taper(1.3, false), -10 * std::log(1.3), 0.3);
    EXPECT_NEAR(taper(0.95, false), -10 * std::log(0.95), 0.3);
    EXPECT_NEAR(taper(0.7, false), 1, 1e-9) << "a flared hem held upwards is no bodice";
    EXPECT_EQ(taper(1.3, true), 0) << "necks are narrow";
}

// A tube of cloth between two radii, from `low` to `high`, m.
void add_tube(std::vector<ClothPatch>& cloth, double low, double high, double radius_low, double radius_high)
{
    for (double y = low; y < high; y += 0.01)
        for (int i = 0; i < 50; ++i) {
            const double angle = i * 2 * M_PI / 50;
            const double radius = radius_low + (radius_high - radius_low) * (y - low) / (high - low);
            const Vec3 centre(radius * std::sin(angle), y, radius * std::cos(angle));
            cloth.push_back({ centre.cast<float>(), Eigen::Vector3f::UnitX() });
        }
}

Opening level_end(double height, double radius, double facing)
{
    Opening end;
    end.facing = { 0, facing, 0 };
    end.rim.resize(50, 3);
    for (int i = 0; i < 50; ++i) {
        const double angle = i * 2 * M_PI / 50;
        end.rim.row(i) << radius * std::sin(angle), height, radius * std::cos(angle);
    }
    end.low = end.rim.colwise().minCoeff();
    end.high = end.rim.colwise().maxCoeff();
    return end;
}

TEST(Evidence, SleevesReachBeyondHemAndNeckAlsoWhereTheyAreClosed)
{
    std::vector<ClothPatch> shirt;
    add_tube(shirt, 0, 0.6, 0.2, 0.2);
    for (double x = 0.2; x < 0.35; x += 0.01)
        for (const double side : { -1.0, 1.0 })
            shirt.push_back({ Eigen::Vector3f(float(side * x), 0.5f, 0), Eigen::Vector3f::UnitY() });
    const std::vector<Opening> ends { level_end(0, 0.2, -1), level_end(0.6, 0.1, 1) };
    EXPECT_NEAR(reach_of(shirt, ends), 10 * std::log(0.35 / 0.2), 0.3);
    EXPECT_EQ(reach_of(shirt, {}), 0) << "without an end";
}

TEST(Evidence, SkirtsDoNotReachBeyondTheirEndsWhicheverIsUp)
{
    std::vector<ClothPatch> skirt, turned;
    add_tube(skirt, 0, 0.6, 0.3, 0.12);
    add_tube(turned, 0, 0.6, 0.12, 0.3);
    EXPECT_NEAR(reach_of(skirt, { level_end(0, 0.3, -1), level_end(0.6, 0.12, 1) }), 0, 0.1);
    EXPECT_NEAR(reach_of(turned, { level_end(0, 0.12, -1), level_end(0.6, 0.3, 1) }), 0, 0.1);
}

TEST(Evidence, AReachBeyondTheEndsSpeaksForATopAndNotForASkirt)
{
    WearEvidence close {}, reaching {};
    close[skirt_evidence] = reaching[skirt_evidence] = 1;
    reaching[skirt_reach_evidence] = 5;
    EXPECT_GT(log_odds(close), log_odds(reaching) + 1);
}

}  // namespace
