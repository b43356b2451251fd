// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/number_text.h"

#include <array>
#include <charconv>

namespace garmentfit {
namespace {

// unit: the longest double with two decimals has 309 digits before the point.
constexpr std::size_t k_longest_text = 352;

template <class... Format>
std::string converted(Format... format)
{
    std::array<char, k_longest_text> text;
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), format...);
    return { text.data(), end };
}

}  // namespace

std::string text_of(double value) { return converted(value); }
std::string text_of(float value) { return converted(value); }

std::string text_of(const Eigen::Vector3d& values)
{
    return text_of(values.x()) + ' ' + text_of(values.y()) + ' ' + text_of(values.z());
}

std::string fixed_text(double value, int decimals) { return converted(value, std::chars_format::fixed, decimals); }
std::string rounded_text(double value, int digits) { return converted(value, std::chars_format::general, digits); }

std::string place_text(const Eigen::Vector3d& metres)
{
    return '(' + fixed_text(metres.x(), 2) + ", " + fixed_text(metres.y(), 2) + ", " + fixed_text(metres.z(), 2)
        + ") m";
}

}  // namespace garmentfit
