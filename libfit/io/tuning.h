// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Numbers of io that were chosen on data: how units and axes of a file are guessed. Lengths are metres here, of a real
// body or garment, because the guess comes before anything is scaled. docs/files.md tells the method;
// tests/io/units_test.cpp holds the outcome for the bodies in tests/bodies and for garments made in code.

#include <array>
#include <string_view>

namespace garmentfit {

/// Dimensionless, a logarithm: how much rarer each axis of k_axes is as "up" than +y. Decides where the shape does not.
/// fitted: guess, from experience with mesh files; none of 173 bodies of public repositories stands on its head.
inline constexpr std::array<std::string_view, 6> k_axes { "+y", "+z", "-y", "-z", "+x", "-x" };
inline constexpr std::array<double, 6> k_axis_rarity { 0, 0.2, 4, 4, 1.5, 1.5 };
/// The same where the file's format says which axis is up, of every other axis. fitted: guess; exporters are told to keep
/// other axes now and then.
inline constexpr double k_rarity_against_format = 3;

struct KnownUnit {
    std::string_view name;
    double metres;
    double log_rarity;  ///< dimensionless: how much rarer than metres in mesh files. fitted: guess, from experience
};
/// derived: metres by the definitions of the units; an inch is 25.4 mm.
inline constexpr std::array<KnownUnit, 6> k_known_units { { { "m", 1, 0 },
                                                            { "dm", 0.1, 0.5 },
                                                            { "cm", 0.01, 0.2 },
                                                            { "mm", 0.001, 0.2 },
                                                            { "in", 0.0254, 2.2 },
                                                            { "ft", 0.3048, 3 } } };

/// m. A newborn; the tallest with arms up. Outside of them a unit is impossible. fitted: guess.
inline constexpr double k_least_stature = 0.4, k_largest_stature = 2.6;
/// m, and the spread of its logarithm: children are usual too. Weighs units that are possible. fitted: guess.
inline constexpr double k_usual_stature = 1.65, k_stature_spread = 0.35;
/// m, longest sides of baby shorts and of a gown. Outside of them a unit is impossible. fitted: guess.
inline constexpr double k_least_garment = 0.2, k_largest_garment = 3;
/// m, and the spread of its logarithm. fitted: guess.
inline constexpr double k_usual_garment = 0.9, k_garment_spread = 0.45;
/// Dimensionless, a logarithm that no deviation from the usual comes near. unit.
inline constexpr double k_impossible = 1000;

/// Cells along the longest side by which left and right are compared: 5 cm on an adult, wider than a pose is uneven.
/// fitted: guess, on the bodies of tests/bodies.
inline constexpr int k_symmetry_cells = 32;
/// Dimensionless, a share of the surface. No scan is more even than this. fitted: guess.
inline constexpr double k_evenness = 0.1;
/// Dimensionless: how much the longest side counts against evenness. fitted: guess, on the bodies of tests/bodies.
inline constexpr double k_length_weight = 2;
/// Dimensionless, a share of the length: how deep the end of a body is looked at for soles. And the cosine of the angle
/// within which a face counts as flat. fitted: guess, on the bodies of tests/bodies.
inline constexpr double k_end_depth = 0.025, k_flat_cosine = 0.9;
/// Dimensionless, a share of the surface; a sole has 0.006. fitted: guess.
inline constexpr double k_least_sole = 0.002;
/// Dimensionless: how much the share of surface above the middle counts against soles. fitted: guess, on tests/bodies.
inline constexpr double k_top_heavy_weight = 30;
/// Dimensionless: the most that this says for or against. Most of the surface of who wears a gown is below; that alone
/// turns nobody over. fitted: guess, on three bodies in gowns.
inline constexpr double k_most_top_heavy = 1.5;

/// Dimensionless: how much symmetry counts against height in a garment. fitted: guess.
inline constexpr double k_symmetry_weight = 2;
/// Dimensionless, evidence for other axes than the body's. Below it the body's axes are the better evidence. fitted:
/// guess.
inline constexpr double k_clear_preference = 0.4;

/// Dimensionless, a share of the surface with normals that point against the faces. Fewer are flipped faces. fitted:
/// guess; files have none or all.
inline constexpr double k_left_handed = 0.75;

/// Dimensionless, a ratio of distances between joints and their skin: below it, meshes are shown where their nodes are
/// and not where their bind matrices put them. fitted: guess; one file that lacks the turn and scale of its armature has
/// 0.0007, nine others have 1 to 20.
inline constexpr float k_much_nearer_joints = 0.3f;

/// Dimensionless, a share of the diagonal of what an avatar's joints move: what is farther from it is not worn, nor hair
/// or eyes. fitted: guess, on three files with a desk, a ball and a floor.
inline constexpr double k_far_from_skin = 0.08;

/// Dimensionless, the least extent of a part by its largest, up to which it is a panel. unit: digits of single precision
/// and of an exporter. Dimensionless, a share of the diagonal of what is none: smaller panels may be eyes or hair. fitted:
/// guess, on one file with three lamps.
inline constexpr double k_flat = 1e-3, k_panel_size = 0.3;

/// Dimensionless, a share of the weights of a part of clothes: it hangs on bones with more. Dimensionless, a share of
/// the samples of a bone: skin is under clothes where so many are inside of it. fitted: guess.
inline constexpr double k_least_hold = 0.05, k_least_skin = 0.7;
/// Along each bone. unit.
inline constexpr int k_skin_samples = 12;

/// Dimensionless. Where a skeleton has no neck, that joint is so far down from the head towards the shoulders. fitted:
/// guess, on the skeletons of Mixamo and MakeHuman.
inline constexpr double k_neck_above_shoulders = 0.7;

// A skeleton whose names lack an elbow, knee, hand, foot or head.
/// Dimensionless, shares of the way from shoulder to fingertips and from hip to sole [drillis_1966_segments].
inline constexpr double k_elbow_share = 0.42, k_wrist_share = 0.75, k_knee_share = 0.46, k_ankle_share = 0.93;
/// Dimensionless, a share of the usual place of the last joint of a limb: nearer to the first one it is the middle one,
/// whatever its name. fitted: guess, on one figure; elbows and knees lie at 0.56 and 0.49 of it.
inline constexpr double k_middle_called_last = 0.65;
/// Dimensionless, shares of the way along the limb: within the first a joint without a name is taken for the one that is
/// missing; half width of the transition of skin at an elbow or knee that is added. fitted: guess, on three figures.
inline constexpr double k_near_share = 0.2, k_middle_blend = 0.06;
/// Dimensionless, shares of the farthest skin: between them it lies along the bone. fitted: guess, on one figure each.
inline constexpr double k_limb_middle[] = { 0.2, 0.7 };
/// Dimensionless. Length of the sum of directions over the sum of their lengths, from which on they say where a limb
/// points: 1 where all are the same. fitted: guess, on one figure of blocks.
inline constexpr double k_directions_agree = 0.5;
/// Shares of the farthest skin, from shoulder or hip on: through the lower half, as the skin of hips and shoulders lies
/// beside the limb. fitted: guess, on three figures.
inline constexpr double k_lower_limb[] = { 0.5, 0.85 };
/// Dimensionless. The length of a shin as a share of that from the knee to the sole [drillis_1966_segments].
inline constexpr double k_shin_to_sole = 0.86;
/// Dimensionless. The length of a forearm as a share of the upper arm's [drillis_1966_segments], and the least and the
/// largest as a share of that from the elbow to the fingertips. fitted: guess.
inline constexpr double k_forearm_to_upper_arm = 0.8, k_forearm_to_fingertip[] = { 0.5, 0.8 };
/// Dimensionless. From the neck's lowest joint to the head's as a share of that to the crown. fitted: guess.
inline constexpr double k_neck_to_crown = 0.35;

/// Dimensionless. From the ankle to the tip of the foot, and from the wrist to the tip of the hand: where the toes and
/// the fingers begin. fitted: guess.
inline constexpr double k_ball_of_foot = 0.65, k_knuckles = 0.45;
/// Dimensionless, a share of the bone before: half width of the transition at wrist or ankle. fitted: guess; as
/// k_extremity_blend of the skeleton room.
inline constexpr double k_wrist_blend = 0.12;

}  // namespace garmentfit
