// SPDX-License-Identifier: GPL-3.0-or-later
#include "limb_joints.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bend.h"
#include "limb_end.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

// literature: [deleva_1996_segments] between joint centres, [drillis_1966_segments] for heights; shares of stature.
constexpr double k_hand = 0.108;  // wrist to fingertip
constexpr double k_ankle_height = 0.041;  // above the sole
// literature: [deleva_1996_segments], shares of the limb's length.
constexpr double k_elbow_ratio = 0.51;  // shoulder to elbow
constexpr double k_knee_ratio = 0.49;  // hip to knee

/// Curves end before the surface does. Extends the line to the cut of the stump, which counts as the last joint.
Centreline extend_to_cut(const LabelledSurface& surface, const LimbLine& limb, double size)
{
    Centreline line = limb.line;
    const Vec3 last = line.at(line.length() - k_stump_cap * size);
    const Vec3 axis = (last - line.at(line.length() - k_stump * size)).normalized();
    const Vec3 cut = farthest_along(surface.last_vertices(limb.curve, k_stump * size), axis);
    const Vec3 end = last + (cut - last).dot(axis) * axis;
    line.arcs.push_back(line.length() + (end - line.points.back()).norm());
    line.points.push_back(end);
    return line;
}

/// The line of a limb up to the row of its last joint, wrist or ankle, or the cut of the stump.
struct LineToJoint {
    Centreline line;
    int last;
};

/// @param narrow  row of the narrowest cut, the last joint of a whole limb. @throws InvalidInput that names the joint.
LineToJoint find_last_joint(const LabelledSurface& surface, const LimbLine& limb, bool whole, int narrow,
                            const char* joint, double size)
{
    Centreline line = whole ? limb.line : extend_to_cut(surface, limb, size);
    const int last = whole ? narrow : line.size() - 1;
    require_part(last > line.first_free + k_fewest_limb_cuts, joint, limb.tip());
    return { std::move(line), last };
}

// ---- arms -----------------------------------------------------------------------------------------------------------

/// @param out  towards the side of this arm, unit, square to up
Vec3 shoulder(const Vec3& ring, const Vec3& elbow, const Vec3& up, const Vec3& out, double size)
{
    const Vec3 inwards = (ring - elbow).normalized();
    const double held_out = -inwards.dot(out);
    return ring
        + size
        * ((k_shoulder_inwards - k_shoulder_back * held_out) * inwards + k_shoulder_up * up + k_shoulder_out * out);
}

LimbJoints place_arm(const LabelledSurface& surface, const LimbLine& arm, const Vec3& up, const Vec3& out, double size)
{
    const Vec3 along = (arm.tip() - arm.line.at(k_last_of_arm * arm.line.length())).normalized();
    LimbJoints joints;
    joints.tip = farthest_along(surface.last_vertices(arm.curve, k_hand_skin * size), along);
    const Narrowest narrow = find_narrowest(
        arm.line, joints.tip, { k_least_hand * size, k_hand * size, k_most_hand * size, k_hand_spread * size });
    require_part(narrow.row >= 0, "wrist", arm.tip());
    joints.widens = narrow.widens || shows_hand(arm.line, size);
    joints.whole = has_hand(arm.line, size);
    const auto [line, wrist] = find_last_joint(surface, arm, joints.whole, narrow.row, "wrist", size);
    joints.end = line.points[wrist];
    joints.middle = place_bend(line, line.first_free, wrist, arm.ring(), k_elbow_ratio, size);
    joints.root = shoulder(arm.ring(), joints.middle, up, out, size);
    return joints;
}

// ---- legs -----------------------------------------------------------------------------------------------------------

/// The lowest point of heel and sole about the shin's axis.
Vec3 sole_below(const std::vector<Vec3>& foot, const Vec3& knee, const Vec3& shin_axis, double radius)
{
    std::vector<Vec3> heel;
    for (const Vec3& p : foot)
        if ((p - knee).cross(shin_axis).norm() < radius)
            heel.push_back(p);
    require_part(!heel.empty(), "heel", foot.front());
    return farthest_along(heel, shin_axis);
}

