// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// Vertices that belong to a triangle, ascending. A stray vertex is no cloth.
inline std::vector<int> used_vertices(const Triangles& triangles)
{
    std::vector<int> result(triangles.data(), triangles.data() + triangles.size());
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

}  // namespace garmentfit
