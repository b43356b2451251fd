// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_labels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "bend.h"
#include "garmentfit/error.h"
#include "limb_end.h"

namespace garmentfit {
namespace {

// Shares of stature between joint centres [deleva_1996_segments], heights and widths [drillis_1966_segments].
constexpr double k_leg = 0.485;  // hip to knee to ankle
constexpr double k_hand = 0.108;  // wrist to fingertip
constexpr double k_ankle_height = 0.041;  // above the sole
constexpr double k_ankle_below_shin = 0.05;  // at most, below where the shin is narrowest
constexpr double k_skull_base = 0.1;  // below the crown
constexpr double k_neck_base = 0.152;  // below the crown: the seventh vertebra of the neck
constexpr double k_head = 0.09, k_jaw = 0.13,
                 k_neck = 0.2;  // below the end of the spine's line: head to 0.09, neck from 0.13
constexpr double k_stub = 0.25;  // of neck and head is left where the head is missing
constexpr double k_elbow_ratio = 0.51;  // of the way from shoulder to wrist
constexpr double k_knee_ratio = 0.49;  // of the way from hip to ankle
constexpr double k_knee_above_shin = 0.545;  // of the way from hip to where the shin is narrowest

// Where the joint lies, as shares of stature, from the middle of the first outline that is the limb's own.
constexpr double k_hips_along_thighs = 0.04, k_hips_below_rings = 0.009;  // the middle between them
constexpr double k_hip_width = 0.123;  // between the joints; flesh says little about it
constexpr double k_shoulder_up = 0.012, k_shoulder_out = 0.007;  // the outline at the armpit hangs lower than the joint
constexpr double k_shoulder_inwards = 0.0135, k_shoulder_back = 0.03;  // of a hanging arm, and less of one held out

constexpr double k_hand_spread = 0.02;  // of stature: how far people stray

constexpr double k_stump = 0.06, k_stump_cap = 0.02;  // of stature: where a stump's axis is read off, before its end

// Limbs that come out this much shorter than usual (logarithms) start too far out, where skin, or a scan's filled holes, bridge them to
// the trunk. How far their length is then moved to the usual one; the middle joint of a straight limb with it, of a bent one not, rad.
constexpr double k_arm = 0.294, k_whole_leg = 0.495;  // of the size that distances between head, hands and feet tell
constexpr double k_short_from = 0.08, k_short_to = 0.16, k_usual_share = 0.3, k_short_share = 0.85;
constexpr double k_bent_from = 0.26, k_bent_to = 0.7;

constexpr int k_fewest_without_head = 2;  // limbs with a hand or foot that is seen

constexpr double k_spacing = 0.01;  // of stature, between cuts

struct Surface {
    const TriangleMesh& mesh;
    const CurveSkeleton& skeleton;
    const BodyGraph& graph;

    std::vector<Vec3> curve(int c) const
    {
        std::vector<Vec3> points;
        for (const int node : graph.curve(c))
            points.push_back(skeleton.nodes[node]);
        return points;
    }

    /// Whether a vertex hangs on another curve than `c`.
    IsForeign foreign_to(int c) const
    {
        return [this, c](int vertex) {
            const int node = skeleton.node_of_vertex[vertex];
            return node >= 0 && graph.place_of_node[node].curve != c;
        };
    }

