// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Collapses a body onto its bones: where each vertex starts from when the body grows inside a garment.

#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// For each point (n x 3, in the pose of `skeleton`) the point of the skeleton that it collapses to: the mean, along
/// the skeleton's tree and weighted by its skin weights, of the nearest points on its bones and on what lies beyond the
/// last joints. Means in a tree are continuous [sturm_2003_means], so neighbours stay neighbours, and they never leave
/// the bones: an armpit goes to the shoulder, not across from rib to arm. O(n).
Positions collapse(const Positions& positions, const SkinWeights& weights, const Skeleton& skeleton);

}  // namespace garmentfit
