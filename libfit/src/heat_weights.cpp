// SPDX-License-Identifier: GPL-3.0-or-later
#include "heat_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/SparseCholesky>
#include <flann/flann.hpp>

#include "fit/error.h"
#include "loose_vertices.h"
#include "nearest.h"
#include "parallel.h"
#include "segment.h"

namespace fit {
namespace {

constexpr double k_smallest_cotangent = 1e-3;  // keeps the matrix positive definite on obtuse triangles
constexpr double k_heat = 18;  // c of the paper; larger keeps skin stiffer between joints
constexpr double k_heat_of_arms = 1.5;  // else they would reach down the flank, far from the spine that should hold it
constexpr double k_least_facing = 0.1;  // cosine: no bone is hidden from skin, only further away
constexpr double k_normal_weight = 0.015;  // of the diagonal: half of how far a point that faces away seems
constexpr int k_neighbours = 4;  // that a transferred weight is blended from
constexpr int k_block = 4096;  // vertices, of which one core finds the neighbours at a time

/// Hands, feet and head hang on the bones before them.
Vec3 nearest_on_bone(const Vec3& p, const Skeleton& skeleton, int bone)
{
    Vec3 nearest = nearest_on_segment(p, skeleton.head(bone), skeleton.tail(bone));
    for (int e = 0; e < extremity_count; ++e)
        if (bone_before(Extremity(e)) == bone) {
            const Vec3 beyond = nearest_on_segment(p, skeleton.tail(bone), skeleton.tips[e]);
            if ((beyond - p).squaredNorm() < (nearest - p).squaredNorm())
                nearest = beyond;
        }
    return nearest;
}

struct NearestBone {
    int bone = -1;
    double distance = 0;
};

/// Nearest by the ball that touches the skin from inside and reaches the bone: bones that skin faces count as near. An arm
/// beside the trunk may be nearer to the flank than the spine is, but it does not lie behind that skin.
NearestBone nearest_visible(const Vec3& p, const Vec3& normal, const Skeleton& skeleton,
                            const std::array<bool, bone_count>& visible)
{
    NearestBone nearest;
    double smallest_ball = std::numeric_limits<double>::max();
    for (int b = 0; b < bone_count; ++b) {
        if (!visible[b])
            continue;
        const Vec3 from_bone = p - nearest_on_bone(p, skeleton, b);
        const double distance = from_bone.norm();
        const double ball = distance / std::max(k_least_facing, from_bone.dot(normal) / std::max(distance, 1e-300));
        if (ball < smallest_ball) {
            smallest_ball = ball;
            nearest = { b, distance };
        }
    }
    return nearest;
}

/// Cotangent Laplacian (positive semi-definite) and the area of each vertex.
Eigen::SparseMatrix<double> stiffness(const TriangleMesh& mesh, Eigen::VectorXd& areas)
{
    std::vector<Eigen::Triplet<double>> entries;
    areas = Eigen::VectorXd::Zero(mesh.positions.rows());
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int i = mesh.triangles(f, k), j = mesh.triangles(f, (k + 1) % 3), o = mesh.triangles(f, (k + 2) % 3);
            const Vec3 a = mesh.positions.row(i) - mesh.positions.row(o),
                       b = mesh.positions.row(j) - mesh.positions.row(o);
            const double twice_area = a.cross(b).norm();
            const double half_cotangent = 0.5 * std::max(k_smallest_cotangent, a.dot(b) / std::max(twice_area, 1e-300));
            areas[o] += twice_area / 6;
            entries.emplace_back(i, i, half_cotangent);
            entries.emplace_back(j, j, half_cotangent);
            entries.emplace_back(i, j, -half_cotangent);
            entries.emplace_back(j, i, -half_cotangent);
        }
    Eigen::SparseMatrix<double> matrix(mesh.positions.rows(), mesh.positions.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

/// Rows (position, weighted normal): near in this space means near and facing the same way.
std::vector<double> oriented_points(const Positions& positions, const Positions& normals, double normal_length)
{
    std::vector<double> rows;
    rows.reserve(6 * positions.rows());
    for (Eigen::Index v = 0; v < positions.rows(); ++v) {
        for (int k = 0; k < 3; ++k)
            rows.push_back(positions(v, k));
        for (int k = 0; k < 3; ++k)
            rows.push_back(normal_length * normals(v, k));
    }
    return rows;
}

/// Outwards. What had to be repaired may be turned any way: there the nearest place of the closed surface tells.
Positions outward_normals(const BodyMesh& body, const Positions& places)
{
    if (!body.repaired)
        return vertex_normals(body.surface.positions, body.surface.triangles);
    const Positions closed = vertex_normals(body.closed.positions, body.closed.triangles);
    const NearestPoint nearest(body.closed.positions);
    Positions normals(places.rows(), 3);
    for (Eigen::Index v = 0; v < normals.rows(); ++v)
        normals.row(v) = closed.row(nearest.index(places.row(v)));
    return normals;
}

void keep_four(const Eigen::RowVectorXd& row, Eigen::Index v, SkinWeights& weights)
{
    std::array<int, bone_count> order;
    std::iota(order.begin(), order.end(), 0);
    std::partial_sort(order.begin(), order.begin() + 4, order.end(),
                      [&](int a, int b) { return row[a] != row[b] ? row[a] > row[b] : a < b; });
    double sum = 0;
    for (int k = 0; k < 4; ++k)
        sum += std::max(0.0, row[order[k]]);
    for (int k = 0; k < 4; ++k) {
        weights.bones(v, k) = order[k];
        weights.weights(v, k) = std::max(0.0, row[order[k]]) / sum;
    }
}

}  // namespace

Eigen::MatrixXd heat_weights(const TriangleMesh& closed, const Skeleton& skeleton, const VisibleBones& visible)
{
    const Eigen::Index n = closed.positions.rows();
    Eigen::VectorXd areas;
    Eigen::SparseMatrix<double> system = stiffness(closed, areas);
    const Positions normals = vertex_normals(closed.positions, closed.triangles);
    Eigen::MatrixXd heat = Eigen::MatrixXd::Zero(n, bone_count);
    for (Eigen::Index v = 0; v < n; ++v) {
        const NearestBone nearest = nearest_visible(closed.positions.row(v), normals.row(v), skeleton, visible[v]);
        const double heat_of_bone = is_arm(nearest.bone) ? k_heat_of_arms : k_heat;
        const double source
            = heat_of_bone * areas[v] / std::max(std::pow(nearest.distance, 2), 1e-8);  // H of the paper
        system.coeffRef(v, v) += source;
        heat(v, nearest.bone) = source;
    }
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> solver(system);
    if (solver.info() != Eigen::Success)
        throw SolverFailure("skin weights: the heat equation cannot be solved on this surface");
    Eigen::MatrixXd weights = solver.solve(heat);
    weights = weights.cwiseMax(0.0);
    for (Eigen::Index v = 0; v < n; ++v)
        weights.row(v) /= weights.row(v).sum();
    return weights;
}

SkinWeights transferred(const TriangleMesh& from, const Eigen::MatrixXd& weights, const BodyMesh& to)
{
    const double diagonal = (from.positions.colwise().maxCoeff() - from.positions.colwise().minCoeff()).norm();
    std::vector<double> points
        = oriented_points(from.positions, vertex_normals(from.positions, from.triangles), k_normal_weight * diagonal);
    const Positions places = brought_to_stumps(to);
    std::vector<double> queries = oriented_points(places, outward_normals(to, places), k_normal_weight * diagonal);
    const std::size_t n = to.surface.positions.rows();
    flann::Index<flann::L2<double>> tree(flann::Matrix<double>(points.data(), from.positions.rows(), 6),
                                         flann::KDTreeSingleIndexParams());
    tree.buildIndex();
    std::vector<int> rows(n * k_neighbours);
    std::vector<double> squared(n * k_neighbours);
    parallel_for((n + k_block - 1) / k_block, [&](std::size_t block) {
        const std::size_t first = block * k_block, count = std::min<std::size_t>(k_block, n - first);
        flann::Matrix<int> found(rows.data() + first * k_neighbours, count, k_neighbours);
        flann::Matrix<double> distances(squared.data() + first * k_neighbours, count, k_neighbours);
        tree.knnSearch(flann::Matrix<double>(queries.data() + 6 * first, count, 6), found, distances, k_neighbours,
                       flann::SearchParams(-1));
    });

    SkinWeights result;
    result.bones.resize(n, 4);
    result.weights.resize(n, 4);
    for (std::size_t v = 0; v < n; ++v) {
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(bone_count);
        for (int k = 0; k < k_neighbours; ++k)
            row += weights.row(rows[v * k_neighbours + k])
                / (squared[v * k_neighbours + k] + 1e-12 * diagonal * diagonal);
        keep_four(row, v, result);
    }
    return result;
}

}  // namespace fit
