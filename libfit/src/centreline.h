// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "cross_section.h"
#include "fit/types.h"

namespace fit {

/// The line through the middle of a limb or of the trunk, from where it leaves the body outwards, with the girths along it.
struct Centreline {
    std::vector<Vec3> points;    ///< about evenly spaced
    std::vector<Vec3> axes;      ///< unit tangents, outwards
    std::vector<double> girths;  ///< m; 0 where the plane across cuts more than this limb, or nothing
    std::vector<double> arcs;    ///< m from the first point

    int first_free = 0;          ///< from here outwards the limb is an outline of its own, clear of the trunk

    int size() const { return int(points.size()); }
    double length() const { return arcs.back(); }
    Vec3 at(double arc) const;   ///< by linear interpolation, the ends' points beyond the ends
    int nearest(double arc) const;
};

/// @param curve    through the inside, e.g. from a curve skeleton
/// @param spacing  m between cuts
/// @param grows_from_trunk  true for limbs and head: where the outline suddenly swells, going inwards, the trunk begins
Centreline centreline(const Slicer& slicer, const std::vector<Vec3>& curve, double spacing, bool grows_from_trunk);

}  // namespace fit
