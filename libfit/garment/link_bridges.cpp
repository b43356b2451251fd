// SPDX-License-Identifier: GPL-3.0-or-later
#include "link_bridges.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "surface_measures.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

/// A side of a triangle on a border, in its direction.
struct BorderSide {
    int from, to;
    Vec3 middle;
};

std::vector<BorderSide> borders_at(const std::vector<int>& vertices, const GarmentMesh& cloth,
                                   const MeshTopology& topology)
{
    const auto is_among = [&](int v) { return std::binary_search(vertices.begin(), vertices.end(), v); };
    std::vector<BorderSide> sides;
    for (const int edge : topology.border_edges()) {
        const int side = topology.sides_at(edge)[0], from = cloth.triangles(side / 3, side % 3),
                  to = cloth.triangles(side / 3, (side % 3 + 1) % 3);
        if (is_among(from) || is_among(to))
            sides.push_back({ from, to, 0.5 * (cloth.positions.row(from) + cloth.positions.row(to)).transpose() });
    }
    return sides;
}

/// m, along a border from one of its vertices to another; none where they are on no common border.
std::optional<double> way_along_border(const GarmentMesh& cloth, const std::vector<std::vector<int>>& loops, int from,
                                       int to)
{
    for (const std::vector<int>& loop : loops) {
        const auto start = std::find(loop.begin(), loop.end(), from);
        if (start == loop.end() || std::find(loop.begin(), loop.end(), to) == loop.end())
            continue;
        double way = 0;
        for (std::size_t i = std::size_t(start - loop.begin()); loop[i % loop.size()] != to; ++i)
            way += (cloth.positions.row(loop[(i + 1) % loop.size()]) - cloth.positions.row(loop[i % loop.size()]))
                       .norm();
        return way;
    }
    return {};
}

}  // namespace

bool bridge_links(GarmentMesh& cloth, const MeshTopology& topology, const std::vector<SewnDetail>& details)
{
    if (std::none_of(details.begin(), details.end(), [](const SewnDetail& detail) { return detail.is_link(); }))
        return false;
    const std::vector<std::vector<int>> loops = topology.border_loops();
    const double shortest = k_strap_border * diagonal(cloth.positions);
    std::vector<Eigen::RowVector3i> bridges;
    for (const SewnDetail& detail : details) {
        if (!detail.is_link())
            continue;
        std::optional<std::pair<BorderSide, BorderSide>> nearest;
        double least = INFINITY;
        for (const BorderSide& one : borders_at(detail.linked[0], cloth, topology))
            for (const BorderSide& other : borders_at(detail.linked[1], cloth, topology))
                if (const double apart = (one.middle - other.middle).norm(); apart < least) {
                    least = apart;
                    nearest = { one, other };
                }
        if (!nearest)
            continue;
        const auto& [a, b] = *nearest;
        const std::optional<double> one_way = way_along_border(cloth, loops, a.to, b.from),
                                    other_way = way_along_border(cloth, loops, b.to, a.from);
        if (one_way && other_way && std::min(*one_way, *other_way) > shortest) {
            bridges.push_back({ a.to, a.from, b.to });
            bridges.push_back({ a.to, b.to, b.from });
        }
    }
    const Eigen::Index first = cloth.triangles.rows();
    cloth.triangles.conservativeResize(first + Eigen::Index(bridges.size()), 3);
    for (std::size_t i = 0; i < bridges.size(); ++i)
        cloth.triangles.row(first + Eigen::Index(i)) = bridges[i];
    return !bridges.empty();
}

}  // namespace garmentfit
