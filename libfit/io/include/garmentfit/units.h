// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Conversion between a file's units and axes and libfit's metres with +y up.

#include <optional>
#include <string>
#include <string_view>

#include "garmentfit/export.h"
#include "garmentfit/types.h"

namespace garmentfit {

constexpr double k_degrees_per_radian = 180 / 3.14159265358979323846;  // derived

/// A file's units and axes. Positions in metres = metres_per_unit * (rotation that takes `up` to +y) * positions in the
/// file.
struct Frame {
    double metres_per_unit = 1;
    Vec3 up = Vec3::UnitY();  ///< one of the six axis directions, in the file's axes
    bool has_unit = true;  ///< else the file is in no unit, or hardly: metres_per_unit is a guess by what the mesh is
    double size_in_unit
        = 1;  ///< without a unit: how many times as large the mesh is in the most probable one, if any is

    GARMENTFIT_API Positions to_metres(const Positions& in_file) const;
    GARMENTFIT_API Positions to_file(const Positions& in_metres) const;
    GARMENTFIT_API Eigen::Matrix3d
    rotation() const;  ///< metres-from-file; +y up: identity, +z up: (x, y, z) -> (x, z, -y)
};

/// "m", "dm", "cm", "mm", "in", "ft". @throws InvalidInput listing them.
GARMENTFIT_API double metres_per(std::string_view unit);
/// The nearest of these by ratio, m: that of a file whose body was scaled to a height.
GARMENTFIT_API double nearest_unit(double metres_per_unit);
/// "+x", "-x", ..., also "y" for "+y". @throws InvalidInput.
GARMENTFIT_API Vec3 axis_of(std::string_view name);

/// In which messages tell lengths.
struct LengthUnit {
    double metres = 1e-3;
    std::string name = "mm";
};
/// That of a file: "cm", or "units" where it has none of the names of metres_per.
GARMENTFIT_API LengthUnit unit_of(const Frame& frame);
/// "152 mm", "1.52 dm": three significant digits, or all before the point. Less than a
/// hundredth of a known unit is told in millimetres.
GARMENTFIT_API std::string length_text(double metres, const LengthUnit& unit);

struct FrameGuess {
    Frame frame;
    double unit_confidence = 0, up_confidence = 0;  ///< 0: several are equally likely, 1: certain; no probabilities
    std::string why;  ///< one sentence for the user
    /// Of a garment that fits the body in no unit: what its unit was multiplied by; contained in the frame. And the
    /// probability that this scale, or 1, is right.
    double scale = 1, scale_probability = 1;
};

/// Guesses units and up axis of a human body from its size and shape. @throws InvalidInput: index out of range.
/// @param up  an axis, where it is known
/// @param usual_up  the axis that the file's format says, where it says one
GARMENTFIT_API FrameGuess guess_body_frame(const Positions& positions, const Triangles& triangles,
                                           const std::optional<Vec3>& up = {},
                                           const std::optional<Vec3>& usual_up = {});
/// The same for a garment. It has the frame of the body, in the nearest unit, unless its size or shape contradicts.
GARMENTFIT_API FrameGuess guess_garment_frame(const Positions& positions, const Triangles& triangles,
                                              const Frame& body);

}  // namespace garmentfit
