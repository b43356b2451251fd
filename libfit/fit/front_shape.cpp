// SPDX-License-Identifier: GPL-3.0-or-later
#include "front_shape.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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
    const double width = quantile(collect(slice, any, breadth), k_outermost);
    const auto middle = collect(
                   slice, [&](const Point&p) { return breadth(p) < k_slice_middle * width; }, forwards),
               sides = collect(
                   slice, [&](const Point&p) { return breadth(p) > k_slice_sides * width; }, forwards);
    if (middle.empty() || sides.empty())
        return {};
    return quantile(middle, k_outermost) + quantile(middle, 1 - k_outermost) - 2 * quantile(sides, 0.5);
}

Vec3 mean_of(const std::vector<Vec3>& points)
{
    Vec3 sum = Vec3::Zero();
    for (const Vec3& point : points)
        sum += point;
    return sum / double(points.size());
}

std::vector<Vec3> low_centres(const std::vector<Opening>& openings, double middle_height)
{
    std::vector<Vec3> centres;
    for (const Opening& opening : openings)
        if (opening.centre.y() < middle_height)
            centres.push_back(opening.centre);
    return centres;
}

// Of a slice, between its front and its back, m along the front. @pre not empty
double depth_at(const std::vector<Point>& slice, double share)
{
    return quantile(collect(slice, any, forwards), share);
}
double middle_of(const std::vector<Point>& slice)
{
    return 0.5 * (depth_at(slice, 1 - k_outermost) + depth_at(slice, k_outermost));
}

std::vector<Point> between(const std::vector<Point>& points, double low, double high)
{
    std::vector<Point> slice;
    std::copy_if(points.begin(), points.end(), std::back_inserter(slice),
                 [&](const Point& p) { return p.height >= low && p.height < high; });
    return slice;
}

// Twice the middle of the cloth about the plane of symmetry, in a thin slice around a height, m.
std::optional<double> middle_line(const std::vector<Point>& points, double height, double width)
{
    std::vector<Point> slice = between(points, height - k_thin_slice * width, height + k_thin_slice * width);
    std::erase_if(slice, [&](const Point& p) { return breadth(p) > 0.5 * k_slice_middle_line * width; });
    if (slice.size() < k_min_line)
        return {};
    return depth_at(slice, k_outermost_of_few) + depth_at(slice, 1 - k_outermost_of_few);
}

// Of the seat and the belly against the rim, m. Above the lowest place of a rim that is higher behind there is a back only.
double seat_of(const std::vector<Point>& points, double rim_low, double width)
{
    const auto rim = middle_line(points, rim_low - k_rim_depth * width, width),
               seat = middle_line(points, rim_low - k_seat_depth * width, width);
    return rim && seat ? *seat - *rim : 0;
}

// Breadth in front less breadth behind at the height of the lap, m.
double lap_of(const std::vector<Point>& points, double high, double width)
{
    const std::vector<Point> slice = between(points, high - k_lap_low * width, high - k_lap_high * width);
    if (slice.size() < k_min_slice)
        return 0;
    const double back = depth_at(slice, 1 - k_outermost_of_lap), front = depth_at(slice, k_outermost_of_lap),
                 middle = 0.5 * (front + back), quarter = 0.25 * (front - back);
    const auto before = collect(
                   slice, [&](const Point&p) { return p.forwards > middle + quarter; }, breadth),
               behind = collect(
                   slice, [&](const Point&p) { return p.forwards < middle - quarter; }, breadth);
    return quantile(before, k_outermost_of_few) - quantile(behind, k_outermost_of_few);
}

// Of the highest and the lowest slice against those between them, m.
double bow_of(const std::vector<std::vector<Point>>& slices)
{
    if (std::any_of(slices.begin(), slices.end(), [](const auto& slice) { return slice.size() < k_min_line; }))
        return 0;
    const std::size_t last = slices.size() - 1, half = slices.size() / 2;
    return 0.5
        * (middle_of(slices[0]) + middle_of(slices[last]) - middle_of(slices[half - 1]) - middle_of(slices[half]));
}

// Of the rear quarter of an opening's rim above its front quarter, m.
double rise_of(const Opening& opening, const Vec3& front)
{
    const Eigen::VectorXd forwards = opening.rim * front;
    const double quarter = 0.25 * (forwards.maxCoeff() - forwards.minCoeff());
    std::vector<double> behind, before;
    for (int i = 0; i < forwards.size(); ++i) {
        if (forwards[i] <= forwards.minCoeff() + quarter)
            behind.push_back(opening.rim(i, 1));
        if (forwards[i] >= forwards.maxCoeff() - quarter)
            before.push_back(opening.rim(i, 1));
    }
    return quantile(behind, 0.5) - quantile(before, 0.5);
}

