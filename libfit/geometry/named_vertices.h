// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "garmentfit/types.h"

namespace garmentfit {

/// @throws InvalidInput naming the first triangle that names a vertex which `what` does not have.
void require_named_vertices(std::string_view what, Eigen::Index vertices, const Triangles& triangles);

}  // namespace garmentfit
