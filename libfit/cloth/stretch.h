// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How far cloth is stretched, edge by edge.

#include <vector>

#include "garmentfit/mesh.h"
#include "topology.h"

namespace garmentfit {

/// l / l0 - 1 of every edge of the garment that has a length at rest. O(n).
std::vector<double> stretches(const GarmentMesh& rest, const Positions& positions);
/// The same for edges that the caller has listed.
std::vector<double> stretches(const Positions& rest, const Positions& positions, const Edges& edges);

}  // namespace garmentfit
