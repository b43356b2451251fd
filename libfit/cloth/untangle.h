// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Parts cloth that was given crossing itself: collars through collars, plackets, layers of one file.
//
// Method   Intersection contour minimisation [volino_2006_contours]: wherever an edge passes through a triangle the two are
//          moved apart in the direction in which the curve along which the sheets cross grows shorter. No side of a
//          sheet has to be known, so folds, borders and open garments are all the same to it.

#include "garmentfit/certificate.h"

namespace garmentfit {

struct Untangled {
    Positions positions;  ///< n x 3
    std::vector<Crossing> left;  ///< pairs that still cross
};

/// `cloth` (n x 3, metres, equal vertices welded) with its sheets parted. A tangle that does not come apart
/// stays as given, vertex for vertex, and so does all that is further than a few edges from a tangle.
/// Cost O(n log n) to find the tangles, and some hundred times their own size to part them.
Untangled untangle(const TriangleMesh& cloth);

}  // namespace garmentfit
