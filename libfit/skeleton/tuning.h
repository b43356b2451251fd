// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Fitted numbers of skin weights and joint limits.
//
// Units  lengths are shares of a length of the same body, so these numbers are dimensionless; angles are in radians.
// Data   "bodies": ten MakeHuman bodies with known joints and known skin weights (docs/rig.md, Accuracy).
//        "pairs": the twelve pairs of body and garment of the house data.
// A number "fitted: guess" was tried by hand on these data. No score was recorded and no script fits it again.

#include <cstddef>
#include <numbers>

namespace garmentfit::skeleton_tuning {

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// ---- heat weights (heat_weights.cpp) ----------------------------------------------------------------------------

/// fitted: on the bodies, by the difference of their skin weights from MakeHuman's in nine segments. The constant c of
/// [baran_2007_pinocchio], where it is 1. A larger value makes the skin stiffer between joints.
inline constexpr double k_heat = 18;
/// fitted: as k_heat. For arms: with k_heat their weights reach far down the flank, which the spine should hold.
inline constexpr double k_heat_of_arms = 1.5;
/// fitted: guess, on the bodies. Smallest cosine between skin normal and direction from the bone. It limits the ball of
/// a bone that does not lie behind the skin, so that such a bone counts as up to ten times farther away, but remains
/// possible.
inline constexpr double k_least_facing = 0.1;

// ---- transfer of weights (skin_transfer.cpp) ----------------------------------------------------------------------

/// fitted: guess, on the bodies. Share of the diagonal of the bounding box. Points with opposite normals seem farther
/// apart by twice this length.
inline constexpr double k_normal_weight = 0.015;
/// fitted: guess. Number of points from which a weight is interpolated.
inline constexpr int k_neighbours = 4;

// ---- weights of clothes (garment_weights.cpp) ---------------------------------------------------------------------

/// fitted: guess. Share of the vertices of a piece of cloth whose normals are opposite to those of the skin next to
/// them: above it, the piece has two sheets.
inline constexpr double k_second_sheet = 0.25;
/// fitted: guess. Share of the diagonal of the body: skin this near shows which side of cloth is inside. Loose cloth may
/// be near other limbs only, which it faces with its outside.
inline constexpr double k_side_reach = 0.05;
/// fitted: on P02, P04, P06, P08, P10 and P12; the choice between 0.3 and 0.4 saw the other six, too (docs/outfits.md).
/// Dimensionless: weights of skin are smoothed over this share of its distance from the cloth.
inline constexpr double k_smoothing_of_distance = 0.4;
/// fitted: as above. Shares of the diagonal of the body: skin nearer than this is as good as touched; and the length
/// below which weights are smooth where nothing draws them (skin_inpainting.h).
inline constexpr double k_close_skin = 0.001, k_stiff_length = 0.015;
/// fitted: guess. A joint with less weight moves cloth by less than contact keeps it off the skin.
inline constexpr double k_least_weight = 1e-3;

// ---- covered skin (covered_skin.cpp) ------------------------------------------------------------------------------

/// fitted: on P10, the fewest without a hole (docs/decisions/0040). Drawings of a pose, each looked at from both sides:
/// about 14 degrees between neighbours.
inline constexpr int k_pictures_of_a_pose = 100;
/// fitted: as above. Drawings around one that shows skin that is new, and how often their distance is halved.
inline constexpr int k_pictures_around = 6, k_levels_of_sight = 3;
/// fitted: guess. Mean edges of the body: skin nearer than this, or than the margin, to skin that is seen is not new.
inline constexpr double k_edges_to_news = 1.5;
/// fitted: as above. Share of the diagonal of the body: the side of a pixel, 6 mm of an adult.
inline constexpr double k_pixel_of_sight = 0.003;
/// fitted: guess. Share of the diagonal of the body. Skinning pushes skin this far through the cloth over it.
inline constexpr double k_most_bulge = 0.01;
/// fitted: guess. Share of the diagonal of the body: 2 cm of an adult.
inline constexpr double k_margin_of_sight = 0.01;

// ---- skin under clothes (inset_skin.cpp) --------------------------------------------------------------------------

/// fitted: guess. Pictures that show how much of the skin is hidden, and the share from which on skin is drawn in.
inline constexpr int k_pictures_of_inset = 100;
inline constexpr double k_hidden_to_inset = 0.8;
/// fitted: guess. Shares of the diagonal of the body: how far the skin goes in, 6 cm of an adult; how far from bare skin
/// it begins to, 1 cm.
inline constexpr double k_inset = 0.03, k_inset_margin = 0.005;
/// fitted: guess. Depth over the distance from there on; largest depth as a share of the limb's thickness: both sides of
/// a wrist leave a fifth.
inline constexpr double k_inset_slope = 0.5, k_inset_share = 0.4;
/// fitted: guess.
inline constexpr int k_inset_smoothing_passes = 5;

// ---- skin of hands and feet (extremity_skin.h) --------------------------------------------------------------------

/// fitted: guess, on the bodies with hands or feet removed. Share of the bone before: a shorter extremity is a stump.
inline constexpr double k_shortest_extremity = 0.15;
/// fitted: guess, on the pairs. Share of the bone before: half width of the transition at wrist or ankle.
inline constexpr double k_extremity_blend = 0.12;

// ---- bone radii (skeleton.cpp) ------------------------------------------------------------------------------------

/// fitted: guess, on the pairs. One in this many distances is smaller than the radius: the lower quartile.
inline constexpr int k_radius_quantile = 4;

// ---- joint limits (joint_limits.cpp) ------------------------------------------------------------------------------

/// fitted: guess, on the pairs. rad from the vertical: a spine bent further counts as straightened to this angle.
inline constexpr double k_straight_spine = radians(15.0);
/// fitted: guess, on the pairs. rad: the same of the neck, from its line in a standing body.
inline constexpr double k_straight_neck = radians(25.0);
/// fitted: guess, on the pairs. rad from sideways: the same of the clavicle. Raised arms lift it further in the rest
/// pose.
inline constexpr double k_level_clavicle = radians(25.0);
/// fitted: guess, on the bodies. rad: a knee or elbow bent further shows in which direction it bends.
inline constexpr double k_bent_limb = radians(15.0);
/// fitted: guess. Tangent of the angle between a leg of the standing body and the vertical, outwards.
inline constexpr double k_leg_spread = 0.08;
/// fitted: guess. Tangent of the angle between the neck of the standing body and the vertical, forwards.
inline constexpr double k_neck_lean = 0.2;
/// fitted: guess. Cosine: an upper arm closer to the front axis takes the trunk's vertical for the direction of elbow
/// flexion.
inline constexpr double k_arm_to_front = 0.9;

/// Range of a joint, rad: bending, and across, away from the middle of the body.
struct Angles {
    double bend_min, bend_max, across_min, across_max;
};
/// fitted: guesses, on the pairs, after the ranges of healthy adults in [aaos_1994_joint_motion], but wider where one
/// bone stands for several joints. The forearm's range across stands for the twist of the upper arm.
inline constexpr Angles k_hip_joint_range { radians(-5.0), radians(5.0), radians(-5.0), radians(5.0) },
    k_thigh_range { radians(-25.0), radians(115.0), radians(-8.0), radians(50.0) },
    k_shin_range { radians(-5.0), radians(140.0), radians(-10.0), radians(10.0) },
    k_neck_range { radians(-30.0), radians(35.0), radians(-25.0), radians(25.0) },
    k_clavicle_range { radians(-15.0), radians(15.0), radians(-10.0), radians(20.0) },
    k_upper_arm_range { radians(-40.0), radians(100.0), radians(-45.0), radians(110.0) },
    k_forearm_range { radians(-8.0), radians(145.0), radians(-45.0), radians(45.0) },
    k_spine_range { radians(-15.0), radians(20.0), radians(-15.0), radians(15.0) };

// ---- names of joints (joint_names.cpp) ------------------------------------------------------------------------------

/// Dimensionless, a share of the names, and a number of names: what so many of them hold says nothing about a joint.
/// fitted: guess; in the skeletons of Mixamo and of Unreal no word for a part of the body is in more than half of them.
inline constexpr double k_common_share = 0.75;
inline constexpr std::size_t k_fewest_common_names = 6;

// ---- joints without names (joints_by_tree.cpp) ----------------------------------------------------------------------

/// What a measure usually is, and how far it may be from that.
struct Usual {
    double mean, deviation;
};
/// Dimensionless, by the length of the limb from its first to its last joint: the logarithm of its lower bone by its
/// upper one, its first joint from the joint that both limbs hang on, and what is beyond its last joint (hand, foot; 0
/// where these have no joints). fitted: guess, by the looks of usual skeletons; tried on one of Ready Player Me and one
/// of VRoid.
struct UsualLimb {
    Usual log_ratio, from_trunk, beyond;
};
inline constexpr UsualLimb k_usual_arm { { -0.05, 0.2 }, { 0.35, 0.15 }, { 0.25, 0.2 } };
inline constexpr UsualLimb k_usual_leg { { -0.05, 0.15 }, { 0.14, 0.1 }, { 0.2, 0.15 } };
/// Angle between shin and foot, and between thigh and trunk. fitted: guess.
inline constexpr Usual k_usual_ankle { radians(65), radians(35) }, k_usual_hip { 0, radians(60) };
/// Dimensionless: the logarithm of arms by legs; the trunk by a leg. fitted: guess, as above.
inline constexpr Usual k_usual_arm_by_leg { -0.45, 0.3 }, k_usual_trunk_by_leg { 0.55, 0.25 };
/// Dimensionless, in squares of deviations: a joint with three branches is a wrist; a root that is not the pelvis.
/// fitted: guess.
inline constexpr double k_fingers_gain = 3, k_other_root_cost = 4;
/// Dimensionless, by the length of the arm: no finger is shorter. fitted: guess.
inline constexpr double k_least_finger = 0.08;
/// Share of a limb's length: joints no further apart are at one place. unit: rounding of files.
inline constexpr double k_one_place = 1e-3;
/// Dimensionless. Lengths of two limbs of a pair differ by no more. Each has so much of the skin. The head has so much
/// of the skin of head and neck. fitted: guess.
inline constexpr double k_alike = 0.1, k_least_limb_mass = 0.005, k_least_head_mass = 0.5;
/// Dimensionless, by the length of a leg: where the middle of the foot's skin lies before the ankle. Less tells
/// nothing. fitted: guess; a human's is 0.08.
inline constexpr double k_least_foot = 0.01;
/// In squares of deviations: costs of a human among others. fitted: guess; skeletons of humans cost 2 to 20.
inline constexpr double k_likely_human = 60;
/// Numbers that bound the search, more than skeletons have. unit.
inline constexpr std::size_t k_most_joints_of_limb = 14, k_most_pairs = 32;

}  // namespace garmentfit::skeleton_tuning
