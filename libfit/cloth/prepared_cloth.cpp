// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepared_cloth.h"

#include "exact_crossings.h"
#include "near_vertices.h"

namespace garmentfit {
namespace {

std::vector<int> gather(const Weld& weld, const std::vector<int>& garments, Eigen::Index vertices)
{
    std::vector<int> result;
    if (!garments.empty())
        for (Eigen::Index v = 0; v < vertices; ++v)
            result.push_back(garments[weld.given_vertex(int(v))]);
    return result;
}

/// Where vertices of a seam touch the other border, moves them into their own cloth, at rest and at the start: what
/// touches has no side, and counts as a crossing.
void open_touching_seams(GarmentMesh& cloth, const MeshTopology& topology, const std::vector<Tie>& ties,
                         Positions& start)
{
    // derived: twice the default of ClothOptions::min_distance, so that contact keeps the two apart.
    constexpr double k_touching = 1e-4, k_opened = 2e-4;  // m
    const Positions given = cloth.positions, given_start = start;
    for (const Tie& tie : ties) {
        Vec3 foot = Vec3::Zero();
        for (int k = 0; k < 3; ++k)
            foot += tie.weights[k] * given.row(tie.corners[k]).transpose();
        if (!tie.is_seam || (given.row(tie.vertex).transpose() - foot).norm() >= k_touching)
            continue;
        const auto move_inwards = [&](Positions& positions, const Positions& from) {
            Vec3 inwards = Vec3::Zero();
            for (const int neighbour : topology.neighbours(tie.vertex))
                inwards += (from.row(neighbour) - from.row(tie.vertex)).transpose();
            positions.row(tie.vertex) = from.row(tie.vertex) + k_opened * inwards.normalized().transpose();
        };
        move_inwards(cloth.positions, given);
        move_inwards(start, given_start);
    }
}

}  // namespace

PreparedCloth prepare_cloth(const GarmentMesh& rest, const Positions& start, const std::vector<int>& garments)
{
    Weld weld(rest);
    GarmentMesh cloth = weld.gather(rest);
    MeshTopology topology(cloth.triangles, int(cloth.positions.rows()));
    if (const auto merged = merge_near_vertices(cloth, topology, gather(weld, garments, cloth.positions.rows()))) {
        const GarmentMesh at_one_place { weld.place(*merged), rest.triangles, rest.warps };
        weld = Weld(at_one_place);
        cloth = weld.gather(at_one_place);
        topology = MeshTopology(cloth.triangles, int(cloth.positions.rows()));
    }
    Positions positions = weld.gather(start);
    std::vector<int> garment_of = gather(weld, garments, cloth.positions.rows());
    SewnPieces sewn = find_sewn_pieces(cloth, topology, garment_of);
    open_touching_seams(cloth, topology, sewn.ties, positions);
    return { std::move(weld),      std::move(cloth), std::move(topology), std::move(positions), std::move(sewn), {},
             std::move(garment_of) };
}

void untangle_clear_of(PreparedCloth& cloth, const TriangleMesh& obstacle)
{
    const TriangleMesh given { cloth.positions, cloth.rest.triangles };
    const Edges& edges = cloth.topology.edges();
    UntangleResult result = untangle(given, edges);
    if (result.positions != given.positions && crossing_count({ result.positions, given.triangles }, obstacle) > 0) {
        cloth.crossings = find_self_crossings(given, edges, TriangleTree(given));
        return;
    }
    cloth.positions = std::move(result.positions);
    cloth.crossings = std::move(result.left);
}

}  // namespace garmentfit
