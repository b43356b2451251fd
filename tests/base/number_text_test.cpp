// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/number_text.h"

#include <iomanip>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

namespace {

using namespace garmentfit;

TEST(NumberText, TheShortestTextReadsBackAsTheSameNumber)
{
    EXPECT_EQ(text_of(0.1), "0.1");
    EXPECT_EQ(text_of(0.1f), "0.1");
    EXPECT_EQ(std::stod(text_of(1.0 / 3)), 1.0 / 3);
    EXPECT_EQ(text_of(Eigen::Vector3d(1, 2.5, -3)), "1 2.5 -3");
}

TEST(NumberText, DecimalsAndDigitsAreRounded)
{
    EXPECT_EQ(fixed_text(0.126, 2), "0.13");
    EXPECT_EQ(fixed_text(-1.5, 0), "-2");
    EXPECT_EQ(rounded_text(1.0, 3), "1");
    EXPECT_EQ(rounded_text(176.43, 3), "176");
    EXPECT_EQ(rounded_text(1234.5, 3), "1.23e+03");
    EXPECT_EQ(place_text({ 0.123, 1.5, -0.031 }), "(0.12, 1.50, -0.03) m");
}

TEST(NumberText, IsWhatAStreamWrites)
{
    for (const double value : { 0.0, 0.05, 0.999, 2.5, 9.996, 37.0, 123456.7, 1e-7, -1e9 }) {
        std::ostringstream rounded, fixed;
        rounded << std::setprecision(3) << value;
        fixed << std::fixed << std::setprecision(1) << value;
        EXPECT_EQ(rounded_text(value, 3), rounded.str());
        EXPECT_EQ(fixed_text(value, 1), fixed.str());
    }
}

TEST(NumberText, EveryNumberHasAText)
{
    EXPECT_EQ(fixed_text(std::numeric_limits<double>::max(), 2).size(), 312u);
    EXPECT_EQ(rounded_text(std::numeric_limits<double>::infinity(), 3), "inf");
    EXPECT_EQ(text_of(std::numeric_limits<double>::quiet_NaN()), "nan");
}

}  // namespace
