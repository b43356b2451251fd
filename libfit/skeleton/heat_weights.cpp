// SPDX-License-Identifier: GPL-3.0-or-later
#include "heat_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/SparseCholesky>

#include "cotangent_laplacian.h"
#include "garmentfit/error.h"
#include "segment.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace skeleton_tuning;

constexpr double k_smallest_squared_distance = 1e-8;  // m^2, unit: 0.1 mm, for skin that touches a bone
constexpr double k_no_length = 1e-300;  // unit: avoids 0 / 0
/// unit: share of the mean area of a vertex. Where triangles without area are a part of their own, no heat would come in.
constexpr double k_least_area = 1e-9;

/// The nearest point of a bone, which includes the hand, foot or head at its end.
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

/// The bone with the smallest ball that touches the skin from inside and reaches the bone. An arm beside the trunk may
/// be nearer to the flank than the spine, but it does not lie behind that skin, so its ball is larger.
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
        const double ball
            = distance / std::max(k_least_facing, from_bone.dot(normal) / std::max(distance, k_no_length));
        if (ball < smallest_ball) {
            smallest_ball = ball;
            nearest = { b, distance };
        }
    }
    return nearest;
}

}  // namespace

Eigen::MatrixXd heat_weights(const TriangleMesh& closed, const Skeleton& skeleton, const VisibleBones& visible)
{
    const Eigen::Index n = closed.positions.rows();
    auto [system, areas] = cotangent_laplacian(closed);
    const Positions normals = vertex_normals(closed.positions, closed.triangles);
    const double least_area = k_least_area * areas.mean();
    Eigen::MatrixXd heat = Eigen::MatrixXd::Zero(n, bone_count);
    for (Eigen::Index v = 0; v < n; ++v) {
        const NearestBone nearest = nearest_visible(closed.positions.row(v), normals.row(v), skeleton, visible[v]);
        const double heat_of_bone = is_arm(nearest.bone) ? k_heat_of_arms : k_heat;
        const double source = heat_of_bone * std::max(areas[v], least_area)
            / std::max(std::pow(nearest.distance, 2), k_smallest_squared_distance);  // H of the paper
        system.coeffRef(v, v) += source;
        heat(v, nearest.bone) = source;
    }
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> solver(system);
    if (solver.info() != Eigen::Success)
        throw SolverFailure("skin weights: the heat equation has no solution on this surface; remesh the body");
    Eigen::MatrixXd weights = solver.solve(heat);
    weights = weights.cwiseMax(0.0);
    for (Eigen::Index v = 0; v < n; ++v)
        weights.row(v) /= weights.row(v).sum();
    return weights;
}

}  // namespace garmentfit
