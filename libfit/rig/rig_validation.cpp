// SPDX-License-Identifier: GPL-3.0-or-later
#include "rig_validation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "garmentfit/error.h"
#include "garmentfit/number_text.h"
#include "garmentfit/rig_body.h"
#include "nearest.h"
#include "surface_measures.h"
#include "tuning.h"
#include "winding_number.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

constexpr int k_samples = 5;  // unit: of each bone, ends included

/// Of samples on the bones.
double share_inside(const TriangleMesh& closed, const Skeleton& skeleton)
{
    int inside = 0;
    for (int b = 0; b < bone_count; ++b)
        for (int k = 0; k < k_samples; ++k) {
            const double t = double(k) / (k_samples - 1);
            inside += winding_number(closed, (1 - t) * skeleton.head(b) + t * skeleton.tail(b))
                > 0.5;  // derived: 1 inside, 0 outside
        }
    return double(inside) / (bone_count * k_samples);
}

void check_inside(const TriangleMesh& closed, const Skeleton& skeleton)
{
    const double share = share_inside(closed, skeleton);
    if (share < k_inside_share)
        throw InvalidInput(ErrorCode::not_human,
                           "body: only " + fixed_text(share, 2) + " of the skeleton lies inside it (at least "
                               + fixed_text(k_inside_share, 2)
                               + "); give a human body whose limbs do not merge, or give joints");
}

/// A bone on both sides.
struct BonePair {
    int left_bone;
    double left, right;  ///< m

    bool is_unequal() const { return std::abs(left - right) > k_side_tolerance * std::max(left, right); }
    std::string left_name() const { return std::string(bone_name(left_bone)); }
    std::string right_name() const { return std::string(bone_name(mirror_of(left_bone))); }
    std::string text() const
    {
        return left_name() + " is " + fixed_text(left, 2) + " m long and " + right_name() + " " + fixed_text(right, 2)
            + " m";
    }
};

std::vector<BonePair> limb_bones(const Skeleton& skeleton)
{
    std::vector<BonePair> pairs;
    for (const int left : { lfemur, ltibia, lhumerus, lradius })
        pairs.push_back({ left, skeleton.length(left), skeleton.length(mirror_of(left)) });
    return pairs;
}

void check_sides(const Skeleton& skeleton)
{
    for (const BonePair& pair : limb_bones(skeleton))
        if (pair.is_unequal())
            throw InvalidInput(ErrorCode::not_human,
                               "body: " + pair.text()
                                   + "; give a whole human body whose limbs do not merge, or give joints");
}

/// A ratio of lengths, and the interval in which a human's lies.
struct NamedRatio {
    const char* what;
    double value;
    Proportion human;

    /// How far outside, as a logarithm; 0 inside.
    double excess() const
    {
        return std::isfinite(value) && value > 0
            ? std::max({ 0.0, std::log(human.least / value), std::log(value / human.most) })
            : std::numeric_limits<double>::infinity();
    }
    std::string text() const
    {
        return std::string("the ratio ") + what + " is " + fixed_text(value, 2) + ", a human has "
            + fixed_text(human.least, 2) + " to " + fixed_text(human.most, 2);
    }
};

std::array<NamedRatio, 7> ratios_of(const Skeleton& s)
{
    const double arm = s.length(lhumerus) + s.length(lradius), leg = s.length(lfemur) + s.length(ltibia);
    const double trunk = (s.tail(thorax) - s.root).norm();
    const double hip_width = (s.tail(lhipjoint) - s.tail(rhipjoint)).norm();
    const double shoulder_width = (s.tail(lclavicle) - s.tail(rclavicle)).norm();
    const double collarbone = std::max(s.length(lclavicle), s.length(rclavicle));
    return { { { "upper arm to forearm", s.length(lhumerus) / s.length(lradius), k_upper_arm_to_forearm },
               { "thigh to shin", s.length(lfemur) / s.length(ltibia), k_thigh_to_shin },
               { "arm to leg", arm / leg, k_arm_to_leg },
               { "trunk to leg", trunk / leg, k_trunk_to_leg },
               { "hip width to leg", hip_width / leg, k_hip_width_to_leg },
               { "shoulder width to leg", shoulder_width / leg, k_shoulder_width_to_leg },
               { "collarbone to leg", collarbone / leg, k_collarbone_to_leg } } };
}

