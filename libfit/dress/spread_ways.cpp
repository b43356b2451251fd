// SPDX-License-Identifier: GPL-3.0-or-later
#include "spread_ways.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nearest.h"
#include "parallel.h"
#include "tuning.h"

namespace garmentfit {

Positions spread_ways(const Positions& places, const Positions& ways, double radius)
{
    std::vector<int> moved;
    for (int v = 0; v < int(places.rows()); ++v)
        if (!ways.row(v).isZero(0))
            moved.push_back(v);
    Positions spread = Positions::Zero(places.rows(), 3);
    if (moved.empty())
        return spread;
    const Positions from = places(moved, Eigen::all);
    const NearestPoint tree(from);
    parallel_for(places.rows(), [&](Eigen::Index v) {
        double sum = 0, share = 0;
        Vec3 way = Vec3::Zero();
        for (const int i : tree.within(places.row(v), radius, k_most_ways)) {
            const double apart = (from.row(i) - places.row(v)).norm() / radius, near = std::pow(1 - apart * apart, 2),
                         weight = std::pow(near, 3);  // the nearest count most
            way += weight * ways.row(moved[i]).transpose();
            sum += weight;
            share = std::max(share, near);
        }
        if (sum > 0)
            spread.row(v) = share * way / sum;
    });
    return spread;
}

}  // namespace garmentfit
