// SPDX-License-Identifier: GPL-3.0-or-later
#include "torn_regions.h"

#include <algorithm>

#include "edge_distances.h"
#include "parallel.h"
#include "tuning.h"

namespace garmentfit {
namespace {

Vec3 way_between(const Positions& positions, int from, int to)
{
    return (positions.row(to) - positions.row(from)).transpose();
}

}  // namespace

bool is_torn(const Positions& rest, const Positions& worn, int a, int b)
{
    return way_between(worn, a, b).norm() > k_torn * way_between(rest, a, b).norm() + k_torn_gap;
}

bool has_tears(const Positions& rest, const Positions& worn, const MeshTopology& topology)
{
    const auto edges = topology.edges().rowwise();
    return std::any_of(edges.begin(), edges.end(), [&](const auto& e) { return is_torn(rest, worn, e[0], e[1]); });
}

PatchedCloth::PatchedCloth(const TriangleMesh& cloth, const MeshTopology& topology) :
    cloth_(cloth), cloth_topology_(topology), patch_of_(cloth.positions.rows())
{
    EdgeDistances distances(cloth.positions, topology, k_patch);
    std::vector<int> number(patch_of_.size(), -1);
    for (int v = 0; v < int(patch_of_.size()); ++v)
        if (distances.source_of(v) < 0) {
            distances.add({ v });
            number[v] = int(centres_.size());
            centres_.push_back(v);
        }
    for (int v = 0; v < int(patch_of_.size()); ++v)
        patch_of_[v] = number[distances.source_of(v)];
    rest_ = cloth.positions(centres_, Eigen::all);
    topology_ = MeshTopology(cloth.triangles.unaryExpr([&](int v) { return patch_of_[v]; }), int(centres_.size()));
}

std::vector<char> PatchedCloth::find_led_apart(const LedPlaces& led) const
{
    EdgeDistances from_tears(rest_, topology_, k_cloth_around);
    from_tears.add(patches_at_tears(led));
    std::vector<char> is_apart(centres_.size()), result(patch_of_.size());
    parallel_for(is_apart.size(), [&](std::size_t patch) {
        is_apart[patch] = from_tears[int(patch)] < k_cloth_around && is_led_apart(int(patch), led);
    });
    for (int v = 0; v < int(result.size()); ++v) {
        const int centre = centres_[patch_of_[v]];
        const double distance = way_between(cloth_.positions, centre, v).norm();
        result[v] = is_apart[patch_of_[v]] || goes_elsewhere(v, centre, distance, led);
    }
    return result;
}

std::vector<int> PatchedCloth::patches_at_tears(const LedPlaces& led) const
{
    std::vector<int> patches;
    for (const auto& edge : cloth_topology_.edges().rowwise())
        if (is_torn(cloth_.positions, led.positions, edge[0], edge[1]))
            patches.insert(patches.end(), { patch_of_[edge[0]], patch_of_[edge[1]] });
    return patches;
}

bool PatchedCloth::is_led_apart(int patch, const LedPlaces& led) const
{
    EdgeDistances distances(rest_, topology_, k_cloth_around);
    distances.add({ patch });
    int around = 0, elsewhere = 0;
    for (int other = 0; other < int(centres_.size()); ++other)
        if (distances[other] < k_cloth_around) {
            ++around;
            elsewhere += goes_elsewhere(centres_[patch], centres_[other], distances[other], led);
        }
    return 2 * elsewhere > around;
}

// Whether a vertex goes far from where another would take it, for the distance between them, m.
bool PatchedCloth::goes_elsewhere(int vertex, int other, double distance, const LedPlaces& led) const
{
    const Vec3 at_rest = way_between(cloth_.positions, other, vertex), way = way_between(led.positions, other, vertex);
    return (led.turns[other] * at_rest - way).norm() > k_led_elsewhere * distance + k_torn_gap;
}

}  // namespace garmentfit
