// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A body shrunk onto its bones: where each vertex starts from when the body is inflated inside a garment.

#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// For each point (n x 3, in the pose of `skeleton`) the point of the skeleton that it collapses to: the mean, along
/// the skeleton's tree, of the nearest points on the bones that it hangs on and on what lies beyond the last joints,
/// weighted by its skin weights. Means in a tree are continuous (Sturm 2003), so neighbours stay neighbours, and they
/// never leave the bones: an armpit goes to the shoulder, not across from rib to arm. O(n).
Positions collapse(const Positions& positions, const SkinWeights& weights, const Skeleton& skeleton);

}  // namespace garmentfit
