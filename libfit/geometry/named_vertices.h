// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "garmentfit/types.h"

namespace garmentfit {

/// @throws InvalidInput with the first triangle whose vertex indices are out of range.
void require_named_vertices(std::string_view what, Eigen::Index vertices, const Triangles& triangles);

}  // namespace garmentfit
