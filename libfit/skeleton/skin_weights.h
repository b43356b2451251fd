// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Skin weights joined, looked up and cut down.

#include <vector>

#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Appends the rows of `more`.
void append(SkinWeights& weights, const SkinWeights& more);

/// The bone that each vertex follows most.
std::vector<int> strongest_bones(const SkinWeights& weights);

/// The skin weights of the nearest body vertex for each point (n x 3, same pose as the body). O((n + m) log m).
SkinWeights weights_of_nearest(const Positions& points, const Positions& body, const SkinWeights& weights);

/// The four largest of each row of a dense table of weights, n x bone_count, made to sum to 1.
SkinWeights strongest_four(Eigen::MatrixXd dense);

}  // namespace garmentfit
