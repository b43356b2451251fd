// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/units.h"

#include <cmath>

#include "garmentfit/error.h"
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