/// The direction in which a foot points; the front is carried along the leg without twist.
Vec3 before_shin(const Skeleton& s, bool is_right)
{
    const Vec3 up = s.tail(thorax) - s.root, front = (s.tail(lhipjoint) - s.tail(rhipjoint)).cross(up).normalized();
    const int thigh = is_right ? rfemur : lfemur, shin = is_right ? rtibia : ltibia;
    const Vec3 along_thigh = s.tail(thigh) - s.head(thigh), along_shin = s.tail(shin) - s.head(shin);
    const Vec3 before_thigh = Eigen::Quaterniond::FromTwoVectors(-up, along_thigh) * front;
    return Eigen::Quaterniond::FromTwoVectors(along_thigh, along_shin) * before_thigh;
}

/// How far the tip of a foot lies before its shin, as a share of the shin's length.
double foot_forwards(const Skeleton& s, bool is_right)
{
    const int shin = is_right ? rtibia : ltibia;
    const Vec3 along_shin = s.tail(shin) - s.head(shin);
    return (s.tips[is_right ? rfoot_tip : lfoot_tip] - s.tail(shin)).dot(before_shin(s, is_right)) / along_shin.norm();
}

/// How far each foot points backwards, as foot_forwards(); negative where it points forwards.
struct FeetBackwards {
    double left, right;

    bool is_one() const { return std::max(left, right) > k_most_foot_backwards; }
    bool are_both() const { return std::min(left, right) > k_most_foot_backwards; }
};

FeetBackwards feet_backwards(const Skeleton& s) { return { -foot_forwards(s, false), -foot_forwards(s, true) }; }

constexpr const char* k_foot_backwards_text = "a foot points backwards";

void check_proportions(const Skeleton& skeleton)
{
    for (const NamedRatio& ratio : ratios_of(skeleton))
        if (!(ratio.value >= ratio.human.least && ratio.value <= ratio.human.most))  // not a number fails too
            throw InvalidInput(ErrorCode::not_human,
                               "body: " + ratio.text()
                                   + "; give a human body whose limbs do not merge, or give joints");
}

// Of the body's height: a joint of a skeleton by hand may lie just outside of the skin.
double distance_from_body(const BodyMesh& body, const TriangleTree& skin, const Vec3& joint, double height)
{
    return winding_number(body.closed, joint) > 0.5 ? 0 : skin.distance(joint) / height;
}

/// Files have one to five joints here; those of Skeleton are placed on the straight line between the ends, which a bent
/// trunk may leave.
bool is_placed_evenly(int bone) { return bone == lowerback || bone == upperback || bone == lowerneck; }

/// A pelvis lies at the lower end of the spine. That of a wrong map lies in the chest or on the floor.
bool is_pelvis_far(const Skeleton& skeleton)
{
    const Vec3 between_hips = 0.5 * (skeleton.tail(lhipjoint) + skeleton.tail(rhipjoint));
    return !((skeleton.root - between_hips).norm() < k_farthest_pelvis * (skeleton.tail(thorax) - between_hips).norm());
}

/// How far the skin of a forearm goes on beyond the wrist, along the forearm.
double hand_length(const BodyMesh& body, const Skeleton& skeleton, const SkinWeights& weights, int forearm)
{
    const Vec3 wrist = skeleton.tail(forearm), along = skeleton.direction(forearm);
    double length = 0;
    for (Eigen::Index v = 0; v < weights.weights.rows(); ++v)
        for (int k = 0; k < 4; ++k)
            if (weights.bones(v, k) == forearm && weights.weights(v, k) > 0.5)
                length = std::max(length, (Vec3(body.surface.positions.row(v)) - wrist).dot(along));
    return length;
}

