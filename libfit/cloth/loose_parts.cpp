// SPDX-License-Identifier: GPL-3.0-or-later
#include "loose_parts.h"

#include <algorithm>
#include <map>

#include "disjoint_sets.h"
#include "nearest.h"

namespace garmentfit {
namespace {

constexpr double k_longest = 0.25;  // m, the diagonal of a part's box
constexpr double k_furthest = 0.02;  // m, from the cloth that a part lies on

std::map<int, std::vector<int>> pieces_of(const GarmentMesh& mesh)
{
    DisjointSets joined(int(mesh.positions.rows()));
    std::vector<char> used(mesh.positions.rows(), 0);
    for (const auto& corners : mesh.triangles.rowwise())
        for (int k = 0; k < 3; ++k) {
            joined.join(corners[k], corners[(k + 1) % 3]);
            used[corners[k]] = 1;
        }
    std::map<int, std::vector<int>> pieces;
    for (int v = 0; v < int(used.size()); ++v)
        if (used[v])
            pieces[joined.root(v)].push_back(v);
    return pieces;
}

double diagonal(const Positions& points) { return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm(); }

}  // namespace

std::vector<std::pair<int, int>> ties_of_loose_parts(const GarmentMesh& rest)
{
    std::vector<int> cloth;
    std::vector<std::vector<int>> small;
    for (auto& [name, piece] : pieces_of(rest))
        if (diagonal(rest.positions(piece, Eigen::all)) > k_longest)
            cloth.insert(cloth.end(), piece.begin(), piece.end());
        else
            small.push_back(std::move(piece));
    if (cloth.empty() || small.empty())
        return {};

    const NearestPoint nearest(rest.positions(cloth, Eigen::all));
    std::vector<std::pair<int, int>> foot;  // vertex of a part, the nearest of the cloth
    for (const auto& piece : small) {
        const std::size_t before = foot.size();
        for (const int v : piece) {
            const int under = cloth[nearest.index(rest.positions.row(v))];
            if ((rest.positions.row(v) - rest.positions.row(under)).norm() > k_furthest) {
                foot.resize(before);
                break;
            }
            foot.emplace_back(v, under);
        }
    }
    std::vector<std::vector<int>> beside(rest.positions.rows());
    const auto edges = edges_of(rest.triangles);
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        beside[edges(e, 0)].push_back(edges(e, 1));
        beside[edges(e, 1)].push_back(edges(e, 0));
    }
    std::vector<std::pair<int, int>> ties;
    for (const auto& [v, under] : foot) {
        ties.emplace_back(v, under);
        for (const int other : beside[under])
            ties.emplace_back(v, other);
    }
    return ties;
}

}  // namespace garmentfit