/// On the shin's axis at the ankle's height above the sole. For a pointed foot the toes are the sole, hence the limit.
Vec3 ankle(const std::vector<Vec3>& foot, const Vec3& knee, const Vec3& narrow, double size)
{
    const Vec3 shin_axis = (narrow - knee).normalized();
    const Vec3 sole = sole_below(foot, knee, shin_axis, k_heel_radius * size);
    const double above_sole = (sole - narrow).dot(shin_axis) - k_ankle_height * size;
    return narrow + std::min(above_sole, k_ankle_below_shin * size) * shin_axis;
}

/// Direction from the thigh to the hip, from the first part of the thigh.
Vec3 direction_to_hip(const LimbLine& leg, double size)
{
    return (leg.ring() - leg.line.at(leg.line.arcs[leg.line.first_free] + k_first_of_thigh * size)).normalized();
}

/// The hips are placed as a pair: the skin shows their midpoint and the tilt of the pelvis, but hardly their distance.
std::array<Vec3, 2> place_hips(const std::array<LimbLine, 2>& legs, const Vec3& up, double size)
{
    const Vec3 along[] { direction_to_hip(legs[0], size), direction_to_hip(legs[1], size) };
    const Vec3 middle = 0.5 * (legs[0].ring() + legs[1].ring())
        + size * (0.5 * k_hips_along_thighs * (along[0] + along[1]) - k_hips_below_rings * up);
    const Vec3 across
        = (legs[0].ring() - legs[1].ring() + 0.5 * k_hips_along_thighs * size * (along[0] - along[1])).normalized();
    return { middle + 0.5 * k_hip_width * size * across, middle - 0.5 * k_hip_width * size * across };
}

LimbJoints place_leg(const LabelledSurface& surface, const LimbLine& leg, const Vec3& hip, double size)
{
    const std::vector<Vec3> foot = surface.last_vertices(leg.curve, k_foot_skin * size);
    const Narrowest narrow = find_narrowest(
        leg.line, leg.tip(), { k_least_foot * size, k_usual_foot * size, k_most_foot * size, k_foot_spread * size });
    LimbJoints joints;
    joints.widens = narrow.widens || shows_foot(leg.line, size);
    joints.whole = has_foot(leg.line, size);
    const auto [line, shin] = find_last_joint(surface, leg, joints.whole, narrow.row, "ankle", size);
    joints.root = hip;
    const double knee_ratio = joints.whole ? k_knee_above_shin : k_knee_ratio;
    joints.middle = place_bend(line, line.first_free, shin, joints.root, knee_ratio, size);
    joints.end = joints.whole ? ankle(foot, joints.middle, line.points[shin], size) : line.points[shin];
    const Vec3 toes
        = joints.whole ? Vec3(leg.tip() - joints.end) : Vec3(joints.end - joints.middle);  // a stump has none
    joints.tip = *std::max_element(foot.begin(), foot.end(), [&](const Vec3& a, const Vec3& b) {
        return (a - joints.end).dot(toes) < (b - joints.end).dot(toes);
    });
    return joints;
}

// ---- lengths --------------------------------------------------------------------------------------------------------

/// One length for both upper bones: partly the measured one, partly the one expected from the lower bones.
double upper_length(const std::array<LimbJoints, 2>& limbs, double upper_ratio)
{
    double measured = 0, expected = 0;
    for (const LimbJoints& limb : limbs) {
        measured += 0.5 * (limb.root - limb.middle).norm();
        expected += 0.5 * (limb.end - limb.middle).norm() * upper_ratio / (1 - upper_ratio);
    }
    return k_measured_share * (measured + expected);
}

/// Gives both upper bones the same length.
void equalise_upper_bones(std::array<LimbJoints, 2>& limbs, double upper_ratio)
{
    const double upper = upper_length(limbs, upper_ratio);
    for (LimbJoints& limb : limbs)
        limb.root = limb.middle + upper * (limb.root - limb.middle).normalized();
}

