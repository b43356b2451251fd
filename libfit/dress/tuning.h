// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The fitted numbers of this room: chosen on data, neither derived nor taken from literature.
//
// Units    "m" means body metres: metres on a body of human size. Numbers without a unit are dimensionless.
// Data     "house pairs": twelve pairs of a body and a garment, real and modelled. "Samples": docs/samples on
//          tests/bodies.
// Score    a pair counts when its result is certified; among those, the smaller largest stretch of an edge is better.
// A guess  is a number that worked on these data and was not varied against a score.
//
// Defaults of DrapeOptions and RecoverOptions and k_overstretched stand in their headers, because they are part of the
// interface. They are fitted, too: guesses on the house pairs, the defaults a compromise between time and certified
// results.

#include <array>
#include <numbers>

namespace garmentfit {

// ---- growing the body (growing_body.cpp, drape_garment.cpp) ------------------------------------------------------

/// Body scales to start with, tried from the first. The first is below 2 mm for a limb; the others serve bones that run
/// nearer to the cloth. None leaves faces without area. Fitted: samples on all test bodies; with the first alone, poses
/// with cloth very near to a bone were refused.
inline constexpr std::array<double, 3> k_initial_body_scales { 0.01, 0.003, 0.001 };
/// Rounds in which corners of the body are drawn to joints; each takes a search for crossings. guess
inline constexpr int k_most_tucks = 20;
/// m; by how much further in each round, and in how many, a bare body is tried beside where the fit has it, where its
/// bones cross the cloth there. guess, on one sweater, whose collar is turned in
inline constexpr double k_start_shift = 0.01;
inline constexpr int k_start_shifts = 3;
/// m; the longest move of a vertex in one step while the body grows. Fitted: guess, on the house pairs.
inline constexpr double k_growing_move = 1e-2;
/// Steps that cloth gets to slide at full size before it is called too small for a body. Fitted: one skirt needs 9; of a
/// pair of trousers and a shirt that are too small the stretch stays within a tenth from the fifth to the twentieth.
inline constexpr int k_relaxing_steps = 20;
/// Where one part ends the growth, other parts stretched beyond this share of the limit are named, too. Fitted: guess,
/// on the house pairs.
inline constexpr double k_named_stretch_share = 0.7;
/// An enlarged garment is stretched by this share of the allowed stretch, so that the next step does not ask for more.
/// Fitted: guess.
inline constexpr double k_enlarged_stretch_share = 0.5;

// ---- bodies of many vertices (coarse_body.cpp, recover_pose.cpp), docs/decisions/0053-coarse-bodies.md ---------------

/// Vertices from which on a body is dressed on some of them, at least about so many; with edges that collapse as long as
/// that moves the surface by less than this, m; and their share, up to which it is worth it. Fitted: guesses by time, on
/// one body of 13,000, 54,000 and 214,000 vertices.
inline constexpr int k_fine_body = 30000, k_coarse_body_vertices = 15000;
inline constexpr double k_coarse_body_error = 4e-4, k_worth_coarsening = 0.7;
/// m; a vertex is bound to a triangle that it is joined with, if there is one so near. Fitted: guess, of twice that error
/// and more.
inline constexpr double k_bound_beside = 1e-3;
/// Time steps under gravity, once the body goes from the coarse surface to its own skin. Fitted: guess.
inline constexpr int k_own_skin_steps = 4;

// ---- bodies of few vertices (refined_body.cpp), docs/decisions/0054-refined-bodies.md --------------------------------

/// m; a triangle with a longer edge is large, and a body that is mostly made of such is refined until no edge is longer
/// than the second. Fitted: guesses, on 36 bodies of strangers; by area, half of a body of MakeHuman's with 1,605
/// vertices has edges of .09 m and more, and of those that came out torn .13 m.
inline constexpr double k_large_triangle = 0.105, k_refined_edge = 0.045;

// ---- hands (hand_stretch.cpp) ------------------------------------------------------------------------------------

/// Shares of its bend that are taken back from a hand, tried from the first. Fitted: of half stretches, a jacket with
/// crumpled cuffs failed, because the hand grew into the folds (docs/decisions/0010-straight-hands.md).
inline constexpr std::array<double, 2> k_hand_stretches { 0, 1 };

// ---- sleeve retraction (sleeve_retraction.cpp), docs/decisions/0014-sleeve-retraction.md --------------------------

/// Share of the forearm's or shin's length up to which a sleeve is retracted. The skin of a hand or foot blends into
/// its limb from 0.88 on (ExtremityBend::blend); this leaves as much again. Fitted: guess, on the house pairs.
inline constexpr double k_retracted_end = 0.76;
/// Share of the bone's length: cloth that goes over into other cloth further along is no sleeve of this limb. Fitted:
/// guess.
inline constexpr double k_latest_sleeve_begin = 0.5;
/// Share of the bone's length: whether cloth encloses a limb is asked beyond it. Fitted: guess.
inline constexpr double k_enclosed_from = 0.5;
/// Radians; cloth that encloses a limb leaves no wider angle open. Fitted: guess; a coat's front beside a hand leaves
/// more.
inline constexpr double k_widest_open_angle = std::numbers::pi / 2;
/// Share of the cloth beyond the wrist, from the hem: its mean tells how far the sleeve leads off the bone's line.
/// Fitted: guess.
inline constexpr double k_hem_share = 0.3;
/// m; buttons and the like lie no further from the sleeve that they belong to. Fitted: guess.
inline constexpr double k_attached_distance = 0.02;

// ---- creases (creases.cpp), docs/decisions/0012-taut-bridges.md ---------------------------------------------------

/// Radius of the ball that needs clearance above the skin, in square roots of the body's area, which no pose changes: 1
/// cm for an adult. Fitted: five pairs of sitting and raised legs; 2.5 mm leave shirts in a lap, 15 mm bridge more than
/// need be.
inline constexpr double k_crease_ball = 0.0075;
/// Skin is not smooth: a ball with this share of its clearance does fit. Fitted: guess.
inline constexpr double k_ball_tolerance = 0.9;
/// Share of a bridge that is drawn to the crease boundary; the rest is a soap film, so that no face loses its area.
/// Fitted: guess, on the same five pairs.
inline constexpr double k_bridge_tautness = 0.9;
/// In radii of the ball: skin this near across a crease is the other side of its opening. Fitted: the ball's diameter,
/// 2, was too little between the thighs of a body of 7,000 vertices with shorts and trousers; 2.5 was enough.
inline constexpr double k_opening_width = 3;
/// In radii of the ball; how far apart the depths of a crease are measured. Fitted: guess.
inline constexpr double k_depth_spacing = 0.5;
/// m; cloth further from a crease at the start does not get into it along the pose path. Fitted: guess; without a
/// limit, mouths and toes were smoothed away.
inline constexpr double k_crease_reach = 0.15;
/// Share of the body's vertices: a patch with fewer is an island in a crease, not a limb beyond it. Fitted: guess.
inline constexpr double k_enclosed_patch = 0.01;
/// Share of the way to the core that skin in creases is withdrawn before it goes to its place. Fitted: guess.
inline constexpr double k_crease_withdrawal = 0.5;

// ---- tightness (tightness.cpp) -----------------------------------------------------------------------------------

/// |cosine| between an edge and a bone: below it, the edge runs round the bone (within 30 degrees of straight across).
/// Fitted: guess.
inline constexpr double k_across_bone = 0.5;
/// Stretch that every garment gives round the neck, at least: knits have a rib there, shirts and jackets open. The most
/// that knits but ribs give. Fitted: guess, on two strangers' T-shirts and hoodies that lacked girth at the neck alone.
inline constexpr double k_neck_stretch = 0.35;
/// A part is judged when its edges would go round it this often: a hem that just reaches it does not stretch as a
/// whole. Fitted: guess, on the house pairs.
inline constexpr double k_fewest_rounds = 6;
/// Quantile, by length, of the stretch that counts for cloth at rest: single edges stretch for many reasons. Fitted: guess.
inline constexpr double k_stretch_quantile = 0.95;
/// Shares of what the fabric gives. A garment of which that quantile is stretched further will not slide to where it is
/// wide enough. fitted: guess; house pairs and the wild clothes on three bodies have at most 1.3, by the number of
/// edges, where they are worn at the end, trousers that are too small 1.75, a blouse that is far too small 2.9.
inline constexpr double k_far_too_tight = 2;
/// An edge stretched by more is caught (a cuff on a thumb) and no measure of girth; it counts as stretched by this.
/// Fitted: guess; without it, garments were called too small by up to 137 %.
inline constexpr double k_caught_stretch = 0.5;
/// The same in shares of what the fabric gives, where that is more: a knit may be stretched as far all round. Fitted:
/// guess.
inline constexpr double k_caught_share = 1.5;

// ---- moving to another pose (pose_path.cpp, recover_pose.cpp) ------------------------------------------------------

/// Passes over the edges that even out the skin weights of the cloth: what lies between two limbs follows both. Fitted:
/// guess.
inline constexpr int k_weight_smoothing_passes = 30;
/// Share of the friction that is left while the body moves: a moving body works its clothes loose. Fitted: guess.
inline constexpr double k_moving_friction = 0.25;
/// Settling steps more, where a garment looks too tight after those asked for.
/// fitted: guess; one shirt of the house data looks so after 10, and not after 20.
inline constexpr int k_steps_if_tight = 40;
/// m; with no part of the body further from its place, a pose on the path counts as reached. Fitted: guess.
inline constexpr double k_in_place = 1e-3;
/// m; a part that lags by this much more than at the start has no clearance further on: the cloth would only be torn.
/// Fitted: on paths that end well no part lags by more than 0.02, but hands that cross reach 0.07
/// (docs/decisions/0011-restore-when-stuck.md).
inline constexpr double k_stuck_lag = 0.08;
/// Rings of vertices round pressed skin that give way with it, each less than the one before. Fitted: guess.
inline constexpr int k_rings_round_pressed = 3;
/// Share of the path after which creases are fully bridged. Fitted: guess.
inline constexpr double k_bridged_from = 0.5;

// ---- what is measured and reported (overlaps.cpp, layer_order.cpp, fit_map.cpp, girths.cpp) ------------------------

/// m; shallower overlaps are how creases of skin are modelled. Fitted: guess, on the test bodies.
inline constexpr double k_least_overlap = 2e-3;
/// Share of the body's girth: a garment that is wider by less may as well lie inside. Fitted: on four bodies with eight
/// sets of garments (docs/decisions/0015-layer-order.md).
inline constexpr double k_clearly_wider = 0.05;
/// In contact distances: cloth this near to the skin presses on it. Fitted: guess.
inline constexpr double k_pressing_distance = 1.5;
/// A spike of the body: l / l0 - 1 of an edge, against the pose, and m that it is longer by. Fitted: guess, on the house
/// pairs; a hand that is stretched out and the folds of an armpit stay below.
inline constexpr double k_spike_stretch = 2, k_least_spike = 0.03;
/// Of the sectors about a bone, those in which a cut must have points to be a girth. Fitted: guess.
inline constexpr int k_girth_sectors = 8, k_needed_sectors = 6;

/// Where the tape is laid, as shares of the bone's length from its head. Fitted: guesses, after where tailors measure.
inline constexpr double k_neck_at = 0.7;
inline constexpr double k_chest_from = 0.5, k_chest_to = 0.6;  // of upperback and of thorax
inline constexpr double k_waist_from = 0.5, k_waist_to = 1;  // of lowerback and of upperback
inline constexpr double k_seat_at = 0.3;  // of the thigh's length, below the root
inline constexpr double k_thigh_at = 0.25, k_upper_arm_at = 0.5;
/// Planes tried between two places, both included. Fitted: guess.
inline constexpr int k_girth_planes = 9;
/// Cosine of the angle between thigh and spine: a thigh raised further is not cut across by the tape of the hips.
/// Fitted: guess, 45 degrees.
inline constexpr double k_hanging_thigh = std::numbers::sqrt2 / 2;

/// Share of its distance from the cloth by which the inner sheet of a wrap is moved out. fitted: guess; a little is left, so
/// that the cloth stays around it. On the diagonal of a shirt 3.6 mm, 23 mm of girth, are missing without: its collar was
/// too small.
inline constexpr double k_lining_shift = 0.8;

/// Crowding (crowding.h) from which on a garment follows a stand-in. fitted: a guess between 1.8, the most of 152 clothes
/// of the house data, the catalogue and the wild, and 2.5, the least of clothes of web shops that took minutes
inline constexpr double k_crowded = 2.3;
/// Mean edges of the stand-in, within which the motions of its vertices are blended. fitted: guess, of 1.5, 3 and 5 on
/// a T-shirt and a jacket of doubled sheets: 3 leaves the fewest new crossings
inline constexpr double k_following_reach = 3;
/// The same for a garment that is the surface of its stand-in, with finer triangles, and the distance between the two on
/// the mean, up to which it is. fitted: guesses; of .8, 1.1, 1.5, 2 and 3 on a coat of 46,000 vertices, 1.1 strains least
inline constexpr double k_own_reach = 1.1, k_same_surface = 0.1;
/// Vertices from which on cloth without crossings follows a coarser copy of itself, and about how many that has; it gets
/// a quarter more. fitted: by time: a coat of 46,000 takes 134 s as it is, 26, 24 and 16 s with 8,000, 5,500 and 3,500
inline constexpr int k_fine = 20000, k_coarse = 8000;
/// The same for cloth that then finds a rest of its own; what has fewer is not put on faster so. fitted: guesses: in
/// standard quality four garments of the house data, 8,200 to 15,600 vertices, on three bodies take .79 of the processor
/// time, in draft quality two thirds; two of 4,200 and 4,600 vertices no less
inline constexpr int k_led = 5000, k_rough = 2000;
/// A vertex is sure of what of its stand-in it lies on if the rest is so much further away, m, of which so many vertices
/// are looked at; it is bound as one that is surer by this share of the way to it. fitted: guesses, on three clothes of
/// web shops whose sleeves hang on the trunk
inline constexpr double k_doubted = 0.04, k_way_to_surer = 20;
inline constexpr int k_most_doubted = 200;
/// An edge of the garment is torn where it goes with its stand-in to this many times its length and this much more, m.
/// fitted: guess, on a chef's jacket of a web shop, whose sleeves hang beside the trunk
inline constexpr double k_torn = 2, k_torn_gap = 2e-3;
/// Beside tears, cloth goes with most of the cloth within this distance over it, m, looked at in patches of this
/// radius, m; what would take it further than this share of the way between them leads it elsewhere. Wide regions are
/// bound anew from their rims on, in up to so many rounds. fitted: guesses, on a puffer jacket of a web shop, of whose
/// trunk a strip 4 cm wide went with the sleeve
inline constexpr double k_cloth_around = 0.12, k_patch = 0.01, k_led_elsewhere = 0.5;
inline constexpr int k_tear_rounds = 12;
/// In mean edges of the garment: vertices this near to each other at rest are side by side, the nearest so many of them;
/// shorter links count as if they had the least length. fitted: guesses, on eleven clothes of web shops
inline constexpr double k_beside = 0.5, k_least_link = 0.1;
/// How far apart vertices of such sheets are led at most, m; others are of limbs that touched. fitted: guess, on a hoodie of
/// a web shop whose sleeves lie on its trunk
inline constexpr double k_apart = 0.03;
inline constexpr int k_most_links = 8;
/// How often a garment's motions are evened where parts of it meet, at most, and in vain; by how many links round these
/// places in the first round, and more in each; and how firmly they are held. fitted: guesses, on the same clothes
inline constexpr int k_evening_rounds = 6, k_futile_evenings = 3, k_evening_links = 3;
inline constexpr double k_evening_hold = 1e-3;
/// How often what meets the body is pushed out of it, at most, and in vain; how far round these places cloth goes along,
/// in mean edges, and in m at most, as ways out of two sides of a limb cancel each other; and how far beyond the skin, m,
/// and so much further in each round. fitted: guesses, on the same clothes and, the reaches, on six others
inline constexpr int k_pushing_rounds = 40, k_futile_pushes = 8;
inline constexpr double k_pushing_reach = 4, k_longest_reach = 0.2, k_pushing_step = 1e-3;
/// By how much ways grow less from place to place, on the mean, in shares of the distance. unit: below .6, sheets keep
/// their order
inline constexpr double k_steepest_way = 0.4;
/// By how much less space is taken along in each round after so many in vain. fitted: guess; of 1, .85, .7 and .5 on six
/// clothes
inline constexpr double k_harder_push = 0.85;
inline constexpr int k_patient_pushes = 2;
/// Ways that are blended, the nearest. unit: more change them by little
inline constexpr int k_most_ways = 64;
/// Places between vertices outside that are looked at, as the body may reach through there: so far apart, m, by parts of
/// an edge, at least and at most so many. fitted: guesses; at three places an edge and one a triangle, a dress of edges
/// of 6 cm kept crossings with the body
inline constexpr double k_places_apart = 0.01;
inline constexpr int k_parts_of_edge = 4, k_parts_of_triangle = 3, k_most_parts = 20;
/// Crossings that such a garment is given with, up to which all are untangled; of more, a few fewer than given are left.
/// fitted: guess, between 20 of a polo shirt, which come apart, and 14,000 of doubled sheets, which do not
inline constexpr std::size_t k_few_crossings = 1000;
inline constexpr double k_fewer_crossings = 0.99, k_least_parting = 1. / 16;
/// New crossings that are left, from which cloth is untangled once more. fitted: guess; a dress had one, and none then;
/// three clothes with 600 to 3,000 had as many after that
inline constexpr std::size_t k_last_crossings = 100;
/// How often cloth that was untangled is put back where it meets something. fitted: guess
inline constexpr int k_clearing_rounds = 6;
/// Units in which the digits of single precision are tried, m: metres, and two in which they end elsewhere.
inline constexpr std::array<double, 3> k_units_of_files { 1, 0.7, 0.3 };
/// Step in which what meets and did not as given is moved apart, in mean edges of the garment; how many of them at most,
/// and how many in vain halve it. fitted: on five clothes of web shops (docs/decisions/0033)
inline constexpr double k_gap_step = 0.1;
/// m; what lay nearer to each other at rest lay on each other. unit: some digits of single precision
inline constexpr double k_least_offset = 1e-6;
inline constexpr int k_gap_rounds = 60, k_futile_gap_rounds = 6;

/// Share of the progress that the way takes, and settling of the rest of it.
/// unit: of a progress bar.
inline constexpr double k_progress_of_path = 0.5, k_progress_of_settling = 0.2;

/// Share of a collarbone beyond its end that counts as shoulder: straps that lie there do not slip. guess, on three
/// clothes with straps
inline constexpr double k_beyond_shoulder = 0.15;
/// Share of the distance between the hips. Cloth that ends further below a hip joint hangs on the thigh.
/// fitted: guess, on trousers on 66 strangers' bodies: of those that looked worn, one ended 0.18 below and all others
/// less than 0.12, of those that did not, all more than 0.23
inline constexpr double k_below_hip = 0.2;
/// The same, a share of the way from the hip joints down to where the legs part, where that is lower. fitted: guess, on
/// one man in wide trousers, who wears others .13 of that way below; it is k_below_hip for a median body of 42
inline constexpr double k_towards_crotch = 0.5;

}  // namespace garmentfit
