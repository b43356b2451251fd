// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/frame_choice.h"

#include <algorithm>
#include <cmath>

#include "garment_scale.h"
#include "garmentfit/body_place.h"
#include "garmentfit/closed_ends.h"
#include "garmentfit/error.h"
#include "garmentfit/filters/schema.h"
#include "garmentfit/garment_size.h"
#include "garmentfit/garment_up.h"
#include "garmentfit/number_text.h"
#include "tuning.h"

namespace garmentfit {
namespace {

constexpr double k_same_unit = 1e-9;  // unit: what rounding leaves

/// The axis of a file that a direction is near to; none where it lies between axes.
std::optional<Vec3> axis_along(const Vec3& direction)
{
    Eigen::Index k;
    if (!(direction.cwiseAbs().maxCoeff(&k) > k_least_along_axis * direction.norm()))
        return {};
    return Vec3(std::copysign(1.0, direction[k]) * Vec3::Unit(k));
}

/// What is known of the up axis of a body: by the user, else by the skeleton in its file.
std::optional<Vec3> known_up(const BodyChoice& choice)
{
    if (choice.up != "auto")
        return axis_of(choice.up);
    return choice.trunk ? axis_along(*choice.trunk) : std::nullopt;
}

/// The guess, replaced by what the user said.
FrameGuess apply_choice(FrameGuess guess, const FrameChoice& choice)
{
    if (choice.unit != "auto") {
        guess.frame.metres_per_unit = metres_per(choice.unit);
        guess.unit_confidence = 1;
    }
    if (choice.up != "auto") {
        guess.frame.up = axis_of(choice.up);
        guess.up_confidence = 1;
    }
    return guess;
}

/// Scales the body to a height.
void set_height(FrameGuess& guess, const Positions& positions, const Triangles& triangles, double height)
{
    const double units = height_of(positions, triangles, guess.frame) / guess.frame.metres_per_unit;
    if (!(units > 0))
        throw InvalidInput(ErrorCode::degenerate_mesh,
                           "height: the body is flat along its up axis; give that axis as up, too");
    guess.frame.metres_per_unit = height / units;
    guess.unit_confidence = 1;
    guess.why = "the body is " + rounded_text(units, 3) + " units tall, " + rounded_text(height, 3) + " m as given";
}

/// The faces of its cloth: a necklace or a label that lies far away, or a backdrop, would make it larger. What is no
/// garment is left alone.
Triangles cloth_of(const Positions& positions, const Triangles& triangles)
{
    try {
        return without_scenery(make_garment(positions, triangles));
    } catch (const InvalidInput&) {
        return triangles;
    }
}

/// Factor that makes a garment of any size as large as a shirt or a pair of trousers: openings are found among those of
/// people's clothes. None where it has no size.
std::optional<double> to_usual_size(const Positions& positions, const Triangles& triangles)
{
    const double longest = extents_of(positions, triangles).maxCoeff();
    if (!(longest > 0))
        return {};
    return k_usual_longest_side / longest;
}

/// The io guess knows only the shape of the box and its symmetry; what the openings say is added to its evidence. What
/// is no garment is left alone. A garment that is upside down along an axis hangs along it, too: the fit turns it over.
void choose_up(FrameGuess& guess, const Positions& positions, const Triangles& triangles, const Frame& body)
{
    const Vec3 other = std::abs(body.up.y()) > 0.5 ? Vec3::UnitZ() : Vec3::UnitY();
    const double sign = guess.frame.up == other ? 1 : -1, by_shape = -sign * std::log1p(-guess.up_confidence);
    const std::optional<double> size = to_usual_size(positions, triangles);
    if (!size || std::abs(by_shape) >= 2 * k_openings_up_weight)
        return;
    std::vector<double> evidence;
    try {
        evidence = evidence_for_up(make_garment(positions * *size, triangles), { body.up, other });
    } catch (const InvalidInput&) {
        return;
    }
    const double by_all = by_shape + k_openings_up_weight * (std::abs(evidence[1]) - std::abs(evidence[0]));
    const Vec3 up = by_all > 0 ? other : body.up;
    if (up != guess.frame.up)
        guess.why += up == body.up ? ", but its openings say like the body" : ", but its openings say unlike the body";
    guess.frame.up = up;
    guess.up_confidence = -std::expm1(-std::abs(by_all));
}

/// As wearer_heights, of a garment of any size.
std::vector<WearerHeight> wearer_heights_of_any_size(const Positions& metres, const Triangles& triangles)
{
    const std::optional<double> size = to_usual_size(metres, triangles);
    if (!size)
        return {};
    std::vector<WearerHeight> wearers = wearer_heights(make_garment(metres * *size, triangles));
    for (WearerHeight& wearer : wearers)
        wearer.height /= *size;
    return wearers;
}

/// A unit that has this size; none where the garment was scaled.
std::optional<std::string_view> name_of_unit(double metres_per_unit)
{
    for (const std::string_view unit : unit_choices())
        if (unit != "auto" && std::abs(metres_per(unit) / metres_per_unit - 1) < k_same_unit)
            return unit;
    return {};
}

/// By what the garment's measures say. What is no garment is left alone: its defects are found where it is prepared.
void scale_to_body(FrameGuess& guess, const Positions& positions, const Triangles& triangles, double usual_unit,
                   double stature)
{
    const Positions metres = guess.frame.to_metres(positions);
    std::vector<WearerHeight> wearers;
    try {
        wearers = wearer_heights_of_any_size(metres, triangles);
    } catch (const InvalidInput&) {
        return;
    }
    if (wearers.empty())
        return;
    const double length = extents_of(metres, triangles).y();
    const ScaleGuess scale = guess_scale(wearers, length, stature, guess.frame.metres_per_unit, usual_unit,
                                         is_normalised(positions, triangles));
    guess.scale_probability = scale.probability;
    guess.frame.metres_per_unit *= scale.factor;
    guess.frame.has_unit = scale.probability >= k_low_probability;
    if (scale.factor == 1)
        return;
    if (const std::optional<std::string_view> unit = name_of_unit(guess.frame.metres_per_unit)) {
        guess.frame.metres_per_unit = metres_per(*unit);
        guess.why += "; its parts fit the body in " + std::string(*unit);
    } else {
        guess.scale = scale.factor;
        guess.frame.has_unit = false;
        if (scale.unit_probability > k_worth_trying)
            guess.frame.size_in_unit = scale.unit_factor / scale.factor;
        guess.why += "; its parts fit the body when it is scaled by " + rounded_text(scale.factor, 3);
    }
}

std::string unit_text(const Frame& frame)
{
    return std::string(name_of_unit(frame.metres_per_unit).value_or("no unit"));
}

/// By its measures: a small garment may come to lie in the body's trunk or round a limb by chance. What is no garment,
/// or has no measures, may be of any size.
bool is_too_small(const Positions& metres, const Triangles& triangles, double least_wearer)
{
    try {
        const std::optional<double> median = median_wearer(wearer_heights_of_any_size(metres, triangles));
        return median && *median <= least_wearer;
    } catch (const InvalidInput&) {
        return false;
    }
}

/// The body's frame, or one of its axes and another unit, in which the garment lies round the body. Inches and feet are
/// too near to others: in them a garment elsewhere may come to lie at a limb.
std::optional<Frame> frame_on_body(const Positions& positions, const Triangles& triangles, const Frame& body,
                                   const TriangleMesh& skin, const std::optional<double>& stature)
{
    const auto lies_in = [&](const Frame& frame, double least_wearer) {
        const Positions metres = frame.to_metres(positions);
        return lies_on_body({ metres, triangles }, skin)
            && !(stature && is_too_small(metres, triangles, least_wearer * *stature));
    };
    if (lies_in(body, k_least_wearer_in_place))
        return body;
    for (const double metres_per_unit : { 1.0, 0.1, 0.01, 0.001 }) {
        Frame frame = body;
        frame.metres_per_unit = metres_per_unit;
        if (metres_per_unit != body.metres_per_unit && lies_in(frame, k_least_wearer_in_other_unit))
            return frame;
    }
    return {};
}

std::optional<Frame> frame_on_body(const Positions& positions, const Triangles& triangles, const Frame& body,
                                   const GarmentChoice& choice, const TriangleMesh& skin,
                                   const std::optional<double>& stature)
{
    if (choice.as_placed)
        return body;
    const bool is_free = choice.unit == "auto" && choice.up == "auto" && choice.scale == 1;
    return is_free ? frame_on_body(positions, triangles, body, skin, stature) : std::nullopt;
}

}  // namespace

const std::vector<std::string_view>& unit_choices()
{
    static const std::vector<std::string_view> choices { "auto", "m", "dm", "cm", "mm", "in", "ft" };
    return choices;
}

const std::vector<std::string_view>& axis_choices()
{
    static const std::vector<std::string_view> choices { "auto", "+x", "-x", "+y", "-y", "+z", "-z" };
    return choices;
}

FrameGuess body_frame(const Positions& positions, const Triangles& triangles, const BodyChoice& choice)
{
    const BodySizes sizes { choice.height };
    describe(sizes, CheckRanges());
    FrameGuess guess = apply_choice(guess_body_frame(positions, triangles, known_up(choice), choice.usual_up), choice);
    if (choice.height)
        set_height(guess, positions, triangles, *choice.height);
    return guess;
}

FrameGuess garment_frame(const Positions& positions, const Triangles& triangles, const Frame& body,
                         const GarmentChoice& choice, std::optional<double> stature, const TriangleMesh& skin)
{
    const GarmentSizes sizes { choice.scale };
    describe(sizes, CheckRanges());
    const Triangles cloth = cloth_of(positions, triangles);
    FrameGuess guess = guess_garment_frame(positions, cloth, body);
    const std::optional<Frame> on_body = frame_on_body(positions, cloth, body, choice, skin, stature);
    if (on_body)
        guess = { *on_body, 1, 1,
                  "the garment lies on the body in its file, in the same axes, and in "
                      + (on_body->metres_per_unit == body.metres_per_unit ? "the same unit" : unit_text(*on_body)) };
    else if (choice.up == "auto")
        choose_up(guess, positions, cloth, body);
    guess = apply_choice(guess, choice);
    if (stature && choice.unit == "auto" && choice.scale == 1 && !on_body)
        scale_to_body(guess, positions, cloth, choice.usual_unit.value_or(nearest_unit(body.metres_per_unit)),
                      *stature);
    guess.frame.metres_per_unit *= choice.scale;
    if (choice.scale != 1)
        guess.why += ", scaled by " + rounded_text(choice.scale, 3) + " as given";
    front_of_garment(guess.frame, choice.front);
    return guess;
}

std::optional<Vec3> front_of_body(const Frame& frame, const std::string& axis)
{
    if (axis.empty() || axis == "auto")
        return {};
    return Vec3(frame.rotation() * axis_of(axis));
}

std::optional<Vec3> front_of_garment(const Frame& frame, const std::string& axis)
{
    const std::optional<Vec3> front = front_of_body(frame, axis);
    if (front && std::abs(front->y()) > 0.5)
        throw InvalidInput(ErrorCode::wrong_call,
                           "garment_front: " + axis
                               + " lies along the up axis of the garment; give an axis at a right angle to it, or "
                                 "garment_up, too");
    return front;
}

double height_of(const Positions& positions, const Triangles& triangles, const Frame& frame)
{
    if (triangles.rows() > 0)
        return height_of(positions(triangles.reshaped(), Eigen::all), {}, frame);
    const Eigen::VectorXd heights = positions * frame.up * frame.metres_per_unit;
    return heights.size() > 0 ? heights.maxCoeff() - heights.minCoeff() : 0;
}

}  // namespace garmentfit
