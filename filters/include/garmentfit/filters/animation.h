// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The states on the pose path as one file that other programs can play.

#include <filesystem>
#include <string>
#include <vector>

#include "garmentfit/filters/filters.h"

namespace garmentfit {

/// Length of an animation, s; a matter of taste.
constexpr double k_animation_seconds = 3;

/// Writes the frames of a dressing as a GLB with morph targets (animated_gltf.h): the body and the clothes that are worn.
/// @param garments  their names in the file, one for each of the scene's
/// @throws InvalidInput where there are no frames, `seconds` is not above 0, or the place cannot be written.
void write_animation(const Scene& scene, const Dressing& dressing, const std::vector<std::string>& garments,
                     const std::filesystem::path& path, double seconds = k_animation_seconds);

}  // namespace garmentfit
