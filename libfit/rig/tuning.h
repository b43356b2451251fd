// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Fitted numbers of rigging.
//
// Units  lengths are shares of stature unless a comment says otherwise, so these numbers are dimensionless; angles are
//        in radians. Nothing here is in metres.
// Data   "bodies": MakeHuman bodies with known joints, ten in set poses and 160 of other shapes and poses (docs/rig.md,
//        Accuracy). "dirty bodies": the same with 165 kinds of damage. Score: mean distance of the twelve limb joints
//        from MakeHuman's, as a share of stature; for the rejection limits the number of bodies judged correctly.
// A number "fitted: guess" was tried by hand on these data, without a record of the score. No script fits them again.

#include <array>
#include <cstddef>
#include <numbers>

namespace garmentfit::rig_tuning {

// ---- loops of the curve skeleton (curve_loops.cpp) ----------------------------------------------------------------

/// fitted: guess, on the dirty bodies. Share of the diagonal of the curves' bounding box. A shorter loop is two fingers
/// that touch, a longer one an arm that touches the trunk.
inline constexpr double k_short_loop = 0.15;

// ---- names of the ends (body_graph.cpp) ---------------------------------------------------------------------------

/// fitted: on the dirty bodies. Standard deviation of the logarithms of length ratios. Real bodies have about 0.1, most
/// of all children with large heads; other shapes have far more.
inline constexpr double k_largest_spread = 0.30;
/// fitted: on the bodies without heads. The same where the head is missing: fewer lengths must agree better.
inline constexpr double k_largest_headless_spread = 0.15;
/// fitted: guess, on the dirty bodies. Length ratio: a limb is at least this much longer than the longest finger, ear
/// or toe.
inline constexpr double k_limb_over_finger = 1.25;
/// fitted: guess, on the bodies without heads. The same for a body without head, where a neck or a finger was pruned.
inline constexpr double k_limb_over_stump = 2.5;

// ---- centre lines (centreline.cpp) --------------------------------------------------------------------------------

/// fitted: guess. Number of cuts on each side from which a tangent is computed.
inline constexpr int k_half_window = 3;
/// fitted: guess. Number of times that the line is moved to the centroids of its cuts.
inline constexpr int k_centring_rounds = 2;
/// fitted: guess, on the bodies. Isoperimetric quotient of an outline, 1 = circle. A plane that runs along a bent limb
/// cuts a long outline, with a smaller quotient.
inline constexpr double k_roundness = 0.6;
/// fitted: guess. Number of consecutive free cuts with which a limb begins.
inline constexpr int k_free_in_a_row = 4;
/// fitted: guess. Share of an outline that may belong to another part: labels of vertices are ragged where curves meet.
inline constexpr double k_foreign_share = 0.1;
/// fitted: guess. Distance between cuts.
inline constexpr double k_spacing = 0.01;

// ---- ends of limbs (limb_end.cpp, limb_joints.cpp) ----------------------------------------------------------------

/// fitted: on the bodies. Relative standard deviation of girth at the wrist and the shin.
inline constexpr double k_girth_spread = 0.10;
/// fitted: on the bodies. Girth ratio from wrist to palm and from shin to heel.
inline constexpr double k_limb_widening = 1.15;
/// fitted: guess. Number of consecutive wider cuts that show a hand or heel: a single cut may be wrong.
inline constexpr int k_wider_in_a_row = 3;
/// fitted: on the bodies with and without hands. Girth at the end of the curve: fingers have 0.035, stumps of arms
/// 0.08.
inline constexpr double k_thin_hand = 0.045;
/// fitted: on the bodies with and without feet. The same for legs: toes have at most 0.07, stumps at least 0.12.
inline constexpr double k_thin_foot = 0.09;
/// fitted: on the bodies with and without hands and feet. Girth ratio: fists and shoes are wider than the wrist or shin
/// before them, by 1.15 in nearly all bodies; a stump reaches at most 1.02.
inline constexpr double k_wider_end = 1.08;
/// fitted: on the bodies with mittens. Distances from the end between which the taper is measured, and the smallest
/// ratio of girths that is a mitten. Forearms without hand taper to 0.73 to 0.83.
inline constexpr double k_taper_from = 0.12, k_taper_to = 0.04, k_most_tapered = 0.9;
/// fitted: on the bodies with and without hands. Free length of an arm: at least 0.33 with a mitten, at most 0.31
/// without hand.
inline constexpr double k_arm_with_hand = 0.32;
/// fitted: guesses, on the bodies with and without feet and on men in trousers and shoes, which hide where the shin ends.
/// Distances from the end of a leg's curve between which shin and forefoot have their directions, and the angle, rad,
/// that is a foot's: feet have 1.0 to 1.6, stumps at most 0.5, or 0.8 where the leg is bent.
inline constexpr double k_shin_from = 0.3, k_shin_to = 0.18, k_forefoot = 0.05, k_least_foot_angle = 0.9;
/// fitted: guess. Distances from the end of a limb's curve: where the search for its end begins, and the extent of palm
/// and instep.
inline constexpr double k_limb_end = 0.16, k_palm = 0.1, k_instep = 0.14;

/// fitted: on the bodies. Straight distance from the fingertips to the wrist: limits and standard deviation. The usual
/// distance is from the literature (joint_labels.cpp).
inline constexpr double k_least_hand = 0.05, k_most_hand = 0.19, k_hand_spread = 0.02;
/// fitted: on the bodies. Straight distance from the toes to the narrowest part of the shin: limits, usual, standard
/// deviation.
inline constexpr double k_least_foot = 0.08, k_usual_foot = 0.15, k_most_foot = 0.22, k_foot_spread = 0.04;
/// fitted: guess. Lengths of the ends of curves on whose skin fingertips, crown, and toes and heel are searched.
inline constexpr double k_hand_skin = 0.12, k_crown_skin = 0.12, k_foot_skin = 0.25;
/// fitted: guess. Share of an arm's length: from here to its end an arm's direction is measured.
inline constexpr double k_last_of_arm = 0.6;
/// fitted: guess, on the bodies without hands or feet. Distances from the end of a stump between which its axis is
/// measured.
inline constexpr double k_stump = 0.06, k_stump_cap = 0.02;
/// fitted: guess. Radius of the cylinder about the shin's axis that contains the heel.
inline constexpr double k_heel_radius = 0.05;
/// fitted: on the bodies. Largest distance from the narrowest part of the shin to the ankle: for a pointed foot the
/// toes are the sole.
inline constexpr double k_ankle_below_shin = 0.05;
/// fitted: guess. Smallest number of cuts of a free limb, and between its beginning and its last joint.
inline constexpr int k_fewest_free_cuts = 10, k_fewest_limb_cuts = 4;
/// fitted: on closed clothes and bodies without heads. Number of limbs that must widen to a hand or foot if the head is
/// missing.
inline constexpr int k_fewest_without_head = 2;

// ---- elbows and knees (bend.cpp) ----------------------------------------------------------------------------------

/// fitted: on the bodies. Standard deviation of the ratio of upper bone to limb.
inline constexpr double k_ratio_spread = 0.03;
/// fitted: on the bodies. Standard deviation of the centroids of cuts from a straight bone.
inline constexpr double k_straight_spread = 0.006;
/// fitted: guess, on the bodies. rad: between these angles the joint moves from the line of cuts to the intersection of
/// the axes.
inline constexpr double k_corner_from = 0.5, k_corner_to = 1.0;
/// fitted: guess, on the bodies. Largest distance between the axes, and from their intersection to the line of cuts.
inline constexpr double k_corner_gap = 0.03, k_corner_reach = 0.06;
/// fitted: guess. Residuals of cuts are limited to this distance: in a deep bend some cuts are wrong.
inline constexpr double k_outlier = 0.06;
/// fitted: guess. Number of cuts of a bone from which an axis is fitted.
inline constexpr int k_fewest_cuts = 6;
/// fitted: guess. Tenths of the cuts of a bone that are left out of the fit of its axis: at the trunk, and at the bend.
inline constexpr int k_trunk_tenths = 2, k_bend_tenths = 3;

// ---- hips and shoulders (limb_joints.cpp) -------------------------------------------------------------------------

/// fitted: on the bodies. The midpoint of the hips from the midpoint of the legs' first free outlines: along the
/// thighs, and down.
inline constexpr double k_hips_along_thighs = 0.04, k_hips_below_rings = 0.009;
/// fitted: on the bodies. Distance between the hips. The skin hardly shows it.
inline constexpr double k_hip_width = 0.123;
/// fitted: guess. Length of the thigh from which the direction to the hip is measured.
inline constexpr double k_first_of_thigh = 0.12;
/// fitted: on the bodies. The shoulder from the centroid of the arm's first free outline: up, out, and inwards along
/// the upper arm. The inwards distance is reduced by k_shoulder_back times the cosine between upper arm and sideways.
inline constexpr double k_shoulder_up = 0.012, k_shoulder_out = 0.007, k_shoulder_inwards = 0.0135,
                        k_shoulder_back = 0.03;
/// fitted: on the bodies. Length ratio from hip to knee and from hip to the narrowest part of the shin.
inline constexpr double k_knee_above_shin = 0.545;
/// fitted: on the bodies. Share of the measured length in the length of an upper bone; the rest is expected from the
/// lower bone.
inline constexpr double k_measured_share = 0.5;

// ---- lengths of limbs (limb_joints.cpp) ---------------------------------------------------------------------------

/// fitted: on the bodies. Length of an arm and of a leg. The stature is here BodyGraph::size or size_by_legs.
inline constexpr double k_arm = 0.294, k_whole_leg = 0.495;
/// fitted: on the dirty bodies. Logarithms of the length ratio between which a limb counts as more and more shortened,
/// by flesh or by filled holes of a scan that bridge it to the trunk.
inline constexpr double k_short_from = 0.08, k_short_to = 0.16;
/// fitted: on the dirty bodies. Share of the missing length that is added, of a normal limb and of a shortened one.
inline constexpr double k_usual_share = 0.3, k_short_share = 0.85;
/// fitted: on the dirty bodies. rad: between these angles the middle joint moves less and less when a limb is
/// lengthened.
inline constexpr double k_bent_from = 0.26, k_bent_to = 0.7;

// ---- spine, neck and head (joint_labels.cpp) ----------------------------------------------------------------------

/// fitted: guess. Length above the pelvis in which centroids of cuts are ignored, and spacing of the spine's line, in
/// k_spacing.
inline constexpr double k_pelvis_cuts = 2, k_spine_spacing = 0.5;
/// fitted: on the bodies, by the number with correct sides. Distances below the end of the spine's line: end of the
/// head, beginning and end of the neck.
inline constexpr double k_head = 0.09, k_jaw = 0.13, k_neck = 0.2;
/// Share of the distance from the pelvis to the shoulders: the neck begins no further above these. fitted: guess; 22
/// bodies with human heads have .14 to .3, a figure with a large one had 1.
inline constexpr double k_neck_above_shoulders = 0.4;
/// fitted: guess, on the bodies without heads. Share of neck and head that remains.
inline constexpr double k_neck_stub = 0.25;

// ---- left and right (side_classification.cpp) ---------------------------------------------------------------------
// fitted: guesses, on the bodies, by the number with correct sides. A weight is between 0 and 1 unless a largest one is
// named.

/// Distance of the foot's end from the shin's axis, a share of the stature, from which it is evidence and from which it
/// weighs 1. fitted: guesses; feet of 70 house and strangers' bodies reach 0.074 to 0.17, stumps of shins that were cut
/// off 0.008 to 0.061
inline constexpr double k_foot_stump = 0.045, k_foot_whole = 0.075;
/// Weight of a knee's flexion per offset from the leg's line; the offset is a share of the leg's length.
inline constexpr double k_knee_weight = 6;
/// Weight of a hip's flexion per excess over the sine between thigh and vertical: a hip flexes by 120 degrees and
/// extends by 20, whose sine is 0.34.
inline constexpr double k_hip_weight = 2, k_hip_extension = 0.35;
/// Weight of an elbow's flexion per offset from the arm's line, and its largest weight.
inline constexpr double k_elbow_weight = 2, k_most_elbow_weight = 0.5;
/// Weight of the head's offset from the neck, and its largest weight.
inline constexpr double k_head_weight = 25, k_most_head_weight = 0.5;

/// Weight of the legs' profile per certainty of it (leg_profile.cpp): less than that of two feet. fitted: guess
inline constexpr double k_profile_weight = 1;

/// Sum of weights below which the confidence falls: slightly bent arms alone agree, but say little. fitted: guess, on one
/// man whose feet were hidden and whose arms are held back a little.
inline constexpr double k_whole_evidence = 1;
/// Confidence below which nothing shows the front, or what does contradicts itself: it is +z then, as of 44 of 50
/// strangers' files. fitted: guess; of two strangers' figures known to be below, one faces +z, one +x
inline constexpr double k_no_confidence = 0.05;

// ---- profile of the legs (leg_profile.cpp) -------------------------------------------------------------------------

/// Log-odds of the front per bow of thighs and shins. fitted: by scripts/fit-leg-profile, on 99 house and strangers'
/// bodies and copies of them without head, hands or feet. Fitted on one half, 41 of 43 and 46 of 53 of the other are
/// right; of all, the 74 whose probability is 0.9 or more.
inline constexpr double k_thigh_bow = 38, k_shin_bow = -65;
/// Where thighs and shins are cut, shares of the bone's length. fitted: by eye, on profiles of the same bodies.
inline constexpr std::array k_buttock_places { 0.1, 0.15 }, k_below_knee_places { 0.01, 0.05 },
    k_ankle_places { 0.9, 0.95 };
inline constexpr std::array k_thigh_places { 0.5, 0.6, 0.7, 0.8 };
inline constexpr std::array k_calf_places { 0.2, 0.3, 0.4, 0.5, 0.6 };
/// fitted: guess. Points of a cut's outline below which a bone has no skin of its own there.
inline constexpr int k_fewest_in_profile = 6;
/// fitted: guess. Cosine of a bend at hip or knee from which the profile of the bone below says nothing.
inline constexpr double k_bent_profile = 0.7;

// ---- rig validation (rig_validation.cpp) --------------------------------------------------------------------------

/// fitted: guess, on the bodies. Smallest share of samples on bones inside the body: mouth, armpit and crotch come
/// close to bones.
inline constexpr double k_inside_share = 0.85;
/// fitted: on the bodies and on blocks. Isoperimetric quotient: 1 = ball, 0.52 = cube; humans have 0.04, fat ones who
/// curl up 0.13.
inline constexpr double k_most_compact = 0.3;
/// The same for figures, and the least probability of being human that one has which is more compact than a human.
/// fitted: guesses, on a doll with a head as tall as the rest of it (0.40, 4e-5) and a boat (0.41, 4e-11)
inline constexpr double k_most_compact_figure = 0.48, k_least_like_compact = 1e-7;
/// fitted: on the bodies. Relative difference between a left and a right length; correct rigs have less than 0.05.
inline constexpr double k_side_tolerance = 0.2;

/// Shares of the body's height: how far outside of the skin a joint of a skeleton by another program may lie, and the
/// shortest limb bone of one. fitted: guess; the joints of a wrong map lie tenths off
inline constexpr double k_farthest_own_joint = 0.05, k_shortest_own_bone = 0.02;
/// The same for joints between pelvis, neck and head, which are not read but placed. fitted: guess, on one figure in a
/// robe, whose joint lies .054 outside
inline constexpr double k_farthest_placed_joint = 0.1;

/// Share of the shin's length: how far a foot may point backwards; right feet point .02 to 1.1 forwards. fitted: guess,
/// on one figure whose toes were taken for a heel
inline constexpr double k_most_foot_backwards = 0.15;
/// Shares of the shin's length. Skin of the shin bone is a foot's from so far above the ankle on, and a shin's from so far;
/// a foot reaches so far behind the middle of the shin's skin if it points backwards, and by this factor further than
/// before it. fitted: guess, on one figure (0.3, 0.04 before); right feet of eleven reach 0.4 to 0.6 before it and 0.04 to
/// 0.3 behind
inline constexpr double k_beyond_shin = 0.15, k_within_shin = 0.3, k_foot_behind = 0.2, k_behind_to_before = 2.5;
/// Share of the way from the hips to the neck: how far the pelvis may lie from the middle of the hips. fitted: guess
inline constexpr double k_farthest_pelvis = 0.5;

/// Interval of a ratio of lengths.
struct Proportion {
    double least, most;
};
/// fitted: guesses, wide enough for all bodies, children included, and narrow enough to refuse wrong labels.
inline constexpr Proportion k_upper_arm_to_forearm { 0.6, 1.7 }, k_thigh_to_shin { 0.6, 1.6 },
    k_arm_to_leg { 0.4, 0.85 }, k_trunk_to_leg { 0.4, 1.25 }, k_hip_width_to_leg { 0.05, 0.5 },
    k_shoulder_width_to_leg { 0.15, 0.8 }, k_collarbone_to_leg { 0.1, 0.65 };

// ---- figures of any proportions (figure_graph.cpp, figure_joints.cpp) ------------------------------------------------
// "variants": what scripts/vary_bodies.py makes of ten bodies; every other body for choosing, the rest for judging.

/// fitted: by time. Ends among which head, hands and feet are chosen.
inline constexpr std::size_t k_most_ends = 9;
/// fitted: guesses, on the variants. Standard deviations of the logarithms of length and thickness ratios of a pair,
/// and of the distance between the places where it leaves the trunk, a share of the figure's length.
inline constexpr double k_pair_length_spread = 0.15, k_pair_thickness_spread = 0.25, k_pair_fork_spread = 0.08;
/// fitted: guesses. Standard deviations of the logarithms of ratios to the leg's length. Heads of cartoons are large,
/// not small.
inline constexpr double k_arm_ratio_spread = 0.5, k_trunk_ratio_spread = 0.6, k_head_ratio_spread = 0.8,
                        k_small_head_spread = 0.35;
/// fitted: guesses, on the variants. Thickness ratio of arms to legs, and the standard deviation of its logarithm.
inline constexpr double k_arm_thickness = 0.62, k_thickness_spread = 0.4;
/// fitted: guesses. Length of an end that is no limb, a share of the figure's, and the most that one costs.
inline constexpr double k_rest_spread = 0.13, k_most_rest_cost = 9;
/// fitted: guesses, on the variants. Share of that cost that an end in the middle, such as a tail's, is spared, and its
/// distance from the plane between the ends of a pair, a share of the figure's length.
inline constexpr double k_tail_discount = 0.7, k_middle_spread = 0.12;
/// fitted: guesses. Difference between the distances of a pair's ends from the middle, a share of the figure's length,
/// and the most that one costs: a walking figure is not symmetric.
inline constexpr double k_place_spread = 0.1, k_most_place_cost = 4;
/// fitted: guesses. Height of the feet above the lowest end, a share of the figure's length, and the most that it
/// costs: a figure may lie or stand on its head.
inline constexpr double k_lowest_spread = 0.15, k_most_lowest_cost = 9;
/// fitted: guesses, on strangers' figures whose heads were taken for hands. Cosine between trunk and neck from which a
/// bent neck costs, and the standard deviation beyond it.
inline constexpr double k_bent_neck = 0.5, k_neck_spread = 0.35;
/// fitted: guesses. Costs of a missing head, and of lying down.
inline constexpr double k_no_head_cost = 8, k_lying_cost = 2;
/// fitted: guesses, on one woman in a gown and six made-up ones. Of a figure whose legs do not show: the least share of
/// the way from the shoulders to the ground above where the legs part (a human has 0.4, short-legged figures 0.65), and
/// what it costs, costs where no feet show either, and the least cosine of its tilt.
inline constexpr double k_covered_trunk = 0.72, k_covered_cost = 1, k_no_feet_cost = 1, k_covered_upright = 0.9;
/// fitted: guesses. Longest finger, a share of the diagonal, and share of an arm that is not the other one's too.
inline constexpr double k_longest_finger = 0.045, k_own_share = 0.7;
/// fitted: guess. Shortest limb, a share of the figure's length.
inline constexpr double k_shortest_limb = 0.08;
/// fitted: guess. A choice that costs more has no arms or no legs.
inline constexpr double k_most_figure_cost = 20;

/// fitted: guess. A trunk this short, a share of the figure's length, does not show where up is.
inline constexpr double k_short_trunk = 0.08;
/// fitted: guesses. Of a limb that is divided: number of cuts, and the latest place where it begins, a share of its
/// curve.
inline constexpr int k_cuts_of_limb = 45;
inline constexpr double k_latest_root = 0.45;
/// fitted: guesses. Largest logarithms of the ratio of a pair's lengths and of the ratio of a limb's bones, and least
/// and largest share of its curve that a limb's bones have; else the limb is divided.
inline constexpr double k_largest_pair_difference = 0.18, k_largest_bone_ratio = 0.5, k_least_limb_share = 0.45,
                        k_most_limb_share = 1.3;
/// fitted: guesses, on the variants. Distance of the hips: a share of that of the knees, up to a share of the leg.
inline constexpr double k_hips_to_knees = 0.7, k_widest_hips = 0.5;
/// fitted: guess. Base of the neck above the shoulders, at most, a share of the stature by the arms.
inline constexpr double k_neck_over_arm = 0.03;

/// fitted: on the variants. A spread of lengths from which a human may be a figure of other proportions: bodies that
/// are rigged well as humans have at most 0.136, cartoons from 0.15.
inline constexpr double k_doubtful_spread = 0.145;
/// fitted: guess. Score that each limb costs whose joints did not show.
inline constexpr double k_divided_cost = 0.4;
/// fitted: guess. Score that a wide wrap costs: it joins arms with the trunk, too.
inline constexpr double k_wide_wrap_cost = 1;
/// fitted: guess. A wide wrap with more vertices is of layers or tangled hair: the narrow one would be given up after 10 s
/// or has no use. Six figures that the narrow wrap helped have 850 to 1700, three whose wrap was in vain from 2800.
inline constexpr int k_most_in_wide_wrap = 2500;
/// fitted: guess. A figure with this score (minus its costs) needs no other way to join its parts.
inline constexpr double k_sure_figure = -1.5;

// ---- figures of shells (shell_figure.cpp) --------------------------------------------------------------------------
// fitted: guesses, on made-up figures of blocks; lengths are shares of the trunk's box unless said otherwise.

/// Most shells, and most parts after those that lie in each other are joined: more are no blocks.
inline constexpr std::size_t k_most_shells = 200, k_most_parts = 24;
/// Share of a smaller box within a larger one from which both are one part, and what boxes grow by, a share of the
/// diagonal of all.
inline constexpr double k_nested_share = 0.6, k_shell_padding = 0.005;
/// Of half the trunk: how far out an arm's middle lies at least, how far below the trunk's it lies at most, and how far
/// from the middle a leg's lies at least.
inline constexpr double k_beside_trunk = 0.9, k_arm_below_trunk = 2, k_leg_off_middle = 0.15;
/// Share of the diagonal by which a part may lie off the mirror image of its twin, the largest logarithm of the ratio
/// of their sides, and the cost of a figure with parts that have no twin and do not matter to it. fitted: guesses, on
/// one stranger's archer, whose bow hides forearm and hand
inline constexpr double k_twin_distance = 0.03, k_twin_size = 0.2, k_held_cost = 2;
/// Share of its height by which a head lies above the trunk at least, and a leg below it: both may be sunk into it.
/// fitted: guess, on a stranger's giant whose head is sunk in by 0.55
inline constexpr double k_out_of_trunk = 0.35;
/// Share of a limb's extent at its end that says where the end is, and how far pelvis and neck lie in the trunk.
inline constexpr double k_end_of_part = 0.1, k_pelvis_in_trunk = 0.08;
/// Share of a limb before and beyond elbow or knee in which both bones move its shells.
inline constexpr double k_shell_bend = 0.08;

// ---- human likeness (rig_validation.cpp) -----------------------------------------------------------------------------

/// fitted: guesses. Standard deviations by which a logarithm of a ratio may leave a human's interval, a share of the
/// skeleton outside of the body, a difference of sides beyond the tolerance, and k_most_foot_backwards.
inline constexpr double k_ratio_excess = 0.35, k_outside_excess = 0.1, k_sides_excess = 0.15, k_feet_excess = 0.1;
/// fitted: guess. Least share of the samples on bones inside a figure that is rigged at all.
inline constexpr double k_figure_inside_share = 0.6;

// ---- attempts (rig_body.cpp) --------------------------------------------------------------------------------------

/// fitted: guess, on the dirty bodies. Number of proxy vertices of the second and third attempt, as shares of the
/// first.
inline constexpr double k_coarser_proxy = 2.0 / 3, k_finer_proxy = 1.5;
/// fitted: by time. A second or third copy is left out that is more than so many times as large as asked, because its
/// triangles were quartered: it is slow, and has the first one's shape.
inline constexpr double k_most_quartered = 1.5;

}  // namespace garmentfit::rig_tuning
