// SPDX-License-Identifier: GPL-3.0-or-later
#include "stiff_details.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "surface_measures.h"

namespace garmentfit {
namespace {

// unit: what is narrower, in squares of its length, is a line, about which a detail could turn.
constexpr double k_line = 1e-4;

Positions about_their_middle(const Positions& points) { return points.rowwise() - points.colwise().mean(); }

bool lie_in_a_line(const Positions& points)
{
    const Vec3 spread = squared_extents(points);
    return !(spread[1] > k_line * spread[2]);
}

/// Of each detail the vertices that are sewn to it, and are of no detail.
std::vector<std::vector<int>> find_grounds(const SewnPieces& sewn, Eigen::Index vertices)
{
    std::vector<int> detail_of(vertices, -1);
    for (int d = 0; d < int(sewn.details.size()); ++d)
        for (const int v : sewn.details[d].vertices)
            detail_of[v] = d;
    std::vector<std::vector<int>> result(sewn.details.size());
    const auto add = [&](int on_detail, int on_ground) {
        if (detail_of[on_detail] >= 0 && detail_of[on_ground] < 0)
            result[detail_of[on_detail]].push_back(on_ground);
    };
    for (const Tie& tie : sewn.ties)
        for (const int corner : tie.corners) {
            add(tie.vertex, corner);
            add(corner, tie.vertex);
        }
    for (std::vector<int>& ground : result) {
        std::sort(ground.begin(), ground.end());
        ground.erase(std::unique(ground.begin(), ground.end()), ground.end());
    }
    return result;
}

}  // namespace

StiffDetails::StiffDetails(const SewnPieces& sewn, const Positions& x) : is_detail_(x.rows(), 0)
{
    std::vector<std::vector<int>> grounds = find_grounds(sewn, x.rows());
    for (std::size_t d = 0; d < grounds.size(); ++d) {
        Positions ground = x(grounds[d], Eigen::all);
        if (ground.rows() < 3 || lie_in_a_line(ground))
            continue;
        std::vector<int> vertices = sewn.details[d].vertices;
        for (const int v : vertices)
            is_detail_[v] = 1;
        if (sewn.details[d].is_link())
            vertices.insert(vertices.end(), grounds[d].begin(), grounds[d].end());
        Positions shape = x(vertices, Eigen::all);
        details_.push_back({ std::move(vertices), std::move(grounds[d]), std::move(shape), std::move(ground) });
    }
}

std::vector<Tie> StiffDetails::other_ties(const std::vector<Tie>& ties) const
{
    std::vector<Tie> result;
    std::copy_if(ties.begin(), ties.end(), std::back_inserter(result), [&](const Tie& tie) {
        const auto holds = [&](int v) { return contains(v); };
        return !holds(tie.vertex) && std::none_of(tie.corners.begin(), tie.corners.end(), holds);
    });
    return result;
}

void StiffDetails::follow(Positions& x) const
{
    for (const Detail& detail : details_) {
        const Positions ground = x(detail.ground, Eigen::all);
        const Eigen::Isometry3d motion(Eigen::umeyama(detail.ground_shape.transpose(), ground.transpose(), false));
        x(detail.vertices, Eigen::all)
            = (detail.shape * motion.linear().transpose()).rowwise() + motion.translation().transpose();
    }
}

Positions StiffDetails::following(Positions ways, const Positions& x) const
{
    if (empty())
        return ways;
    Positions there = x + ways;
    follow(there);
    for (const Detail& detail : details_)
        for (const int v : detail.vertices)
            ways.row(v) = there.row(v) - x.row(v);
    return ways;
}

// The ground turns by w = I^-1 sum(arm x way), I = sum(|arm|^2 - arm arm^T), so a torque about its middle does the work
// of the forces (I^-1 torque) x arm.
void StiffDetails::hand_down(Positions& forces, const Positions& x) const
{
    for (const Detail& detail : details_) {
        const Positions ground = x(detail.ground, Eigen::all), arms = about_their_middle(ground);
        const Eigen::RowVector3d middle = ground.colwise().mean();
        Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
        for (const int v : detail.vertices) {
            const Vec3 of_vertex = forces.row(v), arm = x.row(v) - middle;
            force += of_vertex;
            torque += arm.cross(of_vertex);
            forces.row(v).setZero();
        }
        const Eigen::Matrix3d spread = arms.transpose() * arms,
                              inertia = spread.trace() * Eigen::Matrix3d::Identity() - spread;
        const Vec3 turn = inertia.ldlt().solve(torque);
        for (std::size_t i = 0; i < detail.ground.size(); ++i)
            forces.row(detail.ground[i])
                += force / double(detail.ground.size()) + turn.cross(Vec3(arms.row(Eigen::Index(i))));
    }
}

}  // namespace garmentfit
