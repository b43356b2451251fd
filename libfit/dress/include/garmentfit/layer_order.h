// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which of several garments goes over which.

#include <string_view>
#include <vector>

#include "garmentfit/fit_skeleton.h"

namespace garmentfit {

/// Of several garments: as they were given, from the inside out, or as order_layers has it.
enum class LayerOrder { given, automatic };
/// "given", "auto".
GARMENTFIT_API const std::vector<std::string_view>& layer_order_names();

/// Which garment goes over which: the layer of each, 0 for the innermost. Of two that go round the same parts of the body, the type says it
/// (a coat goes over a jacket, that over a hoodie, that over shirts) or, where it does not, the one that is clearly wider goes over the
/// other; where that says nothing either, they stay in the order they are in. O(n log n).
/// @param body  the user's vertices, metres
/// @param fits  of each garment, with its type
GARMENTFIT_API std::vector<int> order_layers(const Rig& rig, const Positions& body,
                                             const std::vector<GarmentMesh>& garments,
                                             const std::vector<FitResult>& fits);

}  // namespace garmentfit