/// 0 for a straight limb to 1 for a bent one.
double bend_share(const LimbJoints& limb)
{
    const double cosine = (limb.middle - limb.root).normalized().dot((limb.end - limb.middle).normalized());
    return std::clamp((std::acos(std::clamp(cosine, -1.0, 1.0)) - k_bent_from) / (k_bent_to - k_bent_from), 0.0, 1.0);
}

/// Moves roots, and middle joints of straight limbs, so that the mean length of a pair approaches the usual length, m.
/// A limb that is much too short begins too far from the trunk's centre, where flesh, or filled holes of a scan, bridge
/// it to the trunk: then most of the missing length is added.
void correct_lengths(std::array<LimbJoints, 2>& limbs, double usual)
{
    const double measured = 0.5 * (length_of(limbs[0]) + length_of(limbs[1]));
    const double missing = std::log(usual / measured);
    const double short_by = std::clamp((missing - k_short_from) / (k_short_to - k_short_from), 0.0, 1.0);
    const double factor = std::exp(missing * (k_usual_share + short_by * (k_short_share - k_usual_share)));
    for (LimbJoints& limb : limbs) {
        const double goal = length_of(limb) + (factor - 1) * measured;
        const Vec3 upper = (limb.root - limb.middle).normalized();
        limb.middle += (factor - 1) * (1 - bend_share(limb)) * (limb.middle - limb.end);
        limb.root = limb.middle + (goal - (limb.end - limb.middle).norm()) * upper;
    }
}

/// Moves both hips by the same vector, so that the pelvis keeps its width.
void keep_hip_width(std::array<LimbJoints, 2>& legs, const std::array<Vec3, 2>& hips)
{
    const Vec3 shift = 0.5 * (legs[0].root - hips[0] + legs[1].root - hips[1]);
    for (int i = 0; i < 2; ++i)
        legs[i].root = hips[i] + shift;
}

}  // namespace

double length_of(const LimbJoints& limb) { return (limb.middle - limb.root).norm() + (limb.end - limb.middle).norm(); }

bool are_whole(const std::array<LimbJoints, 2>& limbs) { return limbs[0].whole && limbs[1].whole; }

LimbLine trace_limb(const LabelledSurface& surface, const Slicer& slicer, int curve)
{
    LimbLine limb {
        curve, centreline(slicer, surface.curve(curve), k_spacing * surface.graph.size, surface.foreign_to(curve))
    };
    require_part(limb.line.first_free + k_fewest_free_cuts < limb.line.size(), curve < 2 ? "free arm" : "free leg",
                 limb.tip());
    return limb;
}

std::array<LimbJoints, 2> place_legs(const LabelledSurface& surface, const std::array<LimbLine, 2>& legs,
                                     const Vec3& up, double size)
{
    const BodyGraph& graph = surface.graph;
    const std::array<Vec3, 2> hips = place_hips(legs, up, size);
    std::array<LimbJoints, 2> joints { place_leg(surface, legs[0], hips[0], size),
                                       place_leg(surface, legs[1], hips[1], size) };
    equalise_upper_bones(joints, k_knee_ratio);
    if (are_whole(joints) && !graph.headless)
        correct_lengths(joints, k_whole_leg * std::min(graph.size, graph.size_by_legs));
    keep_hip_width(joints, hips);
    return joints;
}

std::array<LimbJoints, 2> place_arms(const LabelledSurface& surface, const std::array<LimbLine, 2>& arms,
                                     const Vec3& up, double size)
{
    const Vec3 apart = arms[0].ring() - arms[1].ring();
    const Vec3 across = (apart - apart.dot(up) * up).normalized();
    return { place_arm(surface, arms[0], up, across, size), place_arm(surface, arms[1], up, -across, size) };
}

void adjust_arms(std::array<LimbJoints, 2>& arms, const std::array<LimbJoints, 2>& legs, const BodyGraph& graph)
{
    equalise_upper_bones(arms, k_elbow_ratio);
    if (are_whole(arms) && are_whole(legs) && !graph.headless)
        correct_lengths(arms, k_arm * graph.size);
}

}  // namespace garmentfit
