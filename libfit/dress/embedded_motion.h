// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a stand-in takes along what is near it: each place goes with the blended motions of the stand-in's vertices round
// the point nearest to it (embedded deformation [sumner_2007_embedded_deformation]), on the limb to which it and its
// neighbours belong most surely.

#include <vector>

#include <Eigen/Core>

#include "garmentfit/mesh.h"
#include "topology.h"

namespace garmentfit {

/// Where the vertices of a garment go with its stand-in.
struct LedPlaces {
    Positions feet;  ///< of the points of the stand-in nearest to them
    Positions positions;
    std::vector<Eigen::Matrix3d> turns;  ///< what is beside each of them goes there by, about it; blended rotations
};

/// @param stand_in  at rest
/// @param worn      positions of the stand-in
/// @param garment   at rest
/// @param topology  of the garment
LedPlaces lead_along(const GarmentMesh& stand_in, const Positions& worn, const TriangleMesh& garment,
                     const MeshTopology& topology);

}  // namespace garmentfit
