// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a filter made of a scene that was scaled or moved for it.

#include <vector>

#include "garmentfit/filters/filters.h"

namespace garmentfit {

/// Takes a filter's outputs over into the scene as it was given.
/// @param made     scaled or moved back
/// @param worked   what the filter worked on: the same before that. Where a vertex of body or rest shape is still where
///                 it was for the filter, it gets its bits as given, whatever scaling and moving rounded.
/// @param outputs  of the filter
void take_outputs(Scene& given, const Scene& made, const Scene& worked, const std::vector<Data>& outputs);

}  // namespace garmentfit
