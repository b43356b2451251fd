// SPDX-License-Identifier: GPL-3.0-or-later
#include "near_vertices.h"

#include <algorithm>
#include <utility>

namespace garmentfit {
namespace {

// derived: the default of ClothOptions::min_distance, below which pairs cannot move freely against each other.
constexpr double k_near = 1e-4;  // m

std::vector<std::pair<int, int>> near_pairs(const GarmentMesh& cloth, const MeshTopology& topology)
{
    const auto are_near = [&](int a, int b) {
        return (cloth.positions.row(a) - cloth.positions.row(b)).squaredNorm() < k_near * k_near;
    };
    std::vector<std::pair<int, int>> pairs;
    for (const auto& edge : topology.edges().rowwise())
        if (are_near(edge[0], edge[1]))
            pairs.emplace_back(edge[0], edge[1]);
    std::vector<int> border;
    for (const int edge : topology.border_edges())
        border.insert(border.end(), { topology.edges()(edge, 0), topology.edges()(edge, 1) });
    std::sort(border.begin(), border.end());
    border.erase(std::unique(border.begin(), border.end()), border.end());
    const auto x = [&](int v) { return cloth.positions(v, 0); };
    std::stable_sort(border.begin(), border.end(), [&](int a, int b) { return x(a) < x(b); });
    for (std::size_t i = 0; i < border.size(); ++i)
        for (std::size_t k = i + 1; k < border.size() && x(border[k]) - x(border[i]) < k_near; ++k)
            if (are_near(border[i], border[k]))
                pairs.emplace_back(std::minmax(border[i], border[k]));
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace

std::optional<Positions> merge_near_vertices(const GarmentMesh& cloth, const MeshTopology& topology,
                                             const std::vector<int>& garments)
{
    Positions merged = cloth.positions;
    // A vertex goes to the first one near it and nobody to one that went, so chains of short edges stay.
    std::vector<char> is_taken(std::size_t(cloth.positions.rows()), 0), has_gone(is_taken);
    bool is_any = false;
    for (const auto& [first, second] : near_pairs(cloth, topology)) {
        if (has_gone[first] || is_taken[second] || has_gone[second]
            || (!garments.empty() && garments[first] != garments[second]))
            continue;
        merged.row(second) = merged.row(first);
        is_taken[first] = has_gone[second] = 1;
        is_any = true;
    }
    if (!is_any)
        return {};
    return merged;
}

}  // namespace garmentfit
