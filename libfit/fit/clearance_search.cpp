// SPDX-License-Identifier: GPL-3.0-or-later
#include "clearance_search.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace garmentfit {
namespace {

struct Cell {
    double bound;
    int order;  // of creation; of cells with the same bound, the first wins
    Vec3 centre, half_size;
    bool is_place = false;  // its bound is its value

    bool operator<(const Cell& other) const
    {
        return bound < other.bound || (bound == other.bound && order > other.order);
    }
};

}  // namespace

ClearanceSearch::ClearanceSearch(const MinMaxPyramid& clearance, std::vector<ClearanceSample> samples,
                                 const Vec3& slope, const Slab& slab) :
    clearance_(clearance),
    samples_(std::move(samples)), slope_(slope), slab_(slab)
{
}

double ClearanceSearch::value(const Vec3& at) const
{
    double sum = slope_.dot(at);
    for (const ClearanceSample& sample : samples_)
        sum += clearance_value(clearance_.at(at + sample.offset), sample.radius);
    return sum;
}

// derived: in docs/fit.md. The value rises with the distance inside, falls with it outside, and is greater inside.
double ClearanceSearch::bound(const Vec3& centre, const Vec3& half_size) const
{
    double sum = slope_.dot(centre) + slope_.cwiseAbs().dot(half_size);
    for (const ClearanceSample& sample : samples_) {
        const ClearanceRange range = clearance_.range_in(centre + sample.offset, half_size);
        sum += range.most_inside * inside_value(range.furthest, sample.radius)
            - (1 - range.most_inside) * std::min(range.nearest, k_outside_cap);
    }
    return sum;
}

std::vector<Place> ClearanceSearch::find_best(const Vec3& low, const Vec3& high, double spacing, double apart,
                                              std::size_t count) const
{
    std::priority_queue<Cell> cells;
    int created = 0;
    const auto add = [&](const Vec3& centre, const Vec3& half_size) {
        if (!slab_.misses(centre, half_size))
            cells.push({ bound(centre, half_size), created++, centre, half_size });
    };
    // Halves the box along the axes that are longer than `longest`.
    const auto split = [&](const Vec3& centre, const Vec3& half_size, double longest) {
        const Eigen::Array3i parts = (half_size.array() > 0.5 * longest).select(Eigen::Array3i::Constant(2), 1);
        const Vec3 half = half_size.cwiseQuotient(parts.cast<double>().matrix());
        for (int x = 0; x < parts.x(); ++x)
            for (int y = 0; y < parts.y(); ++y)
                for (int z = 0; z < parts.z(); ++z)
                    add(centre - half_size + half.cwiseProduct(Vec3(2 * x + 1, 2 * y + 1, 2 * z + 1)), half);
    };
    add(0.5 * (low + high), 0.5 * (high - low));

    std::vector<Place> places;
    while (!cells.empty() && places.size() < count) {
        const Cell cell = cells.top();
        cells.pop();
        const bool is_near = std::any_of(places.begin(), places.end(), [&](const Place& better) {
            return (better.at - cell.centre).norm() + cell.half_size.norm() < apart;
        });
        if (is_near)
            continue;
        if (cell.is_place) {
            if (std::none_of(places.begin(), places.end(),
                             [&](const Place& better) { return (better.at - cell.centre).norm() < apart; }))
                places.push_back({ cell.centre, cell.bound });
        } else if (2 * cell.half_size.maxCoeff() > spacing) {
            split(cell.centre, cell.half_size, std::max(spacing, cell.half_size.maxCoeff()));
        } else if (!slab_.misses(cell.centre, Vec3::Zero())) {
            cells.push({ value(cell.centre), created++, cell.centre, Vec3::Zero(), true });
        }
    }
    return places;
}

}  // namespace garmentfit
