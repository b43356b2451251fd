// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Operations on skin weights.

#include <vector>

#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Appends the rows of `more`.
void append(SkinWeights& weights, const SkinWeights& more);

/// The bone with the largest weight of each vertex.
std::vector<int> strongest_bones(const SkinWeights& weights);

/// The skin weights of the nearest body vertex for each point (n x 3, same pose as the body). O((n + m) log m).
SkinWeights weights_of_nearest(const Positions& points, const Positions& body, const SkinWeights& weights);

/// The four largest weights of each row of a dense table, n x bone_count, normalised to sum to 1.
SkinWeights strongest_four(Eigen::MatrixXd dense);

}  // namespace garmentfit
