// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A body shrunk onto its bones: where each vertex starts from when the body is inflated inside a garment.

#include "fit/mesh.h"
#include "fit/skeleton.h"

namespace fit {

/// For each point (n x 3, pose of `skeleton`) the point of its bones that it collapses to: the nearest point of each bone
/// that it hangs on, and of what lies beyond the last joints, mixed by the skin weights; so neighbours stay neighbours.
Positions collapse(const Positions& positions, const SkinWeights& weights, const Skeleton& skeleton);

}  // namespace fit
