// SPDX-License-Identifier: GPL-3.0-or-later
#include "stretch.h"

#include <algorithm>

namespace garmentfit {

std::vector<EdgeStretch> edge_stretches(const Positions& rest, const Positions& positions, const Edges& edges)
{
    std::vector<EdgeStretch> result;
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        const double l0 = (rest.row(edges(e, 0)) - rest.row(edges(e, 1))).norm();
        const double l = (positions.row(edges(e, 0)) - positions.row(edges(e, 1))).norm();
        if (l0 > 0)
            result.push_back({ l / l0 - 1, l0 });
    }
    return result;
}

double quantile_by_length(std::vector<EdgeStretch> edges, double fraction)
{
    std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.stretch < b.stretch; });
    double left = 0;
    for (const EdgeStretch& edge : edges)
        left += fraction * edge.rest;
    for (const EdgeStretch& edge : edges)
        if ((left -= edge.rest) <= 0)
            return edge.stretch;
    return 0;
}

std::vector<double> stretches(const GarmentMesh& rest, const Positions& positions)
{
    std::vector<double> result;
    for (const EdgeStretch& edge : edge_stretches(rest.positions, positions, edges_of(rest.triangles)))
        result.push_back(edge.stretch);
    return result;
}

}  // namespace garmentfit
