// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_joints.h"

#include <algorithm>
#include <cmath>

#include "garmentfit/error.h"
#include "leg_profile.h"
#include "spine_line.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

// literature: [deleva_1996_segments], shares of the length from where a limb leaves the trunk to its tip.
constexpr double k_elbow_at = 0.37, k_wrist_at = 0.74, k_knee_at = 0.40, k_ankle_at = 0.80;
constexpr double k_neck_base_share = 0.16, k_skull_base_share = 0.45;  // of the way from the shoulders to the crown

// derived: means of a man, a woman and a child of the house data, whose joints are known; shares of the stature
constexpr double k_neck_to_ankle = 0.80, k_neck_to_hips = 0.32, k_ankle_height = 0.043;

struct Shares {
    double middle, end;
};

/// From the hips to the shoulders, or to the crown where the arms leave at the hips.
Vec3 find_up(const LabelledSurface& surface)
{
    const auto node = [&](int n) { return surface.skeleton.nodes[n]; };
    const BodyGraph& g = surface.graph;
    const Vec3 hips = node(g.trunk.front());
    const Vec3 feet = 0.5 * (node(g.legs[0].back()) + node(g.legs[1].back()));
    const Vec3 trunk = node(g.trunk.back()) - hips, whole = node(g.headless ? g.trunk.back() : g.head.back()) - feet;
    return (trunk.norm() > k_short_trunk * whole.norm() ? trunk : whole).normalized();
}

double length_of_curve(const LabelledSurface& surface, int curve)
{
    const std::vector<Vec3> nodes = surface.curve(curve);
    double sum = 0;
    for (std::size_t i = 1; i < nodes.size(); ++i)
        sum += (nodes[i] - nodes[i - 1]).norm();
    return sum;
}

/// A limb whose joints are where a human's are, as shares of its free length.
LimbJoints divide_limb(const LabelledSurface& surface, const Slicer& slicer, int curve, const Shares& at)
{
    const Centreline line = centreline(slicer, surface.curve(curve), length_of_curve(surface, curve) / k_cuts_of_limb,
                                       surface.foreign_to(curve));
    const double most = k_latest_root * line.length();
    const double root = std::min(line.arcs[line.first_free], most), rest = line.length() - root;
    LimbJoints joints;
    joints.root = line.at(root);
    joints.middle = line.at(root + at.middle * rest);
    joints.end = line.at(root + at.end * rest);
    joints.tip = line.points.back();
    joints.whole = joints.widens = false;
    return joints;
}

bool are_likely(const std::array<LimbJoints, 2>& limbs, const std::array<double, 2>& lengths)
{
    const double pair = length_of(limbs[0]) / length_of(limbs[1]);
    if (!(std::abs(std::log(pair)) < k_largest_pair_difference))
        return false;
    for (int i = 0; i < 2; ++i) {
        const double ratio = (limbs[i].middle - limbs[i].root).norm() / (limbs[i].end - limbs[i].middle).norm();
        const double share = length_of(limbs[i]) / lengths[i];
        if (!(std::abs(std::log(ratio)) < k_largest_bone_ratio && share > k_least_limb_share
              && share < k_most_limb_share))
            return false;
    }
    return true;
}

/// The pair as `place` finds it, or divided as a human's.
template <class Place>
std::array<LimbJoints, 2> place_pair(const LabelledSurface& surface, const Slicer& slicer, int first,
                                     const Shares& shares, const Place& place)
{
    try {
        const std::array<LimbLine, 2> lines { trace_limb(surface, slicer, first),
                                              trace_limb(surface, slicer, first + 1) };
        const std::array<LimbJoints, 2> joints = place(lines);
        if (are_likely(joints, { length_of_curve(surface, first), length_of_curve(surface, first + 1) }))
            return joints;
    } catch (const InvalidInput&) {
        // a limb without a free part, or without a narrow place: divided below
    }
    return { divide_limb(surface, slicer, first, shares), divide_limb(surface, slicer, first + 1, shares) };
}

/// Thick legs stand further apart than a human's hips.
void spread_hips(std::array<LimbJoints, 2>& legs, const Vec3& up)
{
    const Vec3 knees = legs[0].middle - legs[1].middle, apart = legs[0].root - legs[1].root;
    const Vec3 across = (apart - apart.dot(up) * up).normalized();
    const double wanted = std::min(k_hips_to_knees * std::abs(knees.dot(across)), k_widest_hips * length_of(legs[0]));
    const double missing = std::max(0.0, wanted - apart.norm());
    legs[0].root += 0.5 * missing * across;
    legs[1].root -= 0.5 * missing * across;
}

