// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How far cloth is stretched, edge by edge.

#include <vector>

#include "garmentfit/mesh.h"
#include "topology.h"

namespace garmentfit {

struct EdgeStretch {
    double stretch;  ///< l / l0 - 1
    double rest;  ///< l0, m
};

/// Of every edge that has a length at rest. O(n).
std::vector<EdgeStretch> edge_stretches(const Positions& rest, const Positions& positions, const Edges& edges);

/// The stretch that this fraction of the edges does not exceed, by their length at rest: where triangles are uneven, most
/// edges are small details. O(n log n).
double quantile_by_length(std::vector<EdgeStretch> edges, double fraction);

/// The stretches alone, of all edges of the garment.
std::vector<double> stretches(const GarmentMesh& rest, const Positions& positions);

}  // namespace garmentfit
