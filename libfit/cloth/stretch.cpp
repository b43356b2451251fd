// SPDX-License-Identifier: GPL-3.0-or-later
#include "stretch.h"

namespace garmentfit {

std::vector<double> stretches(const GarmentMesh& rest, const Positions& positions)
{
    return stretches(rest.positions, positions, edges_of(rest.triangles));
}

std::vector<double> stretches(const Positions& rest, const Positions& positions, const Edges& edges)
{
    std::vector<double> result;
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        const double l0 = (rest.row(edges(e, 0)) - rest.row(edges(e, 1))).norm();
        const double l = (positions.row(edges(e, 0)) - positions.row(edges(e, 1))).norm();
        if (l0 > 0)
            result.push_back(l / l0 - 1);
    }
    return result;
}

}  // namespace garmentfit