    /// The vertices that hang on the last `reach` of a curve, m along it.
    std::vector<Vec3> last(int c, double reach) const
    {
        const std::vector<Vec3> nodes = curve(c);
        std::size_t first = nodes.size() - 1;
        for (double along = 0; first > 0 && along <= reach; --first)
            along += (nodes[first] - nodes[first - 1]).norm();
        std::vector<Vec3> points;
        for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
            const int node = skeleton.node_of_vertex[v];
            if (node < 0)
                continue;
            const auto& place = graph.place_of_node[node];
            if (place.curve == c && place.row >= int(first))
                points.push_back(mesh.positions.row(v));
        }
        return points;
    }
};

/// The point of `points` where `value` is largest.
Vec3 farthest(const std::vector<Vec3>& points, const std::function<double(const Vec3&)>& value)
{
    return *std::max_element(points.begin(), points.end(),
                             [&](const Vec3& a, const Vec3& b) { return value(a) < value(b); });
}

void require(bool found, const char* what, const Vec3& near)
{
    if (found)
        return;
    const auto number = [](double x) { return std::to_string(x).substr(0, 6); };
    throw InvalidInput(std::string("body: no ") + what + " found near (" + number(near.x()) + ", " + number(near.y())
                       + ", " + number(near.z()) + "); give a human body whose limbs are not fused to it");
}

struct Limb {
    int curve;
    Centreline line;
    Vec3 tip() const { return line.points.back(); }
    const Vec3& ring() const { return line.points[line.first_free]; }  ///< where it leaves the trunk
};

Limb limb(const Surface& surface, const Slicer& slicer, int curve)
{
    const Limb result {
        curve, centreline(slicer, surface.curve(curve), k_spacing * surface.graph.size, surface.foreign_to(curve))
    };
    require(result.line.first_free + 10 < result.line.size(), curve < 2 ? "free arm" : "free leg", result.tip());
    return result;
}

Vec3 square_to(const Vec3& axis, const Vec3& v) { return (v - v.dot(axis) * axis).normalized(); }

double length(const LimbJoints& limb) { return (limb.middle - limb.root).norm() + (limb.end - limb.middle).norm(); }

/// Curves stop short of the surface: goes on to where the limb was cut off, which is taken for its last joint.
Centreline up_to_cut(const Surface& surface, const Limb& limb, double size)
{
    Centreline line = limb.line;
    const Vec3 last = line.at(line.length() - k_stump_cap * size);
    const Vec3 axis = (last - line.at(line.length() - k_stump * size)).normalized();
    const Vec3 cut = farthest(surface.last(limb.curve, k_stump * size), [&](const Vec3& p) { return p.dot(axis); });
    const Vec3 end = last + (cut - last).dot(axis) * axis;
    line.arcs.push_back(line.length() + (end - line.points.back()).norm());
    line.points.push_back(end);
    return line;
}

/// @param up, out  of the trunk: towards the neck, towards this arm's side
LimbJoints arm_joints(const Surface& surface, const Limb& arm, const Vec3& up, const Vec3& out, double size)
{
    Centreline line = arm.line;
    const Vec3 along = (arm.tip() - line.at(0.6 * line.length())).normalized();
    LimbJoints joints;
    joints.tip = farthest(surface.last(arm.curve, 0.12 * size), [&](const Vec3& p) { return p.dot(along); });
    const Narrowest narrow
        = narrowest(line, joints.tip, { 0.05 * size, k_hand * size, 0.19 * size, k_hand_spread * size });
    require(narrow.row >= 0, "wrist", arm.tip());
    joints.widens = narrow.widens;
    joints.whole = has_hand(line, size);
    if (!joints.whole)
        line = up_to_cut(surface, arm, size);
    const int wrist = joints.whole ? narrow.row : line.size() - 1;
    require(wrist > line.first_free + 4, "wrist", arm.tip());
    joints.end = line.points[wrist];
    joints.middle = bend(line, line.first_free, wrist, arm.ring(), k_elbow_ratio, size);
    const Vec3 inwards = (arm.ring() - joints.middle).normalized();
    const double held_out = -inwards.dot(out);
    joints.root = arm.ring()
        + size
            * ((k_shoulder_inwards - k_shoulder_back * held_out) * inwards + k_shoulder_up * up + k_shoulder_out * out);
    return joints;
}

/// The lowest point of the heel and sole about the shin's axis.
Vec3 sole_below(const std::vector<Vec3>& foot, const Vec3& knee, const Vec3& shin_axis, double radius)
{
    std::vector<Vec3> heel;
    for (const Vec3& p : foot)
        if ((p - knee).cross(shin_axis).norm() < radius)
            heel.push_back(p);
    require(!heel.empty(), "heel", foot.front());
    return farthest(heel, [&](const Vec3& p) { return p.dot(shin_axis); });
}

/// From where the shin is narrowest down to a hand's breadth above the sole.
Vec3 ankle(const std::vector<Vec3>& foot, const Vec3& knee, const Vec3& narrow, double size)
{
    const Vec3 shin_axis = (narrow - knee).normalized();
    const Vec3 sole = sole_below(foot, knee, shin_axis, 0.05 * size);
    const double above_sole = (sole - narrow).dot(shin_axis) - k_ankle_height * size;
    return narrow
        + std::min(above_sole, k_ankle_below_shin * size) * shin_axis;  // of a pointed foot, the toes are the sole
}

/// Where the thigh comes from, read off its first hand's breadth.
Vec3 towards_hip(const Limb& leg, double size)
{
    return (leg.ring() - leg.line.at(leg.line.arcs[leg.line.first_free] + 0.12 * size)).normalized();
}

/// Hips are a pair: flesh shows the middle between them and how the pelvis lies, hardly their width.
std::array<Vec3, 2> hips(const std::array<Limb, 2>& legs, const Vec3& up, double size)
{
    const Vec3 along[] { towards_hip(legs[0], size), towards_hip(legs[1], size) };
    const Vec3 middle = 0.5 * (legs[0].ring() + legs[1].ring())
        + size * (0.5 * k_hips_along_thighs * (along[0] + along[1]) - k_hips_below_rings * up);
    const Vec3 across
        = (legs[0].ring() - legs[1].ring() + 0.5 * k_hips_along_thighs * size * (along[0] - along[1])).normalized();
    return { middle + 0.5 * k_hip_width * size * across, middle - 0.5 * k_hip_width * size * across };
}

LimbJoints leg_joints(const Surface& surface, const Limb& leg, const Vec3& hip, double size)
{
    Centreline line = leg.line;
    const std::vector<Vec3> foot = surface.last(leg.curve, 0.25 * size);
    const Narrowest narrow = narrowest(line, leg.tip(), { 0.08 * size, 0.15 * size, 0.22 * size, 0.04 * size });
    LimbJoints joints;
    joints.widens = narrow.widens;
    joints.whole = has_foot(line, size);
    if (!joints.whole)
        line = up_to_cut(surface, leg, size);
    const int shin = joints.whole ? narrow.row : line.size() - 1;
    require(shin > line.first_free + 4, "ankle", leg.tip());
    joints.root = hip;
    joints.middle
        = bend(line, line.first_free, shin, joints.root, joints.whole ? k_knee_above_shin : k_knee_ratio, size);
    joints.end = joints.whole ? ankle(foot, joints.middle, line.points[shin], size) : line.points[shin];
    joints.tip = farthest(foot, [&](const Vec3& p) { return (p - joints.end).dot(leg.tip() - joints.end); });
    return joints;
}

/// The one length that both upper bones should have: half of what was measured, half of what the lower bones lead to expect.
double upper_length(const std::array<LimbJoints, 2>& limbs, double upper_ratio)
{
    double measured = 0, expected = 0;
    for (const LimbJoints& limb : limbs) {
        measured += 0.5 * (limb.root - limb.middle).norm();
        expected += 0.5 * (limb.end - limb.middle).norm() * upper_ratio / (1 - upper_ratio);
    }
    return 0.5 * (measured + expected);
}

/// Both upper bones come out equally long.
void level(std::array<LimbJoints, 2>& limbs, double upper_ratio)
{
    const double upper = upper_length(limbs, upper_ratio);
    for (LimbJoints& limb : limbs)
        limb.root = limb.middle + upper * (limb.root - limb.middle).normalized();
}

/// Hips move together, or the pelvis would change its width.
void keep_apart(std::array<LimbJoints, 2>& legs, const std::array<Vec3, 2>& hips)
{
    const Vec3 shift = 0.5 * (legs[0].root - hips[0] + legs[1].root - hips[1]);
    for (int i = 0; i < 2; ++i)
        legs[i].root = hips[i] + shift;
}

double bent(const LimbJoints& limb)
{
    const double cosine = (limb.middle - limb.root).normalized().dot((limb.end - limb.middle).normalized());
    return std::clamp((std::acos(std::clamp(cosine, -1.0, 1.0)) - k_bent_from) / (k_bent_to - k_bent_from), 0.0, 1.0);
}

/// Moves roots, and middles of straight limbs, so that the pair comes nearer to its usual length.
void bring_to_length(std::array<LimbJoints, 2>& limbs, double usual)
{
    const double measured = 0.5 * (length(limbs[0]) + length(limbs[1]));
    const double missing = std::log(usual / measured);
    const double short_by = std::clamp((missing - k_short_from) / (k_short_to - k_short_from), 0.0, 1.0);
    const double factor = std::exp(missing * (k_usual_share + short_by * (k_short_share - k_usual_share)));
    for (LimbJoints& limb : limbs) {
        const double goal = length(limb) + (factor - 1) * measured;
        const Vec3 upper = (limb.root - limb.middle).normalized();
        limb.middle += (factor - 1) * (1 - bent(limb)) * (limb.middle - limb.end);
        limb.root = limb.middle + (goal - (limb.end - limb.middle).norm()) * upper;
    }
}

bool whole(const std::array<LimbJoints, 2>& limbs) { return limbs[0].whole && limbs[1].whole; }

/// From the pelvis through the middle of the trunk to the top of the head's curve. Where the arms leave, cuts say nothing.
Centreline spine(const Surface& surface, const Slicer& slicer, const Vec3& pelvis, const Vec3& up)
{
    const auto is_limb = [&](int vertex) {
        const int node = surface.skeleton.node_of_vertex[vertex];
        return node >= 0 && surface.graph.place_of_node[node].curve < 4;
    };
    std::vector<Vec3> curve = surface.curve(5);
    const std::vector<Vec3> head = surface.curve(4);
    curve.insert(curve.end(), head.begin() + 1, head.end());
    const Centreline cuts = centreline(slicer, curve, k_spacing * surface.graph.size, is_limb);
    std::vector<Vec3> middles { pelvis };
    for (int i = 0; i < cuts.size(); ++i)
        if (cuts.free[i] && cuts.across[i] && (cuts.points[i] - pelvis).dot(up) > 2 * k_spacing * surface.graph.size)
            middles.push_back(cuts.points[i]);
    return polyline(middles, 0.5 * k_spacing * surface.graph.size);
}

Centreline extended(const Centreline& line, const Vec3& to)
{
    std::vector<Vec3> points = line.points;
    points.push_back(to);
    return polyline(points, line.length() / line.size());
}

/// The highest point of a line that is `distance` away from its end beyond, m.
Vec3 below(const Centreline& line, const Vec3& end, double distance)
{
    int i = line.size() - 1;
    while (i > 0 && (line.points[i] - end).norm() < distance)
        --i;
    return line.points[i];
}

/// Of the points of a line between two distances from its end, m.
Vec3 middle(const Centreline& line, double from, double to)
{
    Vec3 sum = Vec3::Zero();
    const int steps = 10;
    for (int i = 0; i < steps; ++i)
        sum += line.at(line.length() - from + (from - to) * (i + 0.5) / steps) / steps;
    return sum;
}

/// Without a head, clothes that were closed look like a body too; but sleeves and legs of clothes end narrow.
void require_hands_or_feet(const BodyJoints& joints)
{
    int found = 0;
    for (const LimbJoints& limb : { joints.arms[0], joints.arms[1], joints.legs[0], joints.legs[1] })
        found += limb.widens;
    if (found < k_fewest_without_head)
        throw InvalidInput("body: no head found, and " + std::to_string(found)
                           + " of 4 limbs widen to a hand or foot (at least " + std::to_string(k_fewest_without_head)
                           + "), as in clothes with nobody in them; give a human body");
}

}  // namespace

