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

/// The place of a vertex in a list that ascends. @pre it is there
inline int number_among(const std::vector<int>& used, int vertex)
{
    return int(std::lower_bound(used.begin(), used.end(), vertex) - used.begin());
}

/// The same triangles in the numbers that their vertices have in `used`.
inline Triangles numbered_among(const std::vector<int>& used, Triangles triangles)
{
    for (int& v : triangles.reshaped())
        v = number_among(used, v);
    return triangles;
}

}  // namespace garmentfit
