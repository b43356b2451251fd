// SPDX-License-Identifier: GPL-3.0-or-later
#include "garments_beside.h"

#include <algorithm>
#include <initializer_list>

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

/// What stands apart along the first of some axes along which anything does.
std::vector<Group> groups_of(const TriangleMesh& mesh, const std::vector<std::vector<int>>& patches,
                             std::initializer_list<int> axes)
{
    std::vector<Group> single;
    for (const std::vector<int>& patch : patches)
        single.push_back(group_of(mesh, patch));
    const double gap = k_beside_gap * diagonal(mesh.positions);
    for (const int axis : axes)
        if (std::vector<Group> groups = joined_along(single, axis, gap); groups.size() > 1)
            return groups;
    return {};
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

TriangleMesh outer_sheet_of(const TriangleMesh& mesh, const Group& group)
{
    const Triangles triangles = mesh.triangles(group.faces, Eigen::all);
    const std::vector<int> used = used_vertices(triangles);
    return read_plainly({ mesh.positions(used, Eigen::all), numbered_among(used, triangles) }).outer;
}

/// Openings for a trunk and two limbs, at least.
bool is_garment(const TriangleMesh& mesh, const Group& group)
{
    return count_openings(outer_sheet_of(mesh, group)) >= k_enough_openings;
}

/// Whether a body passes through a piece of it, as through a skirt.
bool has_passage(const TriangleMesh& mesh, const Group& group)
{
    const std::vector<Opening> openings = openings_of(outer_sheet_of(mesh, group));
    return std::any_of(openings.begin(), openings.end(), [&](const Opening& one) {
        return std::any_of(openings.begin(), openings.end(),
                           [&](const Opening& other) { return &other != &one && other.piece == one.piece; });
    });
}

double length_of(const Group& group) { return group.box.diagonal().norm(); }

}  // namespace

std::vector<std::vector<int>> find_garments_beside(const TriangleMesh& mesh,
                                                   const std::vector<std::vector<int>>& patches)
{
    std::vector<std::vector<int>> beside;
    if (patches.size() < 2)
        return beside;
    std::vector<Group> groups = groups_of(mesh, patches, { 0, 2 });  // from left to right, from front to back
    if (groups.empty())
        return beside;
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

std::vector<std::vector<int>> find_plinths(const TriangleMesh& mesh, const std::vector<std::vector<int>>& patches)
{
    if (patches.size() < 2)
        return {};
    std::vector<Group> groups = groups_of(mesh, patches, { 1, 0, 2 });
    std::stable_sort(groups.begin(), groups.end(),
                     [](const Group& a, const Group& b) { return length_of(a) < length_of(b); });
    if (groups.size() < 2 || length_of(groups[1]) < k_backdrop_size * length_of(groups[0])
        || !is_garment(mesh, groups[0]))
        return {};
    std::vector<std::vector<int>> plinths;
    for (std::size_t i = 1; i < groups.size(); ++i) {
        if (has_passage(mesh, groups[i]))
            return {};
        plinths.push_back(std::move(groups[i].faces));
    }
    return plinths;
}

}  // namespace garmentfit
