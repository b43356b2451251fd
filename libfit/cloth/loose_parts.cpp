// SPDX-License-Identifier: GPL-3.0-or-later
#include "loose_parts.h"

#include <map>

#include "disjoint_sets.h"
#include "nearest.h"
#include "tuning.h"

namespace garmentfit {
namespace {

std::map<int, std::vector<int>> find_pieces(const GarmentMesh& mesh)
{
    DisjointSets sets(int(mesh.positions.rows()));
    std::vector<char> is_used(mesh.positions.rows(), 0);
    for (const auto& corners : mesh.triangles.rowwise())
        for (int k = 0; k < 3; ++k) {
            sets.join(corners[k], corners[(k + 1) % 3]);
            is_used[corners[k]] = 1;
        }
    std::map<int, std::vector<int>> pieces;
    for (int v = 0; v < int(is_used.size()); ++v)
        if (is_used[v])
            pieces[sets.root(v)].push_back(v);
    return pieces;
}

double diagonal(const Positions& points) { return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm(); }

}  // namespace

std::vector<std::pair<int, int>> find_loose_part_ties(const GarmentMesh& rest, const MeshTopology& topology)
{
    std::vector<int> cloth;
    std::vector<std::vector<int>> parts;
    for (auto& [root, piece] : find_pieces(rest))
        if (diagonal(rest.positions(piece, Eigen::all)) > k_largest_loose_part)
            cloth.insert(cloth.end(), piece.begin(), piece.end());
        else
            parts.push_back(std::move(piece));
    if (cloth.empty() || parts.empty())
        return {};

    const NearestPoint nearest(rest.positions(cloth, Eigen::all));
    std::vector<std::pair<int, int>> feet;  // vertex of a part, its nearest of the cloth
    for (const auto& part : parts) {
        const std::size_t before = feet.size();
        for (const int v : part) {
            const int under = cloth[nearest.index(rest.positions.row(v))];
            if ((rest.positions.row(v) - rest.positions.row(under)).norm() > k_loose_part_distance) {
                feet.resize(before);
                break;
            }
            feet.emplace_back(v, under);
        }
    }
    std::vector<std::pair<int, int>> ties;
    for (const auto& [v, under] : feet) {
        ties.emplace_back(v, under);
        for (const int neighbour : topology.neighbours(under))
            ties.emplace_back(v, neighbour);
    }
    return ties;
}

}  // namespace garmentfit
