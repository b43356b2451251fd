// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/refined_body.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "skin_weights.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {
namespace {

struct Refinement {
    TriangleMesh mesh;
    std::vector<std::array<int, 2>> ends;  ///< of the edge that each new vertex halves
};

/// The side of each triangle that is its longest; of equal ones that on the edge with the smallest number, so that
/// triangles beside each other agree.
std::vector<int> longest_sides(const MeshTopology& topology, const std::vector<double>& lengths, Eigen::Index triangles)
{
    std::vector<int> result;
    for (int f = 0; f < int(triangles); ++f) {
        const auto key = [&](int side) {
            const int edge = topology.edge_of(side);
            return std::tuple(edge < 0 ? -1 : lengths[std::size_t(edge)], -edge);
        };
        int longest = 3 * f;
        for (const int side : { 3 * f + 1, 3 * f + 2 })
            if (key(side) > key(longest))
                longest = side;
        result.push_back(longest);
    }
    return result;
}

/// Halves long edges that are the longest of all triangles at them. @return whether there are any
bool halve_longest_edges(Refinement& refined, double longest)
{
    auto& [mesh, ends] = refined;
    const MeshTopology topology(mesh.triangles, int(mesh.positions.rows()));
    std::vector<double> lengths;
    for (const auto& edge : topology.edges().rowwise())
        lengths.push_back((mesh.positions.row(edge[0]) - mesh.positions.row(edge[1])).norm());
    const std::vector<int> sides = longest_sides(topology, lengths, mesh.triangles.rows());
    const auto is_longest = [&](int side) { return sides[std::size_t(side / 3)] == side; };

    std::vector<std::array<int, 2>> halved;
    std::vector<Eigen::RowVector3i> more;
    const int count = int(mesh.positions.rows());
    for (int edge = 0; edge < int(lengths.size()); ++edge) {
        const auto at_edge = topology.sides_at(edge);
        if (lengths[std::size_t(edge)] <= longest || !std::all_of(at_edge.begin(), at_edge.end(), is_longest))
            continue;
        const int middle = count + int(halved.size());
        halved.push_back({ topology.edges()(edge, 0), topology.edges()(edge, 1) });
        for (const int side : at_edge) {
            Eigen::RowVector3i other = mesh.triangles.row(side / 3);
            other[side % 3] = middle;
            more.push_back(other);
            mesh.triangles(side / 3, (side % 3 + 1) % 3) = middle;
        }
    }
    if (halved.empty())
        return false;
    mesh.positions.conservativeResize(count + Eigen::Index(halved.size()), 3);
    for (std::size_t i = 0; i < halved.size(); ++i)
        mesh.positions.row(count + Eigen::Index(i))
            = (mesh.positions.row(halved[i][0]) + mesh.positions.row(halved[i][1])) / 2;
    const Eigen::Index triangles = mesh.triangles.rows();
    mesh.triangles.conservativeResize(triangles + Eigen::Index(more.size()), 3);
    for (std::size_t i = 0; i < more.size(); ++i)
        mesh.triangles.row(triangles + Eigen::Index(i)) = more[i];
    ends.insert(ends.end(), halved.begin(), halved.end());
    return true;
}

/// Of new vertices, whose ends may be new, too.
SkinWeights mean_weights(const SkinWeights& given, const std::vector<std::array<int, 2>>& ends)
{
    const Eigen::Index count = given.bones.rows();
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(count + Eigen::Index(ends.size()), bone_count);
    for (Eigen::Index v = 0; v < count; ++v)
        for (int k = 0; k < 4; ++k)
            dense(v, given.bones(v, k)) += given.weights(v, k);
    for (std::size_t i = 0; i < ends.size(); ++i)
        dense.row(count + Eigen::Index(i)) = (dense.row(ends[i][0]) + dense.row(ends[i][1])) / 2;
    return strongest_four(dense.bottomRows(Eigen::Index(ends.size())));
}

/// Whether half of the surface or more is made of triangles with a longer edge.
bool is_mostly_coarser(const TriangleMesh& surface, double edge)
{
    const auto& [positions, triangles] = surface;
    double whole = 0, coarser = 0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        double longest = 0;
        for (int k = 0; k < 3; ++k)
            longest
                = std::max(longest, (positions.row(triangles(f, k)) - positions.row(triangles(f, (k + 1) % 3))).norm());
        const double area = area_vector(positions, triangles, f).norm();
        whole += area;
        coarser += longest > edge ? area : 0;
    }
    return coarser > whole / 2;
}

}  // namespace

bool has_large_triangles(const BodyMesh& body) { return is_mostly_coarser(body.surface, k_large_triangle); }

bool has_triangles_to_refine(const BodyMesh& body) { return is_mostly_coarser(body.surface, k_refined_edge); }

RiggedBody refine_body(const BodyMesh& body, const Rig& rig)
{
    Refinement refined { body.surface, {} };
    while (halve_longest_edges(refined, k_refined_edge)) { }
    RiggedBody result { { std::move(refined.mesh), body.closed, body.repaired }, rig };
    append(result.rig.weights, mean_weights(rig.weights, refined.ends));
    return result;
}

}  // namespace garmentfit
