// SPDX-License-Identifier: GPL-3.0-or-later
#include "stretch.h"

#include <algorithm>

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

double quantile(std::vector<double> values, double fraction)
{
    if (values.empty())
        return 0;
    const auto nth = values.begin() + std::ptrdiff_t(fraction * double(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

}  // namespace garmentfit