/// Joints that are named one too early: the elbow is called a wrist, and all that follows a hand. What a hand holds is
/// longer than an arm, too, but the bones of that arm have usual lengths.
bool is_arm_too_early(const BodyMesh& body, const Skeleton& skeleton, const SkinWeights& weights, bool is_right)
{
    const int upper = is_right ? rhumerus : lhumerus, lower = is_right ? rradius : lradius;
    const double ratio = skeleton.length(upper) / skeleton.length(lower);
    return !(ratio >= k_upper_arm_to_forearm.least && ratio <= k_upper_arm_to_forearm.most)
        && hand_length(body, skeleton, weights, lower) > skeleton.length(upper) + skeleton.length(lower);
}

/// Whether the skin of a foot reaches much further behind the middle of its shin than before it. Files often have no
/// joint for the toes, and the ankle may lie anywhere in the foot.
bool is_foot_skin_backwards(const BodyMesh& body, const Skeleton& skeleton, const SkinWeights& weights, bool is_right)
{
    const int shin = is_right ? rtibia : ltibia;
    const double length = skeleton.length(shin);
    const Vec3 along = skeleton.direction(shin), forwards = before_shin(skeleton, is_right);
    double before = -std::numeric_limits<double>::infinity(), behind = before, sum = 0;
    int count = 0;
    for (Eigen::Index v = 0; v < weights.weights.rows(); ++v)
        for (int k = 0; k < 4; ++k)
            if (weights.bones(v, k) == shin && weights.weights(v, k) > 0.5) {
                const Vec3 way = Vec3(body.surface.positions.row(v)) - skeleton.tail(shin);
                const double depth = way.dot(along) / length, ahead = way.dot(forwards) / length;
                if (depth > -k_beyond_shin) {
                    before = std::max(before, ahead);
                    behind = std::max(behind, -ahead);
                } else if (depth < -k_within_shin) {
                    sum += ahead;
                    ++count;
                }
            }
    const double middle = count > 0 ? sum / count : 0;
    return count > 0 && behind + middle > k_foot_behind && behind + middle > k_behind_to_before * (before - middle);
}

/// Isoperimetric quotient: 1 for a ball.
double compactness(const TriangleMesh& closed)
{
    return 36 * std::numbers::pi * std::pow(volume(closed), 2) / std::pow(area(closed), 3);
}

/// @throws InvalidInput
[[noreturn]] void refuse_compact(double quotient)
{
    throw InvalidInput(ErrorCode::not_human,
                       "body: it is too compact for a human, with an isoperimetric quotient of "
                           + fixed_text(quotient, 2) + " (a human's is at most " + fixed_text(k_most_compact, 2)
                           + "); give a human body");
}

}  // namespace