/// Legs in a gown: straight down from a human's hips to the hem. Feet that show say where they point.
std::array<LimbJoints, 2> place_covered_legs(const LabelledSurface& surface, const Vec3& up)
{
    const auto node = [&](int n) { return surface.skeleton.nodes[n]; };
    const BodyGraph& g = surface.graph;
    const Vec3 shoulders = node(g.trunk.back());
    std::array<Vec3, 2> feet { node(g.legs[0].back()), node(g.legs[1].back()) };
    double ground = shoulders.dot(up);
    for (Eigen::Index v = 0; v < surface.mesh.positions.rows(); ++v)
        if (const int n = surface.skeleton.node_of_vertex[std::size_t(v)]; n >= 0 && g.place_of_node[n].curve > 1)
            ground = std::min(ground, surface.mesh.positions.row(v).dot(up));
    const double stature = (shoulders.dot(up) - ground) / (k_neck_to_ankle + k_ankle_height);
    const Vec3 apart = node(g.arms[0].back()) - node(g.arms[1].back());
    const Vec3 across = (apart - apart.dot(up) * up).normalized();
    if ((feet[0] - feet[1]).dot(across) < 0)
        std::swap(feet[0], feet[1]);
    std::array<LimbJoints, 2> legs;
    const bool is_one_end = g.legs[0].back() == g.legs[1].back();
    const Vec3 off = feet[0] - shoulders, before = off - off.dot(up) * up - off.dot(across) * across;
    for (const int i : { 0, 1 }) {
        LimbJoints& leg = legs[i];
        leg.root = shoulders - k_neck_to_hips * stature * up + (i == 0 ? 0.5 : -0.5) * k_hip_width * stature * across;
        leg.end = leg.root - (k_neck_to_ankle - k_neck_to_hips) * stature * up;
        leg.middle = 0.5 * (leg.root + leg.end);
        // one end is the middle of the hem, or the toes of a foot below it
        leg.tip = is_one_end ? Vec3(leg.end - k_ankle_height * stature * up + before) : feet[i];
        leg.whole = leg.widens = false;
    }
    return legs;
}

}  // namespace

BodyJoints label_figure(const TriangleMesh& proxy, const CurveSkeleton& skeleton, const Figure& figure)
{
    const auto sized = [&](double size) {
        BodyGraph graph = figure.graph;
        graph.size = graph.size_by_legs = size;
        graph.headless = true;  // lengths are not corrected towards a human's
        return graph;
    };
    const BodyGraph leg_graph = sized(figure.leg_size), arm_graph = sized(figure.arm_size);
    const LabelledSurface whole { proxy, skeleton, figure.graph }, of_legs { proxy, skeleton, leg_graph },
        of_arms { proxy, skeleton, arm_graph };
    const Slicer slicer(proxy);
    // legs are only covered where the figure stands; its trunk's curve may end at one side of the hem
    const Vec3 up = figure.graph.has_covered_legs ? Vec3(Vec3::UnitY()) : find_up(whole);

    BodyJoints joints;
    joints.size = figure.leg_size;
    joints.crown = find_crown(whole, up);
    if (figure.graph.has_covered_legs) {
        joints.legs = place_covered_legs(whole, up);
    } else {
        joints.legs = place_pair(of_legs, slicer, 2, { k_knee_at, k_ankle_at },
                                 [&](const auto& lines) { return place_legs(of_legs, lines, up, figure.leg_size); });
        spread_hips(joints.legs, up);
    }
    joints.pelvis = 0.5 * (joints.legs[0].root + joints.legs[1].root);
    joints.arms = place_pair(of_arms, slicer, 0, { k_elbow_at, k_wrist_at }, [&](const auto& lines) {
        std::array<LimbJoints, 2> arms = place_arms(of_arms, lines, up, figure.arm_size);
        adjust_arms(arms, joints.legs, arm_graph);
        return arms;
    });
    if (figure.graph.headless)
        require_hands_or_feet(joints);
    const Vec3 shoulders = 0.5 * (joints.arms[0].root + joints.arms[1].root);
    Centreline spine = trace_spine(whole, slicer, joints.pelvis, up);
    const double shoulder_arc = spine.arcs[spine.nearest_row(shoulders)],
                 above = std::max((joints.crown - shoulders).norm(), spine.length() - shoulder_arc);
    joints.neck_base = spine.at(
        std::min(shoulder_arc + k_neck_base_share * above, shoulder_arc + k_neck_over_arm * figure.arm_size));
    joints.skull_base = joints.neck_base + (k_skull_base_share - k_neck_base_share) * (joints.crown - joints.neck_base);
    joints.mid_neck = 0.5 * (joints.neck_base + joints.skull_base);
    place_back(spine, joints);
    if (!figure.graph.has_covered_legs)
        joints.legs_front = front_of_legs(whole, slicer, joints);
    return joints;
}

}  // namespace garmentfit
