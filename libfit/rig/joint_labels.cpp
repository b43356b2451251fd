// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_labels.h"

#include <algorithm>
#include <string>

#include "garmentfit/error.h"
#include "leg_profile.h"
#include "spine_line.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

// literature: [deleva_1996_segments] between joint centres, [drillis_1966_segments] for heights; shares of stature.
constexpr double k_leg = 0.485;  // hip to knee to ankle
constexpr double k_skull_base = 0.1;  // below the crown
constexpr double k_neck_base = 0.152;  // below the crown: the seventh cervical vertebra

constexpr int k_size_rounds
    = 2;  // derived: curves cut corners, so the first stature of a body with bent legs is too small
constexpr int k_mean_points = 10;  // unit: points of a mean along a line, about one for each cut

Centreline extend(const Centreline& line, const Vec3& to)
{
    std::vector<Vec3> points = line.points;
    points.push_back(to);
    return polyline(points, line.length() / line.size());
}

/// The highest point of a line that is at least `distance` away from `end`, a point beyond its last one; m.
Vec3 point_below(const Centreline& line, const Vec3& end, double distance)
{
    int i = line.size() - 1;
    while (i > 0 && (line.points[i] - end).norm() < distance)
        --i;
    return line.points[i];
}

/// Mean of a line's points between two distances from its end, m.
Vec3 mean_point(const Centreline& line, double from, double to)
{
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < k_mean_points; ++i)
        sum += line.at(line.length() - from + (from - to) * (i + 0.5) / k_mean_points) / k_mean_points;
    return sum;
}

/// Places legs, pelvis and the stature, which depend on each other. @return the line of the spine
Centreline place_legs_and_spine(const LabelledSurface& surface, const Slicer& slicer, const Vec3& up,
                                BodyJoints& joints)
{
    const BodyGraph& graph = surface.graph;
    const std::array<LimbLine, 2> legs { trace_limb(surface, slicer, 2), trace_limb(surface, slicer, 3) };
    Centreline spine;
    for (int round = 0; round < k_size_rounds; ++round) {
        joints.legs = place_legs(surface, legs, up, joints.size);
        joints.pelvis = 0.5 * (joints.legs[0].root + joints.legs[1].root);
        spine = trace_spine(surface, slicer, joints.pelvis, up);
        if (graph.headless)  // the curve ends where the arms leave
            spine = extend(spine, joints.crown);
        const double leg = 0.5 * (length_of(joints.legs[0]) + length_of(joints.legs[1]));
        joints.size = 0.5 * (leg / k_leg + graph.size);
    }
    return spine;
}

/// By how much the neck begins too far above the shoulders, m. A head that is larger than a human's reaches further
/// down.
double neck_in_head(const BodyJoints& joints)
{
    const Vec3 shoulders = 0.5 * (joints.arms[0].root + joints.arms[1].root), trunk = shoulders - joints.pelvis;
    const double above = (joints.neck_base - shoulders).dot(trunk.normalized());
    return std::max(0.0, above - k_neck_above_shoulders * trunk.norm());
}

void place_neck(const Centreline& spine, bool headless, BodyJoints& joints)
{
    const double head = headless ? k_neck_stub : 1;
    const double below_crown = head * k_neck_base * joints.size;
    joints.neck_base = point_below(spine, joints.crown, below_crown);
    joints.neck_base = point_below(spine, joints.crown, below_crown + neck_in_head(joints));
    joints.skull_base
        = joints.crown + head * k_skull_base * joints.size * (joints.neck_base - joints.crown).normalized();
    if (!headless)
        joints.head_off_neck
            = mean_point(spine, k_head * joints.size, 0) - mean_point(spine, k_neck * joints.size, k_jaw * joints.size);
    joints.mid_neck = 0.5 * (joints.neck_base + joints.skull_base);
}

}  // namespace

TrunkAxes trunk_axes(const BodyJoints& joints)
{
    TrunkAxes axes;
    axes.up = (joints.neck_base - joints.pelvis).normalized();
    const auto sideways = [&](const std::array<LimbJoints, 2>& limbs) -> Vec3 {
        const Vec3 apart = limbs[0].root - limbs[1].root;
        return (apart - apart.dot(axes.up) * axes.up).normalized();
    };
    const Vec3 hips = sideways(joints.legs), shoulders = sideways(joints.arms);
    axes.same_order = hips.dot(shoulders) > 0;
    const Vec3 across = (hips + (axes.same_order ? 1 : -1) * shoulders).normalized();  // from leg 1 to leg 0
    axes.front = across.cross(axes.up).normalized();
    return axes;
}

void require_hands_or_feet(const BodyJoints& joints)
{
    int found = 0;
    for (const LimbJoints& limb : { joints.arms[0], joints.arms[1], joints.legs[0], joints.legs[1] })
        found += limb.widens;
    if (found < k_fewest_without_head)
        throw InvalidInput(
            ErrorCode::not_human,
            "body: no head found, and " + std::to_string(found) + " of 4 limbs widen to a hand or foot (at least "
                + std::to_string(k_fewest_without_head) + "), so these are clothes without a body; give a human body");
}

BodyJoints label_joints(const TriangleMesh& proxy, const CurveSkeleton& skeleton, const BodyGraph& graph)
{
    const LabelledSurface surface { proxy, skeleton, graph };
    const Slicer slicer(proxy);
    const Vec3 up = (skeleton.nodes[graph.trunk.back()] - skeleton.nodes[graph.trunk.front()]).normalized();

    BodyJoints joints;
    joints.size = graph.size;
    joints.crown = find_crown(surface, up);
    const std::array<LimbLine, 2> arms { trace_limb(surface, slicer, 0), trace_limb(surface, slicer, 1) };
    const Centreline spine = place_legs_and_spine(surface, slicer, up, joints);
    joints.arms = place_arms(surface, arms, up, joints.size);
    if (graph.headless)
        require_hands_or_feet(joints);
    adjust_arms(joints.arms, joints.legs, graph);
    place_neck(spine, graph.headless, joints);
    place_back(spine, joints);
    joints.legs_front = front_of_legs(surface, slicer, joints);
    return joints;
}

}  // namespace garmentfit
