// SPDX-License-Identifier: GPL-3.0-or-later
#include "labelled_surface.h"

#include <algorithm>
#include <string>

#include "garmentfit/error.h"
#include "garmentfit/number_text.h"

namespace garmentfit {

std::vector<Vec3> LabelledSurface::curve(int c) const
{
    std::vector<Vec3> points;
    for (const int node : graph.curve(c))
        points.push_back(skeleton.nodes[node]);
    return points;
}

IsForeign LabelledSurface::foreign_to(int c) const
{
    return [this, c](int vertex) {
        const int node = skeleton.node_of_vertex[vertex];
        return node >= 0 && graph.place_of_node[node].curve != c;
    };
}

std::vector<Vec3> LabelledSurface::last_vertices(int c, double length) const
{
    const std::vector<Vec3> nodes = curve(c);
    std::size_t first = nodes.size() - 1;
    for (double along = 0; first > 0 && along <= length; --first)
        along += (nodes[first] - nodes[first - 1]).norm();
    std::vector<Vec3> points;
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
        const int node = skeleton.node_of_vertex[v];
        if (node < 0)
            continue;
        const auto& place = graph.place_of_node[node];
        if (place.curve == c && place.row >= int(first))
            points.push_back(mesh.positions.row(v));
    }
    require_part(!points.empty(), "skin at the end of a limb", nodes.back());
    return points;
}

Vec3 farthest_along(const std::vector<Vec3>& points, const Vec3& direction)
{
    return *std::max_element(points.begin(), points.end(),
                             [&](const Vec3& a, const Vec3& b) { return a.dot(direction) < b.dot(direction); });
}

void require_part(bool found, const char* what, const Vec3& place)
{
    if (!found)
        throw InvalidInput(ErrorCode::not_human,
                           std::string("body: no ") + what + " found near " + place_text(place)
                               + " from the middle of its bounding box; give a human body whose limbs do not merge with"
                                 " it, or give joints");
}

}  // namespace garmentfit
