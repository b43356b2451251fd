// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Units, axes and sizes of a mesh: what the user says, or else a guess.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/units.h"

namespace garmentfit {

/// What the user says about units and axes: "m", "cm", ... and "+y", "-z", ...; "auto" leaves it to a guess.
struct FrameChoice {
    std::string unit = "auto", up = "auto";
};

struct BodyChoice : FrameChoice {
    /// m; how tall the body is as it stands in its file, from the lowest to the highest point. Overrides the unit.
    std::optional<double> height = {};
    /// From pelvis to neck of the skeleton in its file, in any length: without an axis from the user, the body stands
    /// along the nearest one.
    std::optional<Vec3> trunk = {};
    /// Which axis the file's format says is up: others are rarer.
    std::optional<Vec3> usual_up = {};
};

struct GarmentChoice : FrameChoice {
    double scale = 1;  ///< of the garment, applied after its unit
    bool as_placed = false;  ///< it lies on the body in its file: the same units and axes, unless they are given
    std::string front = "auto";  ///< axis of the garment's file that its front faces
    /// m; which unit the file's format says: others are rarer. Without it, the body's is the usual one.
    std::optional<double> usual_unit = {};
};

/// Possible values, for hosts that show a list; "auto" comes first.
const std::vector<std::string_view>& unit_choices();
const std::vector<std::string_view>& axis_choices();

/// What the user says, and a guess of the rest; confidences are 1 where the user said it. @throws InvalidInput.
FrameGuess body_frame(const Positions& positions, const Triangles& triangles, const BodyChoice& choice = {});
/// The same for a garment, given the body's frame. A body whose height was given may have any scale; its garments are
/// taken to be in the nearest known unit. A garment whose parts fit the body in no unit is scaled until they do, where
/// the user gives neither unit nor scale. @throws InvalidInput.
/// @param stature  of the body, m (body_scale.h); without it, garments are not scaled
/// @param skin  of the body, m; a garment that lies round it has its frame. Without it, its place says nothing
FrameGuess garment_frame(const Positions& positions, const Triangles& triangles, const Frame& body,
                         const GarmentChoice& choice = {}, std::optional<double> stature = {},
                         const TriangleMesh& skin = {});

/// The axis of a file as a direction in metres with +y up; none for "auto". @throws InvalidInput.
std::optional<Vec3> front_of_body(const Frame& frame, const std::string& axis);
/// The same for a garment. @throws InvalidInput where it is the garment's up axis, too.
std::optional<Vec3> front_of_garment(const Frame& frame, const std::string& axis);

/// From the lowest to the highest point of the triangles, or of all points where there are none, m.
double height_of(const Positions& positions, const Triangles& triangles, const Frame& frame);

}  // namespace garmentfit
