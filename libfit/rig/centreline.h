// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "cross_section.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// The line through the middle of a limb or of the trunk, outwards, with the girths along it.
struct Centreline {
    std::vector<Vec3> points;  ///< about evenly spaced
    std::vector<Vec3> axes;  ///< unit tangents, outwards
    std::vector<double> girths;  ///< m; 0 where the cutting plane has no outline
    std::vector<bool> free;  ///< whether the outline belongs to this limb only
    std::vector<bool> across;  ///< whether the outline is round enough: the plane cuts across the limb
    std::vector<double> arcs;  ///< m from the first point

    int first_free = 0;  ///< from this row outwards the limb is separate from the trunk

    int size() const { return int(points.size()); }
    double length() const { return arcs.back(); }
    Vec3 at(double arc) const;  ///< linear interpolation; the end points beyond the ends
    int nearest_row(const Vec3& point) const;
};

/// Points and arcs only, resampled to equal spacing.
Centreline polyline(const std::vector<Vec3>& points, double spacing);

/// Whether a vertex of the surface belongs to another part than the limb that is cut.
using IsForeign = std::function<bool(int vertex)>;

/// Whether an outline belongs to one limb only: hardly any of its vertices are foreign.
bool is_free(const CrossSection& section, const IsForeign& is_foreign);

/// Cuts the surface across a curve and moves the line to the centroids of the cuts.
/// @param curve    inside the surface, for example from a curve skeleton
/// @param spacing  m between cuts
Centreline centreline(const Slicer& slicer, const std::vector<Vec3>& curve, double spacing,
                      const IsForeign& is_foreign);

}  // namespace garmentfit
