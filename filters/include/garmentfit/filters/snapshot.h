// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Body and garments of a scene in one state of the return to the input pose, and back into a scene.

#include <string>
#include <vector>

#include "garmentfit/filters/filters.h"

namespace garmentfit {

struct Snapshot {
    Pose pose;
    Positions body;  ///< of the user's vertices; equal to the surface's, bit for bit, in the input pose
    std::vector<Positions> garments;  ///< of each of the scene's; empty where it is not worn
    std::vector<FitMap> maps;  ///< of the garments
};

/// @param share  of the return to the input pose: the nearest of the dressing's frames is taken. 1, or no frames: the
///         end
/// @param cloth  as in the run that moved the garments; needed for the maps of frames
Snapshot snapshot_of(const Scene& scene, double share, const ClothOptions& cloth);

/// The scene's garments as they are worn in a pose of its rig, certified anew: a start for recovering the pose.
/// @param left   the body's vertices as draping left them, metres: cloth may hold some of them back from the pose
/// @param worn   positions of each garment, metres
/// @throws InvalidInput naming a mesh that has another number of vertices than as given.
Dressing dressing_from(const Scene& scene, const Pose& pose, const Positions& left, const std::vector<Positions>& worn,
                       const std::vector<std::string>& names);

}  // namespace garmentfit
