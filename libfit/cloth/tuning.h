// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Every fitted number of the cloth room: chosen on data, or guessed and then confirmed on data.
//
// Units    m is a metre on a body of human size: bodies of another size are scaled to it before anything runs.
//          A number without a unit is dimensionless.
// Data     "the house data" are the pairs of a body and a garment that all changes were judged on, twelve at the end.
//          Their score is how many of them end certified; then the largest stretch of an edge, then the seconds.
// Choice   "guess" means: set once by judgement, kept because the house data end well with it. No search for a better
//          value is known.
//
// Numbers that are part of the interface stand in garmentfit/cloth.h: the defaults of ClothOptions.

#include <string_view>

#include "garmentfit/cloth.h"

namespace garmentfit {

// ---- fabrics (cloth) -----------------------------------------------------------------------------------------------

struct NamedMaterial {
    std::string_view name;
    Material material;
};

/// In the order of Fabric. docs/fabrics.md says for each number where it comes from; the columns are
/// density, kg/m^2. fitted: guess, of usual shirt, trouser and coat cloth; of the first five on the house data;
/// stretch stiffness, N/m. fitted: guess, of the small strains of wearing; of the first five on the house data. Soft for
/// denim and leather, whose true stiffness would only slow the solver down;
/// bend stiffness, N m, of the hinges, which make cloth 2.8 times as stiff (FabricTrials in fabric_test): of cotton what
/// it always was; of denim, jersey, silk and wool literature, [kawabata_1980_hand]: 2.8 times as much is in the ranges
/// of its bending test, where 1 gf cm^2/cm is 9.8e-5 N m. Of leather derived: its drape coefficient is that of
/// [memon_2021_leather]. Of the others a guess;
/// friction, static, on skin and on cloth. literature: of cotton the middle of the parts of the body of
/// [temel_2022_skin], .31 on the forearm to .90 on the chest; of swimwear and tulle that of nylon on skin, .37, rounded
/// [zhang_1999_skin]. fitted: guess, of the others: of silk as of nylon, of the rest as of cotton;
/// largest stretch. literature: of fleece a firm knit, of jersey between a moderate and a stretchy one, of swimwear a
/// stretchy one [joseph_armstrong_2010_patternmaking]; of stretch_woven the lower end of comfort stretch
/// [kirk_1966_extensibility]. fitted: guess, of the others: of plain woven cloth a little more than the 12 % from which
/// [astm_d3107] speaks of stretch fabrics, as seams and flesh give, too;
/// strain limit. fitted: of woven cloth the table of docs/decisions/0013-strain-limiting.md, three pairs of the house
/// data, by the largest stretch and by whether the body reaches its place. Of what gives more a guess: half more than
/// it gives when worn;
/// thickness, m. fitted: guess, of leather the middle of [memon_2021_leather];
/// weft to warp. literature: [wang_2011_cloth], which measured two plain weaves (0.97, 0.98), denim with elastane (0.21),
/// three jerseys (0.3, 0.4, 0.6), a rib (0.4), a sweat (0.35) and a swimsuit's knit (0.45). fitted: guess, of denim without
/// elastane, wool, silk, leather and tulle;
/// shear stiffness, N/m. literature: the same, of plain weaves (19 to 120), denim (53 to 84), jersey (14 to 63), rib (3 to
/// 83), sweat (4 to 47) and swimsuit (9 to 61), where it changes with the strain; of wool [kawabata_1980_hand]. fitted:
/// guess, of silk and tulle, and of leather, which is taken to be alike in all directions.
inline constexpr NamedMaterial k_fabrics[] = {
    { "cotton", { 0.2, 400, 2e-5, 0.6, 0.15, 0.4, 4e-4, 1, 60 } },
    { "denim", { 0.4, 800, 3.3e-5, 0.6, 0.15, 0.4, 8e-4, 0.6, 70 } },
    { "jersey", { 0.17, 150, 1.7e-6, 0.6, 0.35, 0.525, 5e-4, 0.4, 37 } },
    { "silk", { 0.07, 300, 1.2e-6, 0.4, 0.15, 0.4, 2e-4, 1, 30 } },
    { "wool", { 0.25, 400, 5e-6, 0.6, 0.15, 0.4, 6e-4, 0.7, 40 } },
    { "stretch_woven", { 0.3, 300, 1.7e-5, 0.6, 0.25, 0.4, 6e-4, 0.22, 70 } },
    { "rib", { 0.22, 100, 2.5e-6, 0.6, 0.5, 0.75, 1e-3, 0.4, 37 } },
    { "fleece", { 0.28, 250, 8e-6, 0.6, 0.18, 0.4, 2e-3, 0.35, 35 } },
    { "swimwear", { 0.19, 200, 1.7e-6, 0.4, 0.5, 0.75, 6e-4, 0.45, 45 } },
    { "leather", { 0.5, 800, 9e-6, 0.6, 0.12, 0.4, 8e-4, 1, 300 } },
    { "tulle", { 0.03, 100, 4e-7, 0.4, 0.25, 0.4, 3e-4, 1, 20 } },
};

// ---- elastic energy (cloth_energy) ---------------------------------------------------------------------------------

/// Fraction of the mean area of a hinge. A smaller hinge bends as one of this area. Its stiffness is proportional to
/// 1 / area, so details of a millimetre kept the orientation that they had turned to, against the springs.
/// fitted: three garments of the house data were held back by micrometres, and single details torn, without it.
inline constexpr double k_least_hinge_area = 0.5;
/// How many times as stiff an edge is beyond the strain limit of its fabric.
/// fitted: the table of docs/decisions/0013-strain-limiting.md, three pairs of the house data, by the largest stretch
/// and by whether the body reaches its place. Ten times as stiff holds fast what lies folded in a trouser leg or a
/// cuff.
inline constexpr double k_strain_limit_stiffness = 5;

// ---- time steps (cloth_motion) -------------------------------------------------------------------------------------

/// m. No cloth vertex goes further in a time step.
/// fitted: guess, on the house data.
inline constexpr double k_largest_cloth_move = 4e-3;
/// m. No obstacle vertex goes further towards its target in a time step.
/// fitted: guess, on the house data.
inline constexpr double k_largest_obstacle_move = 3e-3;
/// s, of implicit Euler.
/// fitted: guess, on the house data.
inline constexpr double k_cloth_time_step = 0.02;
/// Stiffness of contact, in stretch stiffnesses of the cloth, while something is held back. A larger one pushes harder
/// and takes longer to balance.
/// fitted: guess, on the house data, by the parts of the body that cloth holds back.
inline constexpr double k_pushing_contact_stiffness = 6;
/// The same once nothing is held back. A tight garment then still enters the contact distance by less than a
/// millimetre, and forces balance in half the steps.
/// fitted: on a sheet at rest on a ball, by the weight it presses with (93 % instead of 52 %), and on the house data.
inline constexpr double k_settling_contact_stiffness = 1;
/// Iterations of conjugate gradients in a time step: while the body moves, and while the cloth settles.
/// fitted: guess, on the house data.
inline constexpr int k_moving_iterations = 6, k_settling_iterations = 18;
/// Iterations between two updates of the active set. Updated in each one, it changes to and fro and nothing converges.
/// fitted: better than 1 on the house data, by the seconds; otherwise a guess.
inline constexpr int k_active_set_period = 3;
/// Contact distances. Pairs up to this far apart may come into contact while a time step is solved.
/// fitted: guess, on the house data.
inline constexpr double k_active_distance = 1.6;
/// Mean edges of the cloth. The contact distance between cloth and cloth is at most this; otherwise neighbours within
/// one smooth sheet, whose number grows with the square of the vertices, are most of the pairs.
/// fitted: guess, by the seconds of one coat at six resolutions.
inline constexpr double k_self_contact_edges = 0.3;
/// Fraction of the margins that a search for pairs adds to them round vertices that hardly move, so that its pairs last for
/// several steps near rest. Decides seconds, and results only by the order of sums.
/// fitted: CPU time of the search for rest, .375, 1 and 2, where a search was of all vertices: on one coat of the house data
/// 19.4, 17.9 and 21.8 s; on a jacket with .375, .7 and 1: 6.2, 5.5 and 5.1 s.
inline constexpr double k_spare_margin = 1;
/// Share of its spare margin that a vertex goes in one detection, from which on it gets next to none, as that would serve
/// but once; and what it gets, so that a move that is cut, by rounding or by zones, stays in the region of the whole.
/// derived: where a search costs as the square of its margins, it pays to let it serve twice below sqrt(2) - 1.
/// fitted: guess, of the other.
inline constexpr double k_spare_used_up = 0.41, k_spare_of_fast = 0.1;
/// Fraction of the velocity that a settling time step keeps: first it lets the cloth swing, then come to rest; and the
/// fraction of the settling steps at which it changes.
/// fitted: guess, on the house data.
inline constexpr double k_swinging_velocity = 0.9, k_calming_velocity = 0.3, k_swinging_steps = 0.7;

// ---- the search for rest (rest_search, friction_anchors, tangent_factor) ---------------------------------------------

/// s. The inertia of such a time step is all that resists motion there: next to nothing.
/// fitted: guess; 1 s takes as many moves on one coat of the house data.
inline constexpr double k_rest_time_step = 0.5;
/// m; the depth within which contact grows to its stiffness. Without it the forces on a vertex whose weight is half a
/// millinewton jump by hundreds of times that when it touches.
/// fitted: one coat of the house data, 0, .5 and 2.5 mm, by the residual after 200 moves: .56, .11 and .18 of a weight.
inline constexpr double k_contact_softening = 1e-3;
/// m^2, of cloth whose contact has its stiffness there, about a vertex of clothes of 10,000 vertices: in proportion to
/// the area, pressure enters the contact distance by the same depth on any mesh.
/// fitted: guess; against the same stiffness for each contact, a vest of 22,000 vertices takes 209 moves instead of 558,
/// a shirt of the house data 374 instead of 419, a coat 480 instead of 441.
inline constexpr double k_contact_area = 1e-4;
/// Kinetic friction as a share of static friction.
/// literature: cotton on skin, .25 of .31 on the forearm and .79 of .90 on the chest [temel_2022_skin]; the lower.
inline constexpr double k_kinetic_friction = 0.8;
/// Share of its stiffness across its slip that a sliding contact has along it, where it has none in truth.
/// fitted: guess, on one shirt of the house data: with .2 as with .05 forces fall as fast, with .01 they rose again.
inline constexpr double k_sliding_stiffness = 0.05;
/// m. No vertex goes further in one move; then all go the same share of their way.
/// fitted: guess, on one coat of the house data.
inline constexpr double k_largest_rest_move = 0.01;
/// Moves from one factor to the next; and the residual (a tenth of the 99th percentile, here and below) beyond which each
/// has its own, as contacts change too much.
/// fitted: guess; with every third from the start on, a jumpsuit of the house data was given up as hopeless.
inline constexpr int k_factor_period = 3;
inline constexpr double k_far_contacts = 0.5;
/// Steps of a move at most; the share of the forces, in the norm of the factor, that need not be balanced; and m, the way
/// of a vertex from where contacts were found beyond which a move ends.
/// fitted: nine pairs of the house data, 8, 12 and 20 steps, .05, .1 and .2 of the forces: within 5 % of CPU time, but
/// with .05 a shirt crept on for 400 rounds. 2, 3, 5 and 10 mm on six of them: 5 takes least.
inline constexpr int k_most_steps = 12;
inline constexpr double k_forces_left = 0.1;
inline constexpr double k_reach_of_contacts = 5e-3;
/// Where the forces after a move are this many times what its steps foretold, contacts have changed, and the next may take
/// half as many steps, but these at least; else twice as many.
/// fitted: four pairs of the house data, 2 and 4 times, 2 and 3 steps: a suit takes 42, 57 and 70 s of CPU time, and 78
/// with twelve steps always; the others as long within 20 %.
inline constexpr double k_foretold = 2;
inline constexpr int k_least_steps = 2;
/// Share of the normal force before that friction keeps.
/// fitted: six pairs of the house data, 0 and .5: moves take 1.12 times as long without.
inline constexpr double k_kept_normal_force = 0.5;
/// Share of the way from the minimum distance to where contact begins, within which a force grows without bound; and the
/// share of that zone where it grows no further.
/// fitted: guess: a jumpsuit, an outfit of two layers and a suit of the house data, whose searches ended in jams of 131,
/// 158 and 5.8 weights, come to rest, the jumpsuit and the suit not from every start.
inline constexpr double k_barrier = 1. / 3, k_least_barrier = 1e-3;
/// Minimum distances. What lies nearer comes to stop motion, so it is in contact in any case, if only from there on:
/// otherwise the cut of motion carries a load that no force balances.
/// fitted: guess, on the same clothes.
inline constexpr double k_blocking_distance = 2;
/// Columns of a front that may always grow by the zeros of a child, and the share of zeros in any other.
/// fitted: guess; decide seconds, and results only by the order of sums.
inline constexpr int k_small_front = 8;
inline constexpr double k_front_zeros = 0.2;
/// Share of all work that a subtree of fronts has at most which is computed as a whole.
/// fitted: guess; decides seconds only.
inline constexpr double k_subtree_work = 0.02;
/// Work of the forces along a step after it, in that before it, beyond which it went too far; and how often it is cut at
/// most.
/// fitted: guess; .6 does as well on six pairs of the house data.
inline constexpr double k_overshoot = 0.3;
inline constexpr int k_most_cuts = 8;
/// Moves in a round, after which friction lets go of what slides, and in all.
/// fitted: guess, on one coat of the house data, which takes 310.
inline constexpr int k_most_round_moves = 100, k_most_rest_moves = 600;
/// Residual with which the first round ends: its friction is too weak anyway.
/// fitted: on one coat of the house data, 196 moves instead of 304; a jacket takes as many as before.
inline constexpr double k_enough_at_first = 0.5;
/// Residual beyond which a search whose forces fall too slowly is given up.
/// fitted: guess; after two rounds the twelve pairs of the house data have at most 1.2, where they still travel to better
/// places. By the mean, a suit and a dress of strangers that pass through themselves had 28,000 and 3,000; but an outfit
/// of two layers with a few jammed vertices had 1,260, and came to rest after all.
inline constexpr double k_far_from_balance = 100;
/// m. Contacts are found anew where a vertex has gone further. Found in each move, they changed to and fro, and a shirt
/// of the house data never came to rest.
/// fitted: that shirt, and three more of the house data: .1 and .3 mm take about as many moves.
inline constexpr double k_contact_reach = 3e-4;
/// Minimum distances. Sheets that lie closer at rest are pushed this far apart: cut to its collision-free part, no motion
/// of what lies at the minimum distance would balance anything.
/// fitted: an outfit of two layers of the house data, 0 and 3, by the residual: 12 and .26 of a weight.
inline constexpr double k_least_gap = 3;
/// m. Cloth stands still from one round to the next where this share of the vertices goes no further, and none further than
/// the other length.
/// fitted: one coat of the house data, .1 and .03 mm, by what 30 s more move at most: 5.8 and .3 mm. The share and the
/// other length are guesses, on the same coat and a jumpsuit, of which a vertex or two went to and fro by .04 to .15 mm
/// for hundreds of moves.
inline constexpr double k_still = 3e-5, k_share_still = 0.999, k_nearly_still = 3e-4;
/// Cloth that stands still is pushed on by so many times its drift over so many rounds at most, but no vertex further than
/// that, m; where it comes to stand nearer than that, m, to where it was, it is at rest; pushes at most.
/// fitted: six pairs of the house data, by what 30 s more move at most, and by the moves: 10 times, 2 mm: 8.4 mm, 952; 20
/// times, 2 mm: .9 mm, 1,027; without any: 8.5 mm, 911. The rounds, the length and the most pushes are guesses.
inline constexpr double k_push_of_drift = 20, k_longest_push = 2e-3, k_back = 2e-3;
inline constexpr int k_rounds_of_drift = 3, k_most_pushes = 3;

// ---- waiting for what cloth holds back (cloth_motion) ---------------------------------------------------------------

/// A step that leaves less than this fraction of the distance to the target counts as progress.
/// fitted: guess, on the house data.
inline constexpr double k_progress = 0.95;
/// Steps without such progress after which the motion counts as stalled.
/// fitted: guess, on the house data.
inline constexpr int k_stall_steps = 15;
/// The most motions of the obstacle alone, the most steps until the obstacle is at its target, and the most settling
/// steps beyond those asked for.
/// fitted: guess, on the house data.
inline constexpr int k_most_obstacle_motions = 20, k_most_converging_steps = 30, k_most_extra_settling_steps = 60;

// ---- collision-free steps (proximity, collision_free_step) ----------------------------------------------------------

/// Fraction that a motion must leave of what a distance exceeds the minimum by. Where it is small, cloth that comes
/// straight at other cloth is pinched at once, and caught there; where it is large, everything takes more motions.
/// fitted: guess, on clothes of strangers that get caught (docs/decisions/0056-half-a-distance.md).
inline constexpr double k_kept_above_minimum = 0.5;
/// Fraction that a motion must leave of a distance below the minimum.
/// fitted: guess, on the house data.
inline constexpr double k_kept_below_minimum = 0.9;
/// The same of a distance below k_rounding_zone minimum distances, so that rounding never decides on which side a
/// vertex is: see "Rounding" in docs/cloth.md for how many motions that lasts.
/// fitted: guess, on the house data.
inline constexpr double k_kept_in_rounding_zone = 0.999, k_rounding_zone = 0.01;
/// Rounds in which step fractions are lowered. Then the vertices of a pair that still collides stand still.
/// fitted: guess, on the house data.
inline constexpr int k_most_fraction_rounds = 30;
/// The fractions of a pair that collides fall at least to this fraction in a round, so that rounds stay few.
/// fitted: guess, on the house data.
inline constexpr double k_least_cut = 0.9;
/// A pair that cannot go this fraction of its displacement is merged into one rigid impact zone.
/// fitted: guess, on the house data.
inline constexpr double k_zone_free_fraction = 0.9;

// ---- untangling (untangle) ------------------------------------------------------------------------------------------

/// Rounds of untangling, and rounds without fewer crossings than ever before after which it has stalled.
/// fitted: guess, on the tangled garments of the house data, by the crossings left.
inline constexpr int k_untangle_rounds = 300, k_untangle_stall_rounds = 60;
/// Mean edges of the tangled cloth: the longest move of a vertex in one round, and how far round a tangle cloth moves.
/// fitted: guess, on the tangled garments of the house data, by the crossings left.
inline constexpr double k_untangle_step = 0.3, k_untangle_reach = 5;
/// Length of the contour gradient at which a push is 0.7 of the longest: the g0 of [volino_2006_contours].
/// fitted: guess, on the tangled garments of the house data, by the crossings left.
inline constexpr double k_untangle_gradient = 1;
/// Passes that smooth the motion over the edges, and the weight of the neighbours in each: a tangle moves as a piece of
/// cloth and not vertex by vertex.
/// fitted: guess, on the tangled garments of the house data, by the crossings left.
inline constexpr int k_untangle_smoothing_passes = 4;
inline constexpr double k_untangle_smoothing = 0.5;
/// Rings of edges about cloth that is put back, over which the motion fades in. fitted: guess
inline constexpr int k_untangle_blend_rings = 4;

// ---- preconditioner (single_precision_factor) -----------------------------------------------------------------------

/// Branches that triangular solves run side by side, whatever the number of threads, and subtrees that are dealt out to
/// each at least. Decides seconds, and results only by the order of sums.
/// fitted: guess, by the seconds on two threads.
inline constexpr int k_factor_branches = 8, k_subtrees_per_branch = 4;

// ---- crossings that the cloth was given with (given_crossings.cpp) ---------------------------------------------------

/// Share of the garment's diagonal. Sheets that lay no further apart lay on each other. fitted: guess, on a T-shirt, a shirt
/// and a jacket of doubled sheets, of 1.2 to 1.4 m, whose curves went on over places 0.5 to 1.1 mm apart
inline constexpr double k_shifted_gap = 1.5e-3;

}  // namespace garmentfit
