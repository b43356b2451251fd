// SPDX-License-Identifier: GPL-3.0-or-later
#include "garments_beside.h"

#include <algorithm>
#include <map>

#include <Eigen/Geometry>

#include "disjoint_sets.h"
#include "garment_openings.h"
#include "plain_reading.h"
#include "surface_measures.h"
#include "tuning.h"
#include "used_vertices.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

/// Patches whose boxes meet, one after the other.
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

std::vector<Group> groups_of(const TriangleMesh& mesh, const std::vector<std::vector<int>>& patches)
{
    std::vector<Group> single;
    for (const std::vector<int>& patch : patches)
        single.push_back(group_of(mesh, patch));
    DisjointSets joined(int(single.size()));
    for (int i = 0; i < int(single.size()); ++i)
        for (int j = 0; j < i; ++j)
            if (single[i].box.intersects(single[j].box))
                joined.join(i, j);
    std::map<int, Group> groups;  // by the root
    for (int i = 0; i < int(single.size()); ++i) {
        Group& group = groups[joined.root(i)];
        group.faces.insert(group.faces.end(), single[i].faces.begin(), single[i].faces.end());
        group.box.extend(single[i].box);
        group.area += single[i].area;
    }
    std::vector<Group> result;
    for (auto& [root, group] : groups)
        result.push_back(std::move(group));
    return result;
}

/// Length that two ranges have in common; negative where they are apart.
double overlap(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b, int axis)
{
    return std::min(a.max()[axis], b.max()[axis]) - std::max(a.min()[axis], b.min()[axis]);
}

bool stands_beside(const Eigen::AlignedBox3d& box, const Eigen::AlignedBox3d& main)
{
    const double gap = k_beside_gap * main.diagonal().norm();
    const bool is_apart = overlap(box, main, 0) < -gap || overlap(box, main, 2) < -gap;
    return is_apart && box.diagonal().norm() > k_beside_size * main.diagonal().norm()
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
