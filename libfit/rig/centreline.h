// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "cross_section.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// The line through the middle of a limb or of the trunk, from where it leaves the body outwards, with the girths along
/// it.
struct Centreline {
    std::vector<Vec3> points;  ///< about evenly spaced
    std::vector<Vec3> axes;  ///< unit tangents, outwards
    std::vector<double> girths;  ///< m; 0 where the plane across finds no outline
    std::vector<bool> free;  ///< the outline there belongs to this limb alone
    std::vector<bool> across;  ///< and is about round: the plane does not run along the limb
    std::vector<double> arcs;  ///< m from the first point

    int first_free = 0;  ///< from here outwards the limb is clear of the trunk

    int size() const { return int(points.size()); }
    double length() const { return arcs.back(); }
    Vec3 at(double arc) const;  ///< by linear interpolation, the ends' points beyond the ends
    int nearest_row(const Vec3& point) const;
};

/// Points and arcs only; resampled to even spacing.
Centreline polyline(const std::vector<Vec3>& points, double spacing);

/// Whether a vertex of the surface belongs to something else than the limb that is being cut.
using IsForeign = std::function<bool(int vertex)>;

/// Whether an outline belongs to one limb alone: next to nothing of it is foreign.
bool is_free(const CrossSection& section, const IsForeign& is_foreign);

/// @param curve    through the inside, e.g. from a curve skeleton
/// @param spacing  m between cuts
Centreline centreline(const Slicer& slicer, const std::vector<Vec3>& curve, double spacing,
                      const IsForeign& is_foreign);

}  // namespace garmentfit
