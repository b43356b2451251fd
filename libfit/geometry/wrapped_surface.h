// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>

#include "garmentfit/types.h"

namespace garmentfit {

/// Returns a closed surface around any triangles [portaneri_2022_alpha_wrap]. It spans holes narrower than about
/// twice `alpha`, and keeps `offset` off the triangles, both shares of the diagonal. Takes seconds, and without a limit
/// where the surface has many folds, or `alpha` is small.
/// @param watch  called with the number of points of the wrap now and then; it may throw to end the work
TriangleMesh wrap_surface(const TriangleMesh& surface, double alpha, double offset,
                          const std::function<void(std::size_t points)>& watch = {});

}  // namespace garmentfit