BodyJoints label_joints(const TriangleMesh& proxy, const CurveSkeleton& skeleton, const BodyGraph& graph)
{
    const Surface surface { proxy, skeleton, graph };
    const Slicer slicer(proxy);
    const std::array<Limb, 2> arms { limb(surface, slicer, 0), limb(surface, slicer, 1) };
    const std::array<Limb, 2> legs { limb(surface, slicer, 2), limb(surface, slicer, 3) };
    const Vec3 up = (skeleton.nodes[graph.trunk.back()] - skeleton.nodes[graph.trunk.front()]).normalized();

    BodyJoints joints;
    joints.size = graph.size;
    joints.crown = farthest(graph.headless ? surface.last(5, 0.12 * graph.size) : surface.last(4, 0.12 * graph.size),
                            [&](const Vec3& p) { return p.dot(up); });
    Centreline axis;
    for (int round = 0; round < 2; ++round) {  // curves cut corners: bent legs make the first size too small
        const std::array<Vec3, 2> roots = hips(legs, up, joints.size);
        for (int i = 0; i < 2; ++i)
            joints.legs[i] = leg_joints(surface, legs[i], roots[i], joints.size);
        level(joints.legs, k_knee_ratio);
        if (whole(joints.legs) && !graph.headless)
            bring_to_length(joints.legs, k_whole_leg * std::min(graph.size, graph.size_by_legs));
        keep_apart(joints.legs, roots);
        joints.pelvis = 0.5 * (joints.legs[0].root + joints.legs[1].root);
        axis = spine(surface, slicer, joints.pelvis, up);
        if (graph.headless)  // the curve ends where the arms leave
            axis = extended(axis, joints.crown);
        const double leg = 0.5 * (length(joints.legs[0]) + length(joints.legs[1]));
        joints.size = 0.5 * (leg / k_leg + graph.size);
    }
    const Vec3 across = square_to(up, arms[0].ring() - arms[1].ring());
    for (int i = 0; i < 2; ++i)
        joints.arms[i] = arm_joints(surface, arms[i], up, i == 0 ? across : Vec3(-across), joints.size);
    if (graph.headless)
        require_hands_or_feet(joints);
    level(joints.arms, k_elbow_ratio);
    if (whole(joints.arms) && whole(joints.legs) && !graph.headless)
        bring_to_length(joints.arms, k_arm * graph.size);

    const double head = graph.headless ? k_stub : 1;
    joints.neck_base = below(axis, joints.crown, head * k_neck_base * joints.size);
    joints.skull_base
        = joints.crown + head * k_skull_base * joints.size * (joints.neck_base - joints.crown).normalized();
    if (!graph.headless)
        joints.head_off_neck
            = middle(axis, k_head * joints.size, 0) - middle(axis, k_neck * joints.size, k_jaw * joints.size);
    joints.mid_neck = 0.5 * (joints.neck_base + joints.skull_base);
    const double neck = axis.arcs[axis.nearest_row(joints.neck_base)];
    joints.lower_spine = axis.at(neck / 3);
    joints.upper_spine = axis.at(neck * 2 / 3);
    return joints;
}

}  // namespace garmentfit
