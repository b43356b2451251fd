// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a result is judged by: exact counts of crossings, the minimum distance, the strain.
//
// An edge crosses a triangle when it meets the triangle's interior or border. Pairs that share a vertex, or the place
// of one, do not count. Exact predicates on a CGAL AABB tree decide, without a tolerance.

#include <utility>
#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/mesh.h"

namespace garmentfit {

/// (edge of `a` as a row of edges_of, triangle of `b`).
using Crossing = std::pair<int, int>;

/// Every edge of `a` through every triangle of `b`. Cost O((n + k) log n).
GARMENTFIT_API std::vector<Crossing> crossings(const TriangleMesh& a, const TriangleMesh& b);
/// Every edge of `mesh` through every triangle of `mesh`, neighbours left out.
GARMENTFIT_API std::vector<Crossing> self_crossings(const TriangleMesh& mesh);
/// Both ways: edges of each through triangles of the other.
GARMENTFIT_API int crossing_count(const TriangleMesh& a, const TriangleMesh& b);

struct Strain {
    double median = 0, p95 = 0, max = 0;  ///< of |l / l0 - 1| over all edges
};
GARMENTFIT_API Strain strain_of(const GarmentMesh& rest, const Positions& positions);

struct Certificate {
    int body_crossings = 0;  ///< between garment and body, both ways
    int self_crossings
        = 0;  ///< of the garment with itself, pairs that the input did not have, without the shifted ones
    int input_self_crossings = 0;  ///< that the garment was given with
    std::vector<Crossing> kept_self_crossings;  ///< those of them that it still has
    /// Other pairs of sheets that lay on each other, within 0.15 % of the garment's diagonal: the curves along which they
    /// cross went on to other triangles. Only where no more pairs cross than were given
    /// (docs/decisions/0034-shifted-crossings.md).
    int shifted_self_crossings = 0;
    int layer_crossings = 0;  ///< with the garments worn under it
    int vertices_inside = 0;  ///< garment vertices inside the body
    double min_distance = 0;  ///< m, between garment and body
    Strain strain;

    bool clean() const
    {
        return body_crossings == 0 && self_crossings == 0 && layer_crossings == 0 && vertices_inside == 0;
    }
};

/// Judges one dressed garment. `under` are the dressed garments below it. Cost O((n + k) log n).
GARMENTFIT_API Certificate certify(const TriangleMesh& body, const GarmentMesh& rest, const Positions& positions,
                                   const std::vector<TriangleMesh>& under = {});

}  // namespace garmentfit
