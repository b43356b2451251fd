// SPDX-License-Identifier: GPL-3.0-or-later
#include "front_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "quantile.h"
#include "tuning.h"

namespace garmentfit {
namespace {

struct Point {
    double across, height, forwards;  // m; `across` from the middle
};

template <class Keep, class Value>
std::vector<double> collect(const std::vector<Point>& points, const Keep& keep, const Value& value)
{
    std::vector<double> values;
    for (const Point& point : points)
        if (keep(point))
            values.push_back(value(point));
    return values;
}

double breadth(const Point& point) { return std::abs(point.across); }
double forwards(const Point& point) { return point.forwards; }
bool any(const Point&) { return true; }

std::vector<Point> in_body_axes(const std::vector<ClothPatch>& cloth, const Vec3& front)
{
    const Vec3 left = Vec3::UnitY().cross(front);
    std::vector<Point> points;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const ClothPatch& patch : cloth) {
        const Vec3 p = patch.centre.cast<double>();
        points.push_back({ p.dot(left), p.y(), p.dot(front) });
        least = std::min(least, points.back().across);
        most = std::max(most, points.back().across);
    }
    for (Point& point : points)
        point.across -= 0.5 * (least + most);
    return points;
}

// Twice the middle between the foremost and the hindmost cloth of a slice, against its sides, m.
std::optional<double> middle_against_sides(const std::vector<Point>& slice)
{
    if (slice.size() < k_min_slice)
        return {};
    const double width = quantile(collect(slice, any, breadth), 0.97);
    const auto middle = collect(
                   slice, [&](const Point&p) { return breadth(p) < k_slice_middle * width; }, forwards),
               sides = collect(
                   slice, [&](const Point&p) { return breadth(p) > k_slice_sides * width; }, forwards);
    if (middle.empty() || sides.empty())
        return {};
    return quantile(middle, 0.97) + quantile(middle, 0.03) - 2 * quantile(sides, 0.5);
}

Vec3 mean_of(const std::vector<Vec3>& points)
{
    Vec3 sum = Vec3::Zero();
    for (const Vec3& point : points)
        sum += point;
    return sum / double(points.size());
}

const Opening* highest(const std::vector<Opening>& openings, double width)
{
    const Opening* top = nullptr;
    for (const Opening& opening : openings)
        if (opening.girth > k_wide_rim * width && (!top || opening.centre.y() > top->centre.y()))
            top = &opening;
    return top;
}

std::vector<Vec3> low_centres(const std::vector<Opening>& openings, double middle_height)
{
    std::vector<Vec3> centres;
    for (const Opening& opening : openings)
        if (opening.centre.y() < middle_height)
            centres.push_back(opening.centre);
    return centres;
}

}  // namespace

FrontShape front_shape(const std::vector<ClothPatch>& cloth, const std::vector<Opening>& openings,
                       const GarmentCues& cues, const Vec3& front)
{
    const std::vector<Point> points = in_body_axes(cloth, front);
    const auto heights = collect(points, any, [](const Point& p) { return p.height; });
    const double low = *std::min_element(heights.begin(), heights.end()),
                 high = *std::max_element(heights.begin(), heights.end()), tall = std::max(high - low, 1e-9);
    const auto top = collect(
        points, [&](const Point& p) { return p.height > high - 0.2 * tall; }, breadth);
    const double width = std::max(2 * quantile(top, 0.95), 1e-9);
    const auto in_tenths
        = [&](double offset) { return std::clamp(10 * offset / width, -k_max_front_shape, k_max_front_shape); };

    FrontShape shape;
    std::array<std::vector<Point>, k_front_slices> slices;
    for (const Point& point : points)
        slices[std::min(std::size_t((point.height - low) / tall * k_front_slices), k_front_slices - 1)].push_back(
            point);
    int count = 0;
    for (const std::vector<Point>& slice : slices)
        if (const auto offset = middle_against_sides(slice)) {
            shape.torso += in_tenths(*offset);
            ++count;
        }
    shape.torso /= std::max(count, 1);
    shape.waist = in_tenths(middle_against_sides(slices.back()).value_or(0));
    const Opening* neck = highest(openings, width);
    if (!neck)
        return shape;
    const std::vector<Vec3> hems = low_centres(openings, low + 0.5 * tall);
    if (!hems.empty())
        shape.hems = in_tenths(front.dot(mean_of(hems) - neck->centre));
    if (!cues.cuffs.empty())
        shape.cuffs = in_tenths(front.dot(mean_of(cues.cuffs) - neck->centre));
    return shape;
}

}  // namespace garmentfit
