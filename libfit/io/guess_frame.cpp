// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "garmentfit/number_text.h"
#include "garmentfit/units.h"
#include "named_vertices.h"
#include "tuning.h"

namespace garmentfit {
namespace {

/// Area-weighted samples of a surface: one for each triangle.
struct Samples {
    Positions centres, normals;
    Eigen::VectorXd areas;  ///< sum to 1
    Eigen::AlignedBox3d box;
};

Samples samples_of(const Positions& positions, const Triangles& triangles)
{
    Samples samples {
        Positions(triangles.rows(), 3), Positions(triangles.rows(), 3), Eigen::VectorXd(triangles.rows()), {}
    };
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Vec3 a = positions.row(triangles(f, 0)), b = positions.row(triangles(f, 1)),
                   c = positions.row(triangles(f, 2));
        const Vec3 normal = (b - a).cross(c - a);
        samples.centres.row(f) = (a + b + c) / 3;
        samples.normals.row(f) = normal.stableNormalized();
        samples.areas[f] = normal.stableNorm();
        samples.box.extend(a).extend(b).extend(c);
    }
    samples.areas /= std::max(samples.areas.sum(), 1e-300);  // unit: never by 0
    return samples;
}

/// The share of the surface without a counterpart when it is mirrored at its middle across an axis; 0 is a mirror
/// image.
double asymmetry(const Samples& samples, int axis)
{
    const double cell = samples.box.sizes().maxCoeff() / k_symmetry_cells;
    const Vec3 centre = samples.centres.transpose() * samples.areas;
    std::map<std::array<int, 3>, double> left_minus_right;
    for (Eigen::Index s = 0; s < samples.centres.rows(); ++s) {
        Vec3 place = (Vec3(samples.centres.row(s)) - centre) / cell;
        const bool is_left = place[axis] > 0;
        place[axis] = std::abs(place[axis]);
        left_minus_right[{ int(std::floor(place.x())), int(std::floor(place.y())), int(std::floor(place.z())) }]
            += is_left ? samples.areas[s] : -samples.areas[s];
    }
    double difference = 0;
    for (const auto& [place, area] : left_minus_right)
        difference += std::abs(area);
    return difference;
}

struct Shape {
    Vec3 sizes;
    std::array<double, 3> asymmetries;
};

Shape shape_of(const Samples& samples)
{
    return { samples.box.sizes(), { asymmetry(samples, 0), asymmetry(samples, 1), asymmetry(samples, 2) } };
}

/// Evidence that an axis runs from head to foot: humans are longest along it, or as long as their arm span, and no
/// mirror image across it.
double tallness(const Shape& shape, int axis)
{
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const double length = std::log(shape.sizes[axis] / std::max(shape.sizes[b], shape.sizes[c]));
    const double unevenness = std::log((shape.asymmetries[axis] + k_evenness)
                                       / (std::min(shape.asymmetries[b], shape.asymmetries[c]) + k_evenness));
    return k_length_weight * length + unevenness;
}

/// The share of the surface that lies flat at the end of the body in direction `outwards`, as soles do.
double flat_end(const Samples& samples, const Vec3& outwards)
{
    const double size = samples.box.sizes().dot(outwards.cwiseAbs());
    const double end = outwards.dot(samples.box.center()) + 0.5 * size;
    double area = 0;
    for (Eigen::Index s = 0; s < samples.centres.rows(); ++s)
        if (end - samples.centres.row(s).dot(outwards) < k_end_depth * size
            && samples.normals.row(s).dot(outwards) > k_flat_cosine)
            area += samples.areas[s];
    return area;
}

/// Evidence that a body stands the right way up, negative for upside down: soles are flat, a crown is round, and more
/// of the surface is above the middle than below.
double uprightness(const Samples& samples, const Vec3& up)
{
    const double soles = std::log((flat_end(samples, -up) + k_least_sole) / (flat_end(samples, up) + k_least_sole));
    const Vec3 centre = samples.centres.transpose() * samples.areas;
    const double above_middle = up.dot(centre - samples.box.center()) / samples.box.sizes().dot(up.cwiseAbs());
    return soles + std::clamp(k_top_heavy_weight * above_middle, -k_most_top_heavy, k_most_top_heavy);
}

/// The logarithm of a likelihood, 0 for certain, from evidence for (positive) or against (negative).
double log_likelihood(double evidence) { return -std::log1p(std::exp(-2 * evidence)); }

/// From 0, two logarithms of likelihood are equal, towards 1, they are far apart.
double confidence_between(double best, double second) { return 1 - std::exp(second - best); }

struct Ranked {
    int best = 0, second = 0;
    double confidence = 0;  ///< of the first: 0 = several are equally likely, 1 = certain
};

template <std::size_t count>
Ranked rank(const std::array<double, count>& scores)
{
    std::array<int, count> order;
    for (std::size_t i = 0; i < count; ++i)
        order[i] = static_cast<int>(i);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return scores[a] > scores[b]; });
    return { order[0], order[1], confidence_between(scores[order[0]], scores[order[1]]) };
}

Ranked rank_axes(const Samples& samples, const Shape& shape, const std::optional<Vec3>& usual_up)
{
    std::array<double, 6> scores;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const Vec3 up = axis_of(k_axes[i]);
        Eigen::Index axis;
        up.cwiseAbs().maxCoeff(&axis);
        scores[i] = tallness(shape, static_cast<int>(axis)) + log_likelihood(uprightness(samples, up))
            - k_axis_rarity[i] - (usual_up && up != *usual_up ? k_rarity_against_format : 0);
    }
    return rank(scores);
}