void check_skeleton(const BodyMesh& body, const Skeleton& skeleton, const SkinWeights& weights)
{
    const auto refuse = [](const std::string& what) {
        throw InvalidInput(ErrorCode::rig_mismatch, what + "; give the skeleton of this body in its bind pose");
    };
    const Positions& skin = body.surface.positions;
    const double height = (skin.colwise().maxCoeff() - skin.colwise().minCoeff()).maxCoeff();
    const TriangleTree tree(body.surface);
    for (const BonePair& pair : limb_bones(skeleton)) {
        if (!(std::min(pair.left, pair.right) > k_shortest_own_bone * height))
            refuse(pair.left_name() + " or " + pair.right_name() + " has hardly any length");
        if (pair.is_unequal())
            refuse(pair.text());
    }
    const auto from_right_to_left = [&](Bone left) { return skeleton.tail(left) - skeleton.tail(mirror_of(left)); };
    const bool have_shoulders_width = from_right_to_left(lclavicle).norm() > k_shortest_own_bone * height;
    if (!(from_right_to_left(lhipjoint).dot(from_right_to_left(have_shoulders_width ? lclavicle : lhumerus)) > 0))
        refuse("the left hip and the left arm lie on different sides");
    if (weights.weights.rows() == skin.rows() && is_arm_too_early(body, skeleton, weights, false)
        && is_arm_too_early(body, skeleton, weights, true))
        refuse("the hands are longer than the arms, so the elbows seem to be taken for wrists");
    if (is_pelvis_far(skeleton))
        refuse("the pelvis does not lie at the hips");
    const bool is_skin_backwards = weights.weights.rows() == skin.rows()
        && is_foot_skin_backwards(body, skeleton, weights, false)
        && is_foot_skin_backwards(body, skeleton, weights, true);
    if (const FeetBackwards feet = feet_backwards(skeleton); feet.is_one() || is_skin_backwards)
        refuse(feet.are_both() || is_skin_backwards ? "the feet point backwards, so left and right seem to be exchanged"
                                                    : k_foot_backwards_text);
    for (int bone = 0; bone < bone_count; ++bone)
        if (const double off = distance_from_body(body, tree, skeleton.tail(bone), height);
            !(off < (is_placed_evenly(bone) ? k_farthest_placed_joint : k_farthest_own_joint)))
            refuse("the end of " + std::string(bone_name(bone)) + " lies " + fixed_text(off * height, 2)
                   + " m outside of the body");
}

void check_shape(const TriangleMesh& closed, Humanlike humanlike)
{
    const double quotient = compactness(closed);
    if (quotient > (humanlike == Humanlike::strict ? k_most_compact : k_most_compact_figure))
        refuse_compact(quotient);
}

void check_figure(const TriangleMesh& closed, const Rig& rig)
{
    if (rig.human_probability >= k_least_like_compact)
        return;
    if (const double quotient = compactness(closed); quotient > k_most_compact)
        refuse_compact(quotient);
}

HumanLikeness human_likeness(const TriangleMesh& closed, const Skeleton& skeleton)
{
    double squares = 0, most = 0;
    std::string worst;
    const auto count = [&](double deviation, const std::string& what) {
        squares += deviation * deviation;
        if (deviation > most) {
            most = deviation;
            worst = what;
        }
    };
    for (const NamedRatio& ratio : ratios_of(skeleton))
        count(ratio.excess() / k_ratio_excess, ratio.text());
    for (const BonePair& pair : limb_bones(skeleton)) {
        const double difference = std::abs(pair.left - pair.right) / std::max(pair.left, pair.right);
        count(std::max(0.0, difference - k_side_tolerance) / k_sides_excess, pair.text());
    }
    const FeetBackwards feet = feet_backwards(skeleton);
    count(std::max(0.0, std::max(feet.left, feet.right) - k_most_foot_backwards) / k_feet_excess,
          k_foot_backwards_text);
    const double inside = share_inside(closed, skeleton);
    count(std::max(0.0, k_inside_share - inside) / k_outside_excess,
          "only " + fixed_text(inside, 2) + " of the skeleton lies inside it");
    if (!std::isfinite(squares) || inside < k_figure_inside_share)
        throw InvalidInput(ErrorCode::not_human,
                           "body: " + worst + "; give one figure whose limbs do not merge, or give joints");
    return { squares, worst };
}

void check_feet(const Skeleton& skeleton)
{
    if (feet_backwards(skeleton).is_one())
        throw InvalidInput(ErrorCode::not_human,
                           std::string("body: ") + k_foot_backwards_text
                               + "; give a whole human body whose limbs do not merge, or give joints");
}

void check_rig(const TriangleMesh& closed, const Skeleton& skeleton)
{
    check_proportions(skeleton);
    check_sides(skeleton);
    check_inside(closed, skeleton);
}

}  // namespace garmentfit
