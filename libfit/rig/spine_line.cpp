// SPDX-License-Identifier: GPL-3.0-or-later
#include "spine_line.h"

#include "tuning.h"

namespace garmentfit {

using namespace rig_tuning;

Centreline trace_spine(const LabelledSurface& surface, const Slicer& slicer, const Vec3& pelvis, const Vec3& up)
{
    const auto is_limb = [&](int vertex) {
        const int node = surface.skeleton.node_of_vertex[vertex];
        return node >= 0 && surface.graph.place_of_node[node].curve < k_head_curve;
    };
    std::vector<Vec3> curve = surface.curve(k_trunk_curve);
    const std::vector<Vec3> head = surface.curve(k_head_curve);
    curve.insert(curve.end(), head.begin() + 1, head.end());
    const double spacing = k_spacing * surface.graph.size;
    const Centreline cuts = centreline(slicer, curve, spacing, is_limb);
    std::vector<Vec3> middles { pelvis };
    for (int i = 0; i < cuts.size(); ++i)
        if (cuts.free[i] && cuts.across[i]
            && (cuts.points[i] - pelvis).dot(up) > k_pelvis_cuts * k_spacing * surface.graph.size)
            middles.push_back(cuts.points[i]);
    return polyline(middles, k_spine_spacing * k_spacing * surface.graph.size);
}

Vec3 find_crown(const LabelledSurface& surface, const Vec3& up)
{
    const int top = surface.graph.headless ? k_trunk_curve : k_head_curve;
    return farthest_along(surface.last_vertices(top, k_crown_skin * surface.graph.size), up);
}

void place_back(const Centreline& spine, BodyJoints& joints)
{
    const double neck = spine.arcs[spine.nearest_row(joints.neck_base)];
    joints.lower_spine = spine.at(neck / 3);
    joints.upper_spine = spine.at(neck * 2 / 3);
}

}  // namespace garmentfit
