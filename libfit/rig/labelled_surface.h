// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The body's surface with the curve that each of its vertices belongs to.

#include <vector>

#include "body_graph.h"
#include "centreline.h"
#include "garmentfit/types.h"

namespace garmentfit {

struct LabelledSurface {
    const TriangleMesh& mesh;
    const CurveSkeleton& skeleton;
    const BodyGraph& graph;

    /// The nodes of a curve, m. @param c  as in BodyGraph::curve
    std::vector<Vec3> curve(int c) const;

    /// Whether a vertex belongs to another curve than `c`.
    IsForeign foreign_to(int c) const;

    /// The vertices that belong to the last `length` of a curve, m along it.
    std::vector<Vec3> last_vertices(int c, double length) const;
};

/// The one of `points` with the largest coordinate along `direction`. @pre not empty
Vec3 farthest_along(const std::vector<Vec3>& points, const Vec3& direction);

/// @throws InvalidInput that names `what` and the place where it is missing, if not `found`.
void require_part(bool found, const char* what, const Vec3& place);

}  // namespace garmentfit
