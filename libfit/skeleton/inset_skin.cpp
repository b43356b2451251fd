// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/inset_skin.h"

#include <algorithm>

#include "edge_distances.h"
#include "nearest.h"
#include "parallel.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace skeleton_tuning;

constexpr double k_lift = 1e-5;  // unit: share of the diagonal; a ray begins off the faces around its vertex

/// Whether one of the clothes lies over a place of the skin.
bool is_under_cloth(const Vec3& place, const Vec3& normal, const std::vector<TriangleTree>& clothes, double farthest)
{
    return std::any_of(clothes.begin(), clothes.end(), [&](const TriangleTree& cloth) {
        const auto hit = cloth.first_hit(place, normal);
        return hit && hit->distance < farthest;
    });
}

/// Evens out the motion of what moves.
void smooth(const MeshTopology& topology, Positions& motion)
{
    for (int pass = 0; pass < k_inset_smoothing_passes; ++pass) {
        Positions sum = Positions::Zero(motion.rows(), 3);
        add_neighbours(topology.edges(), motion, sum);
        for (int v = 0; v < int(motion.rows()); ++v)
            if (!motion.row(v).isZero(0))
                motion.row(v) = (motion.row(v) + sum.row(v) / double(topology.neighbours(v).size())) / 2;
    }
}

}  // namespace

Positions inset_skin(const TriangleMesh& body, const std::vector<TriangleMesh>& clothes)
{
    const double size = diagonal(body.positions);
    const int count = int(body.positions.rows());
    const Positions normals = vertex_normals(body.positions, body.triangles);
    const std::vector<TriangleTree> trees(clothes.begin(), clothes.end());
    const TriangleTree skin(body);
    std::vector<char> is_under(std::size_t(count), 0);
    std::vector<double> deepest(std::size_t(count), 0);  // m
    parallel_for(count, [&](int v) {
        const Vec3 place = body.positions.row(v), normal = normals.row(v);
        is_under[std::size_t(v)] = is_under_cloth(place, normal, trees, k_nearby_cloth * size);
        const auto behind = skin.first_hit(place - k_lift * size * normal, -normal);
        deepest[std::size_t(v)] = behind ? std::min(k_inset * size, k_inset_share * behind->distance) : 0;
    });

    const MeshTopology topology(body.triangles, count);
    EdgeDistances from_bare(body.positions, topology, (k_inset_margin + k_inset / k_inset_slope) * size);
    std::vector<int> bare;
    for (int v = 0; v < count; ++v)
        if (!is_under[std::size_t(v)])
            bare.push_back(v);
    from_bare.add(bare);

    Positions motion = Positions::Zero(count, 3);
    for (int v = 0; v < count; ++v) {
        const double depth = k_inset_slope * (from_bare[v] - k_inset_margin * size);
        if (depth > 0)
            motion.row(v) = -std::min(depth, deepest[std::size_t(v)]) * normals.row(v);
    }
    smooth(topology, motion);
    return body.positions + motion;
}

}  // namespace garmentfit
