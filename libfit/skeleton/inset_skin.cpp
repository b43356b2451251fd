// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/inset_skin.h"

#include <algorithm>

#include "edge_distances.h"
#include "hidden_by_cloth.h"
#include "nearest.h"
#include "parallel.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace skeleton_tuning;

constexpr double k_lift = 1e-5;  // unit: share of the diagonal; a ray begins off the faces around its vertex

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
    const Eigen::VectorXd hidden = shares_hidden_by_cloth(
        body, joined(clothes), viewing_directions(k_pictures_of_inset), k_pixel_of_sight * size);
    const TriangleTree skin(body);
    std::vector<double> deepest(std::size_t(count), 0);  // m
    parallel_for(count, [&](int v) {
        const Vec3 place = body.positions.row(v), normal = normals.row(v);
        const auto behind = skin.first_hit(place - k_lift * size * normal, -normal);
        deepest[std::size_t(v)] = behind ? std::min(k_inset * size, k_inset_share * behind->distance) : 0;
    });

    const MeshTopology topology(body.triangles, count);
    EdgeDistances from_bare(body.positions, topology, (k_inset_margin + k_inset / k_inset_slope) * size);
    std::vector<int> bare;
    for (int v = 0; v < count; ++v)
        if (hidden[v] < k_hidden_to_inset)
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