// Cloth behind less cloth in front of the middle of its slice, as a share of all of it, about the plane of symmetry.
double bare_of(const std::vector<std::vector<Point>>& slices, double width)
{
    int behind = 0, all = 0;
    for (const std::vector<Point>& slice : slices) {
        if (slice.empty())
            continue;
        const double middle = middle_of(slice);
        for (const Point& point : slice)
            if (breadth(point) < 0.5 * k_slice_middle * width) {
                behind += point.forwards < middle ? 1 : -1;
                ++all;
            }
    }
    return double(behind) / std::max(all, 1);
}

std::vector<std::vector<Point>> slices_of(const std::vector<Point>& points, double low, double high, std::size_t count)
{
    std::vector<std::vector<Point>> slices(count);
    for (const Point& point : points)
        slices[std::min(std::size_t((point.height - low) / (high - low) * double(count)), count - 1)].push_back(point);
    return slices;
}

}  // namespace

const Opening* highest_opening(const std::vector<Opening>& openings, double least_girth)
{
    const Opening* top = nullptr;
    for (const Opening& opening : openings)
        if (opening.girth > least_girth && (!top || opening.centre.y() > top->centre.y()))
            top = &opening;
    return top;
}

FrontShape front_shape(const std::vector<ClothPatch>& cloth, const std::vector<Opening>& openings,
                       const GarmentCues& cues, const Vec3& front)
{
    const std::vector<Point> points = in_body_axes(cloth, front);
    const auto heights = collect(points, any, [](const Point& p) { return p.height; });
    const double low = *std::min_element(heights.begin(), heights.end()),
                 high = *std::max_element(heights.begin(), heights.end()), tall = std::max(high - low, 1e-9);
    const auto top = collect(
        points, [&](const Point& p) { return p.height > high - k_shoulder_share * tall; }, breadth);
    const double width = std::max(2 * quantile(top, k_outermost_of_few), 1e-9);
    const auto in_tenths = [&](double offset, double most = k_max_front_shape) {
        return std::clamp(offset / (k_tenth * width), -most, most);
    };

    FrontShape shape;
    const std::vector<std::vector<Point>> slices = slices_of(points, low, low + tall, k_front_slices);
    int count = 0;
    for (const std::vector<Point>& slice : slices)
        if (const auto offset = middle_against_sides(slice)) {
            shape.torso += in_tenths(*offset);
            ++count;
        }
    shape.torso /= std::max(count, 1);
    shape.waist = in_tenths(middle_against_sides(slices.back()).value_or(0));
    const Opening* neck = highest_opening(openings, k_wide_rim * width);
    const double rim = neck ? neck->rim.col(1).minCoeff() : high;
    shape.seat = in_tenths(seat_of(points, rim, width), k_max_seat_shape);
    shape.lap = in_tenths(lap_of(points, high, width), k_max_seat_shape);
    shape.bow = in_tenths(bow_of(slices));
    shape.bare = std::clamp(bare_of(slices_of(points, low, low + tall, k_bare_slices), width) / k_tenth, -k_max_bare,
                            k_max_bare);
    if (!neck)
        return shape;
    shape.rise = in_tenths(rise_of(*neck, front), k_max_seat_shape);
    const std::vector<Vec3> hems = low_centres(openings, low + 0.5 * tall);
    if (!hems.empty())
        shape.hems = in_tenths(front.dot(mean_of(hems) - neck->centre));
    if (!cues.cuffs.empty())
        shape.cuffs = in_tenths(front.dot(mean_of(cues.cuffs) - neck->centre));
    return shape;
}

double profile_of(const std::vector<ClothPatch>& cloth, const Skeleton& worn, const Vec3& front)
{
    const Vec3 left = Vec3::UnitY().cross(front), hips = 0.5 * (worn.head(lfemur) + worn.head(rfemur));
    const double shoulders = (worn.head(lhumerus) - worn.head(rhumerus)).norm();
    const auto middle = [&](double height) -> std::optional<double> {
        std::vector<double> depths;
        for (const ClothPatch& patch : cloth)
            if (const Vec3 p = patch.centre.cast<double>() - hips;
                std::abs(p.y() - height) < k_profile_slice * shoulders && std::abs(p.dot(left)) < 0.5 * shoulders)
                depths.push_back(p.dot(front));
        if (depths.size() < k_min_slice)
            return {};
        return quantile(depths, k_outermost_of_few) + quantile(depths, 1 - k_outermost_of_few);
    };
    const auto chest = middle(worn.head(thorax).y() - hips.y()), seat = middle(0);
    if (!chest || !seat)
        return 0;
    return std::clamp((*chest - *seat) / (k_tenth * shoulders), -k_max_front_shape, k_max_front_shape);
}

}  // namespace garmentfit
