// SPDX-License-Identifier: GPL-3.0-or-later
#include "kept_results.h"

#include <Eigen/Geometry>

#include "surface_measures.h"

namespace garmentfit {
namespace {

constexpr double k_rounding = 1e-7;  // unit: share of the diagonal; a file's numbers, times a unit, turned

Positions moved(const Positions& positions, const Eigen::Matrix4d& motion)
{
    return (positions * motion.topLeftCorner<3, 3>().transpose()).rowwise() + motion.topRightCorner<3, 1>().transpose();
}

}  // namespace

std::optional<Eigen::Matrix4d> similarity(const GarmentMesh& from, const GarmentMesh& to)
{
    if (from.positions.rows() != to.positions.rows() || from.triangles.rows() != to.triangles.rows()
        || from.triangles != to.triangles)
        return {};
    if (from.positions == to.positions)
        return Eigen::Matrix4d::Identity();
    const Eigen::Matrix4d motion = Eigen::umeyama(from.positions.transpose(), to.positions.transpose());
    const bool is_same = (moved(from.positions, motion) - to.positions).rowwise().norm().maxCoeff()
        < k_rounding * diagonal(to.positions);
    return is_same ? std::optional(motion) : std::nullopt;
}

void transform(TriangleMesh& mesh, const Eigen::Matrix4d& motion) { mesh.positions = moved(mesh.positions, motion); }

}  // namespace garmentfit
