// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The places where a rigid set of samples has the most clearance, by branch and bound: the best place is certain
// without trying all of them. docs/fit.md derives the bound.

#include <cmath>
#include <limits>
#include <vector>

#include "min_max_pyramid.h"

namespace garmentfit {

/// A point of the set, and the radius of its limb.
struct ClearanceSample {
    Vec3 offset;  // m
    double radius;  // m
};

struct Place {
    Vec3 at;
    double value;  // m
};

/// The space between two parallel planes; by default all of it.
struct Slab {
    Vec3 middle = Vec3::Zero();  // m
    Vec3 across = Vec3::UnitX();
    double half_width = std::numeric_limits<double>::infinity();  // m

    bool misses(const Vec3& centre, const Vec3& half_size) const
    {
        return std::abs(across.dot(centre - middle)) > half_width + across.cwiseAbs().dot(half_size);
    }
};

class ClearanceSearch {
public:
    /// Keeps a reference to `clearance`.
    /// @param slope  value of a metre along each axis, m/m
    /// @param slab  places outside of it do not count
    ClearanceSearch(const MinMaxPyramid& clearance, std::vector<ClearanceSample> samples, const Vec3& slope,
                    const Slab& slab = {});

    double value(const Vec3& at) const;  ///< m

    /// An upper bound of the value in the box about `centre`, m.
    double bound(const Vec3& centre, const Vec3& half_size) const;

    /// The best places of a grid no coarser than `spacing`, best first, none nearer to a better one than `apart`, m.
    std::vector<Place> find_best(const Vec3& low, const Vec3& high, double spacing, double apart,
                                 std::size_t count) const;

private:
    const MinMaxPyramid& clearance_;
    std::vector<ClearanceSample> samples_;
    Vec3 slope_;
    Slab slab_;
};

}  // namespace garmentfit
