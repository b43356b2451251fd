// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A surface through the points of a scanner.
//
// Method   outliers removed, smoothed to a coarser scale [digne_2011_scale_space], joined by an advancing front
//          [cohensteiner_2004_greedy]. Needs no normals.
// Cost     O(n log n); some seconds for 50 thousand points. Denser clouds are thinned out to that number.
// Promise  points keep their places and their order; outliers, and points that were thinned out, have no triangle.

#include "garmentfit/export.h"
#include "garmentfit/progress.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// Rows of `points`. Holes stay where no points are: make_body closes them.
/// @throws InvalidInput: too few points. Cancelled.
GARMENTFIT_API Triangles reconstruct_surface(const Positions& points, const Progress& progress = {});

}  // namespace garmentfit
