// SPDX-License-Identifier: GPL-3.0-or-later
#include "stray_vertices.h"

#include <algorithm>

#include "tuning.h"
#include "used_vertices.h"

namespace garmentfit {
namespace {

/// Vertices of faces that name one of the mesh and are finite.
std::vector<int> usable_vertices(const Positions& positions, const Triangles& triangles)
{
    std::vector<int> vertices = used_vertices(triangles);
    vertices.erase(
        std::remove_if(vertices.begin(), vertices.end(),
                       [&](int v) { return v < 0 || v >= positions.rows() || !positions.row(v).allFinite(); }),
        vertices.end());
    return vertices;
}

}  // namespace

UsualBox::UsualBox(const Positions& positions, const std::vector<int>& vertices)
{
    const std::ptrdiff_t n = std::ptrdiff_t(vertices.size()),
                         left_out = n < k_fewest_for_strays ? 0 : std::max(n / k_vertices_a_stray, std::ptrdiff_t(1));
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> places;
        for (const int v : vertices)
            places.push_back(positions(v, axis));
        std::nth_element(places.begin(), places.begin() + left_out, places.end());
        box.min()[axis] = places[left_out];
        std::nth_element(places.begin(), places.end() - 1 - left_out, places.end());
        box.max()[axis] = places[n - 1 - left_out];
    }
}

double UsualBox::away(const Vec3& place) const
{
    const double distance = (place - middle()).stableNorm();
    return distance == 0 ? 0 : distance / (box.max() - box.min()).stableNorm();
}

std::vector<int> stray_vertices(const Positions& positions, const Triangles& triangles)
{
    const std::vector<int> used = usable_vertices(positions, triangles);
    if (used.empty())
        return {};
    const UsualBox usual(positions, used);
    std::vector<int> strays;
    auto next_used = used.begin();
    for (int v = 0; v < positions.rows(); ++v)
        if (next_used != used.end() && *next_used == v)
            ++next_used;
        else if (!positions.row(v).allFinite() || !(usual.away(positions.row(v)) <= k_stray_reach))
            strays.push_back(v);
    // a face may name a vertex that is not finite; that is a fault of the mesh, and no stray
    const std::vector<int> named = used_vertices(triangles);
    strays.erase(std::remove_if(strays.begin(), strays.end(),
                                [&](int v) { return std::binary_search(named.begin(), named.end(), v); }),
                 strays.end());
    return strays;
}

Positions gather_strays(const Positions& positions, const Triangles& triangles)
{
    Positions result = positions;
    const std::vector<int> strays = stray_vertices(positions, triangles);
    if (strays.empty())
        return result;
    const UsualBox usual(positions, usable_vertices(positions, triangles));
    for (const int v : strays)
        result.row(v) = usual.middle().transpose();
    return result;
}

}  // namespace garmentfit
