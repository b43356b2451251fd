// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// From a scene to new layers, with the scene attached to each.

#include <vector>

#include "choice.h"
#include "fitting.h"
#include "garmentfit/fit_map.h"

namespace garmentfit::meshlab {

/// Layers for each of the outputs; all but those of the last one are hidden.
void add_results(MeshDocument& document, const Choice& choice, Fitting fitting, const std::vector<Data>& outputs);

/// A copy of the worn garment with its map as attributes, quality and colours.
void add_measured(MeshDocument& document, const Choice& choice, Fitting fitting, const FitMap& map);

}  // namespace garmentfit::meshlab
