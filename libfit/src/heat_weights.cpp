// SPDX-License-Identifier: GPL-3.0-or-later
#include "heat_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/SparseCholesky>
#include <flann/flann.hpp>

#include "fit/error.h"
#include "nearest.h"
#include "parallel.h"
#include "segment.h"

namespace fit {
namespace {

constexpr double k_smallest_cotangent = 1e-3;  // keeps the matrix positive definite on obtuse triangles
constexpr double k_heat = 3;  // c of the paper; larger keeps skin stiffer between joints
constexpr double k_normal_weight = 0.015;  // of the diagonal: half of how far a point that faces away seems
constexpr int k_flesh_rounds = 3;  // after two, hardly a vertex changes its bone
constexpr int k_neighbours = 4;  // that a transferred weight is blended from
constexpr int k_block = 4096;  // vertices, of which one core finds the neighbours at a time

/// Hands, feet and head hang on the bones before them.
double squared_distance_to_bone(const Vec3& p, const Skeleton& skeleton, int bone)
{
    double least = squared_distance_to_segment(p, skeleton.head(bone), skeleton.tail(bone));
    for (int e = 0; e < extremity_count; ++e)
        if (bone_before(Extremity(e)) == bone)
            least = std::min(least, squared_distance_to_segment(p, skeleton.tail(bone), skeleton.tips[e]));
    return least;
}

struct NearestBone {
    int bone = -1;
    double squared_distance = 0;
};

double median(std::vector<double>& values)
{
    if (values.empty())
        return 0;
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

/// How deep the bones lie under the skin of arms and trunk. A flank is nearer to the thin arm that hangs beside it than to the
/// spine, and yet lies far outside the arm's flesh: distances are compared from there.
struct Flesh {
    double of_arms = 0, of_trunk = 0;

    double over(int bone) const { return is_arm(bone) ? of_arms : of_trunk; }
};

NearestBone nearest_visible(const Vec3& p, const Skeleton& skeleton, const std::array<bool, bone_count>& visible,
                            const Flesh& flesh)
{
    NearestBone nearest;
    double least = std::numeric_limits<double>::max();
    for (int b = 0; b < bone_count; ++b) {
        if (!visible[b])
            continue;
        const double squared = squared_distance_to_bone(p, skeleton, b);
        const double above_flesh = std::sqrt(squared) - flesh.over(b);
        if (above_flesh < least) {
            least = above_flesh;
            nearest = { b, squared };
        }
    }
    return nearest;
}

/// The bone that warms each vertex: what flesh belongs to and how thick it is follow from each other in a few rounds.
std::vector<NearestBone> nearest_bones(const Positions& positions, const Skeleton& skeleton,
                                       const VisibleBones& visible)
{
    std::vector<NearestBone> nearest(visible.size());
    Flesh flesh;
    for (int round = 0; round < k_flesh_rounds; ++round) {
        std::vector<double> arms, trunk;
        for (std::size_t v = 0; v < nearest.size(); ++v) {
            nearest[v] = nearest_visible(positions.row(Eigen::Index(v)), skeleton, visible[v], flesh);
            if (!is_leg(nearest[v].bone))
                (is_arm(nearest[v].bone) ? arms : trunk).push_back(std::sqrt(nearest[v].squared_distance));
        }
        flesh = { median(arms), median(trunk) };
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
Positions outward_normals(const BodyMesh& body)
{
    if (!body.repaired)
        return vertex_normals(body.surface.positions, body.surface.triangles);
    const Positions closed = vertex_normals(body.closed.positions, body.closed.triangles);
    const NearestPoint nearest(body.closed.positions);
    Positions normals(body.surface.positions.rows(), 3);
    for (Eigen::Index v = 0; v < normals.rows(); ++v)
        normals.row(v) = closed.row(nearest.index(body.surface.positions.row(v)));
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
    const std::vector<NearestBone> nearest = nearest_bones(closed.positions, skeleton, visible);
    Eigen::MatrixXd heat = Eigen::MatrixXd::Zero(n, bone_count);
    for (Eigen::Index v = 0; v < n; ++v) {
        const double source = k_heat * areas[v] / std::max(nearest[v].squared_distance, 1e-8);  // H of the paper
        system.coeffRef(v, v) += source;
        heat(v, nearest[v].bone) = source;
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
    std::vector<double> queries
        = oriented_points(to.surface.positions, outward_normals(to), k_normal_weight * diagonal);
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
