// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/units.h"

#include <algorithm>
#include <cmath>

#include "garmentfit/error.h"
#include "garmentfit/number_text.h"
#include "tuning.h"

namespace garmentfit {

Eigen::Matrix3d Frame::rotation() const
{
    // an up axis along x turns about z; all others turn about x, which keeps left and right
    Eigen::Matrix3d metres_from_file;
    metres_from_file.row(1) = up;
    if (std::abs(up.x()) > 0.5) {
        metres_from_file.row(2) = Vec3::UnitZ();
        metres_from_file.row(0) = up.cross(Vec3::UnitZ());
    } else {
        metres_from_file.row(0) = Vec3::UnitX();
        metres_from_file.row(2) = Vec3::UnitX().cross(up);
    }
    return metres_from_file;
}

Positions Frame::to_metres(const Positions& in_file) const
{
    return metres_per_unit * in_file * rotation().transpose();
}

Positions Frame::to_file(const Positions& in_metres) const { return in_metres * rotation() / metres_per_unit; }

double metres_per(std::string_view unit)
{
    for (const KnownUnit& known : k_known_units)
        if (known.name == unit)
            return known.metres;
    throw InvalidInput(ErrorCode::unknown_name,
                       "unknown unit '" + std::string(unit) + "'; give m, dm, cm, mm, in or ft");
}

double nearest_unit(double metres_per_unit)
{
    const auto distance = [&](const KnownUnit& known) { return std::abs(std::log(known.metres / metres_per_unit)); };
    return std::min_element(k_known_units.begin(), k_known_units.end(),
                            [&](const KnownUnit& a, const KnownUnit& b) { return distance(a) < distance(b); })
        ->metres;
}

LengthUnit unit_of(const Frame& frame)
{
    constexpr double k_rounding = 1e-6;  // unit: a share; a factor in a file has six digits or more
    for (const KnownUnit& known : k_known_units)
        if (std::abs(frame.metres_per_unit / known.metres - 1) < k_rounding)
            return { known.metres, std::string(known.name) };
    return { frame.metres_per_unit, "units" };
}

std::string length_text(double metres, const LengthUnit& unit)
{
    constexpr double k_small = 0.01;  // unit: below, two leading zeros are harder to read than millimetres
    const double value = metres / unit.metres;
    if (const auto known = std::find_if(k_known_units.begin(), k_known_units.end(),
                                        [&](const KnownUnit& one) { return one.name == unit.name; });
        std::abs(value) < k_small && known != k_known_units.end())
        return rounded_text(1000 * value * known->metres, 3) + " mm";
    return (std::abs(value) >= 100 ? fixed_text(value, 0) : rounded_text(value, 3)) + ' ' + unit.name;
}

Vec3 axis_of(std::string_view name)
{
    const bool is_signed = !name.empty() && (name[0] == '+' || name[0] == '-');
    const std::string_view letter = name.substr(is_signed ? 1 : 0);
    if (letter.size() != 1 || letter[0] < 'x' || letter[0] > 'z')
        throw InvalidInput(ErrorCode::unknown_name,
                           "unknown axis '" + std::string(name) + "'; give +x, -x, +y, -y, +z or -z");
    return (name[0] == '-' ? -1.0 : 1.0) * Vec3::Unit(letter[0] - 'x');
}

}  // namespace garmentfit
