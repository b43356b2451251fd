// SPDX-License-Identifier: GPL-3.0-or-later
#include "centreline.h"

#include <algorithm>

namespace fit {
namespace {

constexpr int k_half_window = 3;   // cuts either side that a tangent is read from
constexpr int k_rounds = 2;        // of moving the line to the middle of its cuts
constexpr double k_swell = 1.3;    // from one cut to the next: more than a muscle, less than limb and trunk together

std::vector<double> arcs_along(const std::vector<Vec3>& points)
{
    std::vector<double> arcs { 0 };
    for (std::size_t i = 1; i < points.size(); ++i)
        arcs.push_back(arcs.back() + (points[i] - points[i - 1]).norm());
    return arcs;
}

std::vector<Vec3> resampled(const Centreline& line, double spacing)
{
    const int steps = std::max(2, int(line.length() / spacing + 0.5));
    std::vector<Vec3> points;
    for (int i = 0; i <= steps; ++i)
        points.push_back(line.at(line.length() * i / steps));
    return points;
}

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
        result.push_back((points[std::min(i + k_half_window, n - 1)] - points[std::max(i - k_half_window, 0)]).normalized());
    return result;
}

/// The first cut, seen from the trunk, that belongs to the limb alone.
int first_free(const std::vector<double>& girths)
{
    int i = int(girths.size()) / 2;
    while (i > 0 && girths[i] == 0)  // the middle may lie in a deep bend
        --i;
    for (; i > 0; --i)
        if (girths[i - 1] == 0 || girths[i - 1] > k_swell * girths[i])
            return i;
    return 0;
}

Centreline cut_along(const Slicer& slicer, std::vector<Vec3> points, bool grows_from_trunk)
{
    Centreline line;
    line.axes = tangents(points);
    std::vector<Vec3> middles = points;
    line.girths.assign(points.size(), 0);
    for (std::size_t i = 0; i < points.size(); ++i)
        if (const auto section = slicer.cut(points[i], line.axes[i])) {
            middles[i] = section->centroid;
            line.girths[i] = section->girth;
        }
    line.first_free = grows_from_trunk ? first_free(line.girths) : 0;
    for (int i = line.first_free; i < int(points.size()); ++i)
        points[i] = middles[i];
    for (int i = 0; i < line.first_free; ++i)
        line.girths[i] = 0;
    line.arcs = arcs_along(points);
    line.points = std::move(points);
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

int Centreline::nearest(double arc) const
{
    const auto nearer = [&](double a, double b) { return std::abs(a - arc) < std::abs(b - arc); };
    return int(std::min_element(arcs.begin(), arcs.end(), nearer) - arcs.begin());
}

Centreline centreline(const Slicer& slicer, const std::vector<Vec3>& curve, double spacing, bool grows_from_trunk)
{
    Centreline line;
    line.points = curve;
    line.arcs = arcs_along(curve);
    for (int round = 0; round < k_rounds; ++round) {
        std::vector<Vec3> points = resampled(line, spacing);
        smooth(points);
        line = cut_along(slicer, std::move(points), grows_from_trunk);
    }
    return line;
}

}  // namespace fit
