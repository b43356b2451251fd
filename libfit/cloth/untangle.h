// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Parts cloth that was given crossing itself: collars through collars, plackets, layers of one file.
//
// Method   intersection contour minimisation [volino_2006_contours]: wherever an edge passes through a triangle, the
//          two are moved apart in the direction in which the curve along which the sheets cross grows shorter. The
//          method needs no side of a sheet, so it works on folds, borders and open garments alike.

#include "garmentfit/certificate.h"
#include "topology.h"

namespace garmentfit {

struct UntangleResult {
    Positions positions;  ///< n x 3
    std::vector<Crossing> left;  ///< pairs that still cross
};

/// `cloth` (n x 3, metres, equal vertices welded) with its sheets parted. Where a part of a tangle does not come apart
/// without crossings that were not given, the cloth is put back there; everything that is further than a few edges from a
/// tangle stays as given. Cost O(n log n) to find the tangles, and some hundred times their own size to part them.
/// @param edges  of the triangles of `cloth`
UntangleResult untangle(const TriangleMesh& cloth, const Edges& edges);
UntangleResult untangle(const TriangleMesh& cloth);

/// Where the cloth goes by the same method until no more than `enough` pairs cross, or to where the fewest do. Others
/// may cross then than did before. Cost O(n log n) a round.
Positions reduce_crossings(const TriangleMesh& cloth, const Edges& edges, std::size_t enough);

}  // namespace garmentfit
