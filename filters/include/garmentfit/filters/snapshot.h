// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Body and garments at one time of the way that a scene has come, and back into a scene.

#include <string>
#include <vector>

#include "garmentfit/filters/filters.h"

namespace garmentfit {

struct Snapshot {
    Pose pose;
    Positions body;  ///< of the user's vertices; equal to the surface's, bit for bit, in the body's own pose
    std::vector<Positions> garments;  ///< of each of the scene's; empty where it is not worn
    std::vector<FitMap> maps;  ///< how those sit
};

/// @param share  of the way back to the body's own pose: the nearest of the dressing's frames is taken. 1, or no frames: the end
/// @param cloth  that the garments were moved as; needed for the maps of frames
Snapshot snapshot_of(const Scene& scene, double share, const ClothOptions& cloth);

/// The scene's garments as they are worn in a pose of its rig, certified anew, to go on from.
/// @param left   the body's vertices as they were left, metres: cloth may hold some of them back from the pose
/// @param worn   positions of each garment, metres
/// @throws InvalidInput naming what has another number of vertices than as given.
Dressing dressing_from(const Scene& scene, const Pose& pose, const Positions& left, const std::vector<Positions>& worn,
                       const std::vector<std::string>& names);

}  // namespace garmentfit
