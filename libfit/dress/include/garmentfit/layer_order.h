// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Decides which of several garments goes over which.

#include <string_view>
#include <vector>

#include "garmentfit/fit_skeleton.h"

namespace garmentfit {

/// From the inside out as the garments are given, or as order_layers decides.
enum class LayerOrder { given, automatic };
/// "given", "auto".
GARMENTFIT_API const std::vector<std::string_view>& layer_order_names();

/// The layer of each garment, 0 for the innermost. Of two garments round the same parts of the body the type decides
/// (coats over jackets, jackets over hoodies, hoodies over shirts). Of two types of one layer, the clearly wider
/// garment goes over the other. Else both stay in the order in which they are given. O(n log n).
/// docs/decisions/0015-layer-order.md
/// @param body  the user's vertices, metres
/// @param fits  of each garment, with its type
GARMENTFIT_API std::vector<int> order_layers(const Rig& rig, const Positions& body,
                                             const std::vector<GarmentMesh>& garments,
                                             const std::vector<FitResult>& fits);

}  // namespace garmentfit
