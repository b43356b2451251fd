// SPDX-License-Identifier: GPL-3.0-or-later
#include "min_max_pyramid.h"

#include <cmath>

#include "parallel.h"
#include "tuning.h"

namespace garmentfit {
namespace {

constexpr double k_max_nodes = 3e4;  // unit: a limit of time; a garment far too large gets a coarser grid

template <class Visit>
void for_each_corner(const Eigen::Vector3i& low, const Eigen::Vector3i& high, const Visit& visit)
{
    for (int z = low.z(); z <= high.z(); ++z)
        for (int y = low.y(); y <= high.y(); ++y)
            for (int x = low.x(); x <= high.x(); ++x)
                visit(Eigen::Vector3i(x, y, z));
}

}  // namespace

MinMaxPyramid::MinMaxPyramid(const ClothTree& cloth, const Vec3& low, const Vec3& high)
{
    const Vec3 extent = high - low + Vec3::Constant(2 * k_grid_border);
    spacing_ = std::max(k_pyramid_spacing, std::cbrt(extent.prod() / k_max_nodes));
    origin_ = low - Vec3::Constant(k_grid_border);
    Level level;
    level.size = (extent / spacing_).array().ceil().cast<int>() + 2;
    level.nodes.resize(std::size_t(level.size.prod()));
    parallel_for<int>(level.size.z(), [&](int z) {
        for_each_corner({ 0, 0, z }, { level.size.x() - 1, level.size.y() - 1, z }, [&](const Eigen::Vector3i& c) {
            const Vec3 place = origin_ + spacing_ * c.cast<double>();
            const float distance = cloth.distance(place);
            level.nodes[level.index(c)] = { distance, -distance, -float(inside_of(cloth.winding(place))), 0 };
        });
    });
    levels_.push_back(std::move(level));
    while (levels_.back().size.maxCoeff() > 1)
        levels_.push_back(coarsen(levels_.back()));
}

MinMaxPyramid::Level MinMaxPyramid::coarsen(const Level& level) const
{
    Level next;
    next.size = (level.size.array() + 1) / 2;
    for_each_corner(Eigen::Vector3i::Zero(), next.size - Eigen::Vector3i::Ones(), [&](const Eigen::Vector3i& c) {
        const Eigen::Vector3i low = 2 * c,
                              high = (low + Eigen::Vector3i::Ones()).cwiseMin(level.size - Eigen::Vector3i::Ones());
        Extremes extremes = level.at(low);
        for_each_corner(low, high, [&](const Eigen::Vector3i& child) { extremes = extremes.min(level.at(child)); });
        next.nodes.push_back(extremes);
    });
    return next;
}

Clearance MinMaxPyramid::at(const Vec3& point) const
{
    const Level& nodes = levels_[0];
    const Vec3 last = (nodes.size.array() - 1).cast<double>();
    const Vec3 wanted = (point - origin_) / spacing_;
    const Vec3 cell = wanted.cwiseMax(0).cwiseMin(last);
    const Eigen::Vector3i c = cell.cast<int>().cwiseMin(nodes.size - Eigen::Vector3i::Constant(2));
    const Vec3 t = cell - c.cast<double>();
    Clearance clearance;
    for_each_corner(Eigen::Vector3i::Zero(), Eigen::Vector3i::Ones(), [&](const Eigen::Vector3i& corner) {
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis)
            weight *= corner[axis] ? t[axis] : 1 - t[axis];
        const Extremes& node = nodes.at(c + corner);
        clearance.distance += weight * node[0];
        clearance.inside -= weight * node[2];
    });
    const double beyond = spacing_ * (wanted - cell).norm();  // outside of the grid
    return { clearance.distance + beyond, beyond > 0 ? 0.0 : clearance.inside };
}

ClearanceRange MinMaxPyramid::range_in(const Vec3& centre, const Vec3& half_size) const
{
    const Vec3 last = (levels_[0].size.array() - 1).cast<double>();
    const Vec3 wanted_low = (centre - half_size - origin_) / spacing_,
               wanted_high = (centre + half_size - origin_) / spacing_;
    const Vec3 within_low = wanted_low.cwiseMax(0).cwiseMin(last), within_high = wanted_high.cwiseMax(0).cwiseMin(last);
    Eigen::Vector3i low = within_low.cast<int>(), high = within_high.cast<int>();  // rounded down, and up
    for (int axis = 0; axis < 3; ++axis)
        high[axis] += high[axis] < within_high[axis];
    std::size_t level = 0;  // on which no more than two nodes along each axis cover the box
    for (; level + 1 < levels_.size() && (high - low).maxCoeff() > 1; ++level)
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] >>= 1;
            high[axis] >>= 1;
        }
    const Level& nodes = levels_[level];
    Extremes extremes = nodes.at(low);
    for (int z = low.z(); z <= high.z(); ++z)
        for (int y = low.y(); y <= high.y(); ++y) {
            const Extremes* const row = &nodes.at({ 0, y, z });
            extremes = extremes.min(row[low.x()]).min(row[high.x()]);
        }
    ClearanceRange range { extremes[0], -extremes[1], -extremes[2] };
    const Vec3 beyond = (-wanted_low).cwiseMax(wanted_high - last).cwiseMax(0);
    range.furthest += spacing_ * beyond.norm();
    return range;
}

}  // namespace garmentfit
