// SPDX-License-Identifier: GPL-3.0-or-later
#include "garments_beside.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "garment_openings.h"
#include "plain_reading.h"
#include "surface_measures.h"
#include "tuning.h"
#include "used_vertices.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

/// Patches that stand together.
struct Group {
    std::vector<int> faces;
    Eigen::AlignedBox3d box;
    double area = 0;  // m^2
};

Group group_of(const TriangleMesh& mesh, const std::vector<int>& patch)
{
    Group group { patch, {}, 0 };
    for (const int f : patch) {
        for (const int v : mesh.triangles.row(f))
            group.box.extend(Vec3(mesh.positions.row(v)));
        group.area += area_vector(mesh.positions, mesh.triangles, f).norm();
    }
    return group;
}

/// Joins those that are not apart along an axis, one after the other.
std::vector<Group> joined_along(std::vector<Group> groups, int axis, double gap)
{
    std::sort(groups.begin(), groups.end(),
              [axis](const Group& a, const Group& b) { return a.box.min()[axis] < b.box.min()[axis]; });
    std::vector<Group> result;
    for (Group& next : groups) {
        if (result.empty() || next.box.min()[axis] > result.back().box.max()[axis] + gap) {
            result.push_back(std::move(next));
            continue;
        }
        Group& group = result.back();
        group.faces.insert(group.faces.end(), next.faces.begin(), next.faces.end());
        group.box.extend(next.box);
        group.area += next.area;
    }
    return result;
}

/// What stands apart from left to right, or from front to back.
std::vector<Group> groups_of(const TriangleMesh& mesh, const std::vector<std::vector<int>>& patches)
{
    std::vector<Group> single;
    for (const std::vector<int>& patch : patches)
        single.push_back(group_of(mesh, patch));
    const double gap = k_beside_gap * diagonal(mesh.positions);
    std::vector<Group> across = joined_along(single, 0, gap);
    return across.size() > 1 ? across : joined_along(std::move(single), 2, gap);
}

/// Length that two ranges have in common; negative where they are apart.
double overlap(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b, int axis)
{
    return std::min(a.max()[axis], b.max()[axis]) - std::max(a.min()[axis], b.min()[axis]);
}

/// @param main  apart from it sideways
bool stands_beside(const Eigen::AlignedBox3d& box, const Eigen::AlignedBox3d& main)
{
    return box.diagonal().norm() > k_beside_size * main.diagonal().norm()
        && overlap(box, main, 1) > k_beside_overlap * std::min(box.sizes().y(), main.sizes().y());
}

/// Openings for a trunk and two limbs, at least.
bool is_garment(const TriangleMesh& mesh, const Group& group)
{
    const Triangles triangles = mesh.triangles(group.faces, Eigen::all);
    const std::vector<int> used = used_vertices(triangles);
    const PlainReading plain = read_plainly({ mesh.positions(used, Eigen::all), numbered_among(used, triangles) });
    return count_openings(plain.outer) >= k_enough_openings;
}

}  // namespace

std::vector<std::vector<int>> find_garments_beside(const TriangleMesh& mesh,
                                                   const std::vector<std::vector<int>>& patches)
{
    std::vector<std::vector<int>> beside;
    if (patches.size() < 2)
        return beside;
    std::vector<Group> groups = groups_of(mesh, patches);
    std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.area > b.area; });
    const Group main = std::move(groups.front());
    groups.erase(groups.begin());
    std::erase_if(groups, [&](const Group& group) { return !stands_beside(group.box, main.box); });
    if (groups.empty() || !is_garment(mesh, main))
        return beside;
    for (Group& group : groups)
        if (is_garment(mesh, group))
            beside.push_back(std::move(group.faces));
    return beside;
}

}  // namespace garmentfit
