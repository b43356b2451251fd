// SPDX-License-Identifier: GPL-3.0-or-later
#include "centreline.h"

#include <algorithm>
#include <numbers>

#include "tuning.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

std::vector<double> arcs_along(const std::vector<Vec3>& points)
{
    std::vector<double> arcs { 0 };
    for (std::size_t i = 1; i < points.size(); ++i)
        arcs.push_back(arcs.back() + (points[i] - points[i - 1]).norm());
    return arcs;
}

std::vector<Vec3> resample(const Centreline& line, double spacing)
{
    const int steps = std::max(2, int(line.length() / spacing + 0.5));
    std::vector<Vec3> points;
    for (int i = 0; i <= steps; ++i)
        points.push_back(line.at(line.length() * i / steps));
    return points;
}

/// derived: binomial filter.
void smooth(std::vector<Vec3>& points)
{
    const std::vector<Vec3> before = points;
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
        points[i] = 0.25 * before[i - 1] + 0.5 * before[i] + 0.25 * before[i + 1];
}

std::vector<Vec3> tangents(const std::vector<Vec3>& points)
{
    const int n = int(points.size());
    std::vector<Vec3> result;
    for (int i = 0; i < n; ++i)
        result.push_back(
            (points[std::min(i + k_half_window, n - 1)] - points[std::max(i - k_half_window, 0)]).normalized());
    return result;
}

double roundness(const CrossSection& section)
{
    return 4 * std::numbers::pi * section.area / (section.girth * section.girth);
}

/// The first of several consecutive cuts that are free and across the limb.
int first_free(const Centreline& line)
{
    int in_a_row = 0;
    for (int i = 0; i < line.size(); ++i) {
        in_a_row = line.free[i] && line.across[i] ? in_a_row + 1 : 0;
        if (in_a_row == k_free_in_a_row)
            return i + 1 - k_free_in_a_row;
    }
    return line.size() - 1;
}

Centreline cut_along(const Slicer& slicer, std::vector<Vec3> points, const IsForeign& is_foreign)
{
    Centreline line;
    line.axes = tangents(points);
    line.girths.assign(points.size(), 0);
    line.free.assign(points.size(), false);
    line.across.assign(points.size(), false);
    std::vector<Vec3> middles = points;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (const auto section = slicer.cut(points[i], line.axes[i])) {
            middles[i] = section->centroid;
            line.girths[i] = section->girth;
            line.free[i] = is_free(*section, is_foreign);
            line.across[i] = roundness(*section) > k_roundness;
        }
    line.points = std::move(points);
    line.first_free = first_free(line);
    for (int i = line.first_free; i < line.size(); ++i)
        if (line.free[i] && line.across[i])
            line.points[i] = middles[i];
    line.arcs = arcs_along(line.points);
    return line;
}

}  // namespace

Vec3 Centreline::at(double arc) const
{
    const auto above = std::upper_bound(arcs.begin(), arcs.end(), arc);
    if (above == arcs.begin())
        return points.front();
    if (above == arcs.end())
        return points.back();
    const std::size_t i = above - arcs.begin();
    const double t = (arc - arcs[i - 1]) / (arcs[i] - arcs[i - 1]);
    return points[i - 1] + t * (points[i] - points[i - 1]);
}

int Centreline::nearest_row(const Vec3& point) const
{
    const auto nearer = [&](const Vec3& a, const Vec3& b) { return (a - point).norm() < (b - point).norm(); };
    return int(std::min_element(points.begin(), points.end(), nearer) - points.begin());
}

Centreline polyline(const std::vector<Vec3>& points, double spacing)
{
    Centreline line;
    line.points = points;
    line.arcs = arcs_along(points);
    line.points = resample(line, spacing);
    line.arcs = arcs_along(line.points);
    return line;
}

bool is_free(const CrossSection& section, const IsForeign& is_foreign)
{
    const auto foreign = std::count_if(section.vertices.begin(), section.vertices.end(), is_foreign);
    return double(foreign) <= k_foreign_share * double(section.vertices.size());
}

Centreline centreline(const Slicer& slicer, const std::vector<Vec3>& curve, double spacing, const IsForeign& is_foreign)
{
    Centreline line = polyline(curve, spacing);
    for (int round = 0; round < k_centring_rounds; ++round) {
        std::vector<Vec3> points = resample(line, spacing);
        smooth(points);
        line = cut_along(slicer, std::move(points), is_foreign);
    }
    return line;
}

}  // namespace garmentfit