/// Ranks units by how usual a length is in them. Units in which it is impossible come last.
Ranked rank_units(double length, double usual, double spread, double least, double largest)
{
    std::array<double, k_known_units.size()> scores;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const double metres = length * k_known_units[i].metres;
        const double deviation = std::log(metres / usual) / spread;
        scores[i] = -0.5 * deviation * deviation - k_known_units[i].log_rarity
            - (metres < least || metres > largest ? k_impossible : 0);
    }
    return rank(scores);
}

std::string text_of_length(double length) { return rounded_text(length, 3); }

std::string unit_name(double metres)
{
    for (const KnownUnit& unit : k_known_units)
        if (unit.metres == metres)
            return std::string(unit.name);
    return text_of_length(metres) + " m";
}

std::string axis_name(const Vec3& axis)
{
    for (const std::string_view name : k_axes)
        if (axis_of(name) == axis)
            return std::string(name);
    return "an oblique axis";
}

bool has_size(const Samples& samples) { return samples.areas.size() > 0 && samples.box.sizes().minCoeff() > 0; }

/// Evidence that a garment is upright along `other` (positive) or `up` (negative): garments are taller than deep, and
/// their front is more like their back than their hem like their collar.
double preference(const Shape& shape, const Vec3& up, const Vec3& other)
{
    Eigen::Index a, b;
    up.cwiseAbs().maxCoeff(&a);
    other.cwiseAbs().maxCoeff(&b);
    return std::log(shape.sizes[b] / shape.sizes[a])
        + k_symmetry_weight * (shape.asymmetries[b] - shape.asymmetries[a]);
}

/// @param unit  m, one with a name @param of_body  m, without a name where its height was given
std::string beside_unit_of_body(double unit, double of_body)
{
    if (unit == of_body)
        return " like the body";
    return unit == nearest_unit(of_body) ? ", the unit nearest to the body's" : " unlike the body";
}

}  // namespace

FrameGuess guess_body_frame(const Positions& positions, const Triangles& triangles, const std::optional<Vec3>& up,
                            const std::optional<Vec3>& usual_up)
{
    require_named_vertices("body", positions.rows(), triangles);
    const Samples samples = samples_of(positions, triangles);
    if (!has_size(samples))
        return { {}, 0, 0, "a flat or empty mesh has no size to judge by: taken for metres with +y up" };
    FrameGuess guess;
    if (up) {
        guess.frame.up = *up;
        guess.up_confidence = 1;
    } else {
        const Ranked axis = rank_axes(samples, shape_of(samples), usual_up);
        guess.frame.up = axis_of(k_axes[axis.best]);
        guess.up_confidence = axis.confidence;
    }

    const double stature = samples.box.sizes().dot(guess.frame.up.cwiseAbs());
    const Ranked unit = rank_units(stature, k_usual_stature, k_stature_spread, k_least_stature, k_largest_stature);
    guess.frame.metres_per_unit = k_known_units[unit.best].metres;
    const double metres = stature * guess.frame.metres_per_unit;
    const bool is_plausible = metres >= k_least_stature && metres <= k_largest_stature;
    guess.unit_confidence = is_plausible ? unit.confidence : 0;
    guess.why = "the body is " + text_of_length(stature) + " units tall along " + axis_name(guess.frame.up)
        + ", read as " + std::string(k_known_units[unit.best].name) + " that is " + text_of_length(metres) + " m"
        + (is_plausible ? "" : ", which no human is: give the unit yourself");
    return guess;
}

FrameGuess guess_garment_frame(const Positions& positions, const Triangles& triangles, const Frame& body)
{
    require_named_vertices("garment", positions.rows(), triangles);
    const Samples samples = samples_of(positions, triangles);
    const double unit_of_body = nearest_unit(body.metres_per_unit);
    FrameGuess guess { body, 0, 0,
                       "a flat or empty mesh has no size to judge by: taken for the units and axes of the body" };
    guess.frame.metres_per_unit = unit_of_body;
    if (!has_size(samples))
        return guess;

    const double longest = samples.box.sizes().maxCoeff();
    const double as_body = longest * unit_of_body;
    if (as_body < k_least_garment || as_body > k_largest_garment) {
        const Ranked unit = rank_units(longest, k_usual_garment, k_garment_spread, k_least_garment, k_largest_garment);
        guess.frame.metres_per_unit = k_known_units[unit.best].metres;
        guess.unit_confidence = unit.confidence;
    } else {
        guess.unit_confidence = confidence_between(std::log(k_largest_garment / k_usual_garment),
                                                   std::abs(std::log(as_body / k_usual_garment)));
    }

    const Vec3 other = std::abs(body.up.y()) > 0.5 ? Vec3::UnitZ() : Vec3::UnitY();
    const double other_is_better = preference(shape_of(samples), body.up, other);
    // Another unit is evidence for another program, whose axes are others as often as not: the shape decides.
    const double least = guess.frame.metres_per_unit == unit_of_body ? k_clear_preference : 0;
    if (other_is_better > least)
        guess.frame.up = other;
    guess.up_confidence = confidence_between(std::abs(other_is_better - least), 0);
    guess.why = "the garment's longest side is " + text_of_length(longest) + " units, "
        + text_of_length(longest * guess.frame.metres_per_unit) + " m in " + unit_name(guess.frame.metres_per_unit)
        + beside_unit_of_body(guess.frame.metres_per_unit, body.metres_per_unit) + ", and it hangs along "
        + axis_name(guess.frame.up) + (guess.frame.up == body.up ? " like the body" : " unlike the body");
    return guess;
}

}  // namespace garmentfit
