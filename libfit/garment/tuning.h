// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Fitted numbers of garment analysis.
//
// Units  m is metres on a body of human size. Girths are lengths around, in metres unless they are shares.
// Data   "garments": the garments of the house data and closed, cut and turned copies of them. Score: number of
//        garments with the correct type, the correct sides outwards, or the correct vertical axis.
// A number "fitted: guess" was tried by hand on these data, without a record of the score. No script fits them again.

#include <array>
#include <cstddef>

namespace garmentfit::garment_tuning {

// ---- openings and their tubes (garment_openings.cpp) --------------------------------------------------------------

/// fitted: guess, on the garments. Girth as a share of the garment's diagonal: a cuff has 0.12, a buttonhole 0.03.
inline constexpr double k_smallest_girth = 0.07;
/// fitted: guess, on garments of strangers. m, girth below which no hand passes: a child's wrist has 0.12, a slit at a
/// seam 0.08.
inline constexpr double k_narrowest_girth = 0.1;
/// fitted: guess. Share of the vertices of a border that are sewn on a larger piece: from here on it is no opening. A
/// flap has a quarter at its seam.
inline constexpr double k_sewn_on = 0.2;
/// fitted: an opening without a tube is a hole below this girth, as a share of the diagonal. Of 532 openings of the
/// house, the catalogue and the wild data, the narrowest ones without a tube have 0.26 (necks, armholes); twelve holes
/// in eight clothes of web shops have 0.07 to 0.17.
inline constexpr double k_widest_hole = 0.2;
/// fitted: likewise, or below this width as a share of the length. The openings have 0.36; a slit between pleats and
/// two of pockets have 0.14, 0.12 and 0.11.
inline constexpr double k_slit_roundness = 0.25;
/// fitted: guess, on the slit between a shirt with a collar and one that is modelled in its neck, .46 diagonals round,
/// with .16. Of 553 openings of 150 garments those as short have .28 or more, where no tube leads to them. Girth in
/// diagonals, area over that of a circle of the same girth.
inline constexpr double k_longest_slit = 0.6, k_bent_slit_roundness = 0.22;
/// fitted: likewise, on the openings above. Slices of the tube, below which there is none: cuffs that narrow have 11,
/// the holes 1 to 5, for the cloth around them widens.
inline constexpr double k_shortest_cuff = 7;
/// fitted: guess. Width of a tube's slices as a share of the garment's diagonal: two or three edges.
inline constexpr double k_slice = 0.02;
/// fitted: guess, on the garments. A tube ends where its girth exceeds the median of its slices by this factor.
inline constexpr double k_tube_widening = 1.5;
/// fitted: guess, of .3 to .6: the spread of the distances between the arms of 140 garments, and two sweaters of a web
/// shop whose cuffs are half as wide as their sleeves. Girth of an arm's or a leg's cloth as a share of the garment's
/// diagonal, below which it does not end a tube.
inline constexpr double k_widest_limb = 0.45;
/// fitted: guess. Number of slices of a hem, which may be turned in or gathered. They neither end a tube nor count as
/// its waist.
inline constexpr std::size_t k_hem_slices = 3;
/// fitted: guess, on the garments. Cosine between one opening and the mirror image of another: cloth that hangs is not
/// symmetric.
inline constexpr double k_facing_alike = 0.7;

// ---- closed ends (closed_ends.cpp) --------------------------------------------------------------------------------

/// fitted: guess, by the caps found in open garments, of which there should be none. Girth of a cap as a share of the
/// garment's diagonal: a cuff has 0.12, a facet between folds less.
inline constexpr double k_cap_girth = 0.1;
/// fitted: likewise. Cosine between the normals of neighbours in a cap: 20 degrees.
inline constexpr double k_flat_cosine = 0.94;
/// fitted: likewise. Sine between a cap and the cloth at its outline, 50 degrees, and share of the outline that is as
/// steep.
inline constexpr double k_steep_sine = 0.77, k_cap_outline = 0.9;
/// fitted: likewise. Area of a cap, as a share of a disc of the same girth: a flattened cuff has 0.4.
inline constexpr double k_cap_roundness = 0.2;
/// fitted: likewise. Depth of a cap, and of a fan, as a share of the root of its area: hems are not flat.
inline constexpr double k_cap_depth = 0.05, k_fan_depth = 0.35;
/// fitted: guess, on a skirt of a game, two of whose pleats, from rim to rim one triangle each, have 0.08. Share of a
/// cap's outline where there is no cloth.
inline constexpr double k_cap_border = 0.05;
/// fitted: guess. Faces that close a hole among others, at least, as a fan or from rim to rim: vertices of cloth have
/// up to 12.
inline constexpr std::size_t k_fan_faces = 16;
/// fitted: guess. Cosine between each face of a fan and the whole. A corner of a cap has faces of the tube, too.
inline constexpr double k_fan_cosine = 0.5;
/// fitted: guesses, on eleven ends of six clothes of an avatar maker and of a viewer. Faces of a fan that is sunk into
/// its tube, at least (12 to 28), and its area as a share of a disc of the same girth (.71 to .97). Depth, as a share of
/// the root of its area: at most (.96), and that of the middle below the rim, at least (.13 to .93).
inline constexpr std::size_t k_funnel_faces = 12;
inline constexpr double k_funnel_roundness = 0.6, k_funnel_depth = 1.2, k_funnel_sunk = 0.1;
/// fitted: likewise. Vertices as far from the middle of the rim, in girths, are the cloth around, and at least this
/// share of them is on the side to which the fan is sunk (.68 to 1).
inline constexpr double k_funnel_reach = 0.5, k_funnel_inside = 0.65;
/// fitted: guess. Sum over the outline of a cap, signed by the side on which the cloth around it is, as a share.
inline constexpr double k_fan_outline = 0.6;
/// fitted: guess, on two T-shirts and trousers whose openings were filled. Edges in a filled hole, from rim to rim, and
/// at its rim, over the median edge of the garment.
inline constexpr double k_fill_edge = 4, k_ear_edge = 1.3;
/// fitted: guess, on two clothes of web shops, coarse facets of which, of one and two faces, were taken for such holes.
/// Faces of a hole that is filled from rim to rim, at least: no end of cloth is a square.
inline constexpr std::size_t k_fill_faces = 4;
/// fitted: guess, on the openings of six generated tops. Depth of a filled hole of a garment without any opening, as a
/// share of the root of its area: crumpled cuffs have up to 0.6.
inline constexpr double k_fill_depth = 0.7;
/// fitted: guess, between 0.67, the most of regions of that kind in the cloth of 57 clothes of web shops and 152
/// others, and 0.85, the least of four filled necks and hems. Area of a filled hole of cloth with other openings, as a
/// share of a disc of the same girth; it has at least as many faces as a fan.
inline constexpr double k_fill_roundness = 0.75;
/// fitted: guess. Caps of one patch, above which they are none: a jumpsuit has six, neck and hem included; coarse
/// clothes of web shops have 22 and more flat facets.
inline constexpr std::size_t k_most_ends = 8;
/// derived: caps of a closed surface from which on it is opened: a cylinder and a pillow have two, a skirt as well.
inline constexpr std::size_t k_least_ends = 3;

// ---- hollows in which tubes end (hollows.cpp) ---------------------------------------------------------------------

// fitted: guesses, on six clothes of web shops that are closed by cloth modelled all the way round, with 21 such ends,
// and on 43 garments of the catalogue, closed by bowls of .08 and .25 of the girth of each opening: of 308 ends 275 are
// found, and 64 false ones; of 300 of the 43 other garments 255, and 97 false ones. Lengths are shares of the garment's
// diagonal, areas of its square.

/// Spread of the mean direction: half a cuff. Cosine between it and a face of a floor, at least.
inline constexpr double k_hollow_blur = 0.03, k_hollow_floor = 0.2;
/// Heights over the surface at which a place is tried: a floor may lie less than a centimetre deep, or be bumpy.
inline constexpr std::array<double, 3> k_hollow_heights { 0.004, 0.012, 0.03 };
/// Area of a floor, without what rises at its rim, and of the hollow up to the rim: a cuff of 0.12 has 0.001 and 0.004.
inline constexpr double k_least_floor = 0.0005, k_least_hollow = 0.003;
/// Rays across the axis, of 24, that may go out: somewhere in a floor, elsewhere in it, and in what belongs to its
/// hollow. With 1 in place of 4 a neck that is lower in front is missed.
inline constexpr int k_rays_out_of_deep_floor = 1, k_rays_out_of_floor = 4, k_rays_out_of_hollow = 10;
/// Cloth has its other side as near behind it, more than the thickness of a wrap, and as parallel.
inline constexpr double k_hollow_backing = 0.04, k_hollow_back_cosine = 0.85;
/// How far a hollow reaches beyond three radii of its floor.
inline constexpr double k_hollow_reach = 0.05;
/// Length of the solid behind a floor over its width: ends have 1 to 10, folds of a jacket's front 0.3 to 0.4 and 1.1
/// between its lapels, a crotch up to 1.2.
inline constexpr double k_hollow_length = 1.3;
/// Share of the places of a floor behind which the solid is shorter: behind a waist the crotch is near, beside it the
/// legs go on. With .5 in its place 251 of those 308 ends are found and 53 false ones, of the 300 others 230 and 85;
/// with .8 of the 308 281 and 80.
inline constexpr double k_hollow_chord = 0.65;
/// Smallest spread of a hollow over its largest, and its area over that of a disc as wide as the solid behind it. A
/// tenth of the ends have less, and half of what is none.
inline constexpr double k_hollow_roundness = 0.35, k_hollow_share = 0.2;
/// Hollows that fill most of the solid's cross-section close shorter tubes, too. fitted: guess, on solids made from
/// pictures: a T-shirt's short sleeves, 1.24 long, have .58 and .75, its folds up to .26 and pits between pockets .35.
inline constexpr double k_filled_share = 0.5, k_filled_length = 1;
/// Share of a hollow that is its floor. fitted: guess, likewise: ends have .3 to .9, folds beside sleeves .02 to .15;
/// but deep hollows that fill the cross-section have less.
inline constexpr double k_hollow_bottom = 0.15;
/// Share of the cross-section below which a hollow beside all ends of a garment is a fold. fitted: guess, likewise,
/// between .25 and a neck's .33.
inline constexpr double k_narrow_share = 0.3;
/// Flat ends without a hollow. fitted: guesses, on a T-shirt made from a picture. Cosines: between the mean direction
/// and the surface where such an end is looked for, between its axis and its faces, and those behind its edge; how
/// near to the outline these are, and the share of it where they are; share of the cross-section, least (.38 and .39
/// at cuffs) and most (1.79 at the hem): the rims of hollows are thin, and much longer.
inline constexpr double k_flush_flat = 0.95, k_flush_facing = 0.8, k_flush_steep = 0.35, k_flush_edge = 0.03,
                        k_flush_outline = 0.9, k_flush_least = 0.3, k_flush_most = 2.2;
/// rad: directions tried behind a floor that is not level. Depth at which the width is measured.
inline constexpr double k_hollow_tilt = 0.7, k_hollow_depth = 0.05;
/// Cosine between the axis and places from which is measured, and how many these are.
inline constexpr double k_hollow_facing = 0.7;
inline constexpr std::size_t k_hollow_samples = 40;

/// Two hollows that are a pair of cuffs (hollow_ends.cpp): ratio of their areas, cosine between one's axis and the
/// mirror image of the other's, and between it and the line across, and how far the cloth goes on beyond them, as a
/// share of that line. fitted: guess, between three shirts of web shops and 24 skirts and strapless dresses of the
/// catalogue; cuffs of arms that hang 20 degrees from the vertical have 0.34 between axis and line.
inline constexpr double k_pair_areas = 1.25, k_pair_mirrored = 0.9, k_pair_outwards = 0.25, k_pair_beyond = 0.1;
/// A hollow that lies in an opening: distance from its middle, as a share of its girth; a hem that is folded inwards
/// shows one. fitted: guess, derived from a round opening's radius of 0.16.
inline constexpr double k_in_opening = 0.2;

// ---- necks that are filled flush (shut_neck.cpp) ------------------------------------------------------------------
// fitted: guesses, on a sweater and a T-shirt made from pictures.

/// rad: how far the faces of a patch may look from its axis, from a narrow limit to a wide one; and by how much a patch
/// that a crease holds grows from one limit to the next. A smooth dome grows by 1.4 and more.
inline constexpr std::array<double, 6> k_neck_angles { 0.25, 0.4, 0.55, 0.7, 0.85, 1.0 };
inline constexpr double k_neck_growth = 1.25;
/// Cosine between the trunk's axis and the neck; how far off the middle it is, as a share of the distance of the
/// sleeves; how high its place is, as a share of the trunk's height.
inline constexpr double k_neck_facing = 0.4, k_neck_off_middle = 0.06, k_neck_height = 0.75;
/// Its least and largest area as shares of the hem's; its smallest spread over its largest; its area over that of an
/// ellipse of the same spreads.
inline constexpr double k_neck_least = 0.04, k_neck_most = 0.8, k_neck_roundness = 0.45, k_neck_filled = 0.85;
/// Sleeves and hem of such a top: how far off the middle of the sleeves the hem is, as a share of their distance; cosine
/// between the hem's axis and the sleeves', which of trousers' legs and waist is near -1.
inline constexpr double k_hem_off_middle = 0.1, k_sleeves_with_hem = -0.5;

// ---- lids and fillings (lids_and_fillings.cpp) --------------------------------------------------------------------

/// fitted: guess, on three solids in clothes of web shops (0.13 to 0.5; a padded panel has 0.005), which no garment of
/// the catalogues has. Volume of a filling as a share of the box around all. Share of the diagonal by which it may
/// reach out of the box of the cloth.
inline constexpr double k_filling = 0.05, k_filling_margin = 0.05;
/// fitted: guess, on a jacket with a speck of 6 mm 11 cm behind its front. Length of the largest speck and its least
/// distance from cloth, as shares of the diagonal: 4 and 2 cm at a jacket, more than buttons, sequins and badges have.
inline constexpr double k_speck_size = 0.03, k_speck_gap = 0.02;
/// fitted: guess, on a T-shirt before a backdrop of four times its size. Least extent of a backdrop by its largest, and
/// its least diagonal by that of what is none: smaller flat pieces may be prints, labels or lids.
inline constexpr double k_flat_backdrop = 1e-3, k_backdrop_size = 1.5;
/// Of smaller ones that lie apart from all else, such as shadows on the floor: least distance, as a share of the diagonal
/// of all else, and least extents by its along the same axes. fitted: guess, on a woman's top above its shadow (0.05;
/// 0.6 and 2.6)
inline constexpr double k_floor_gap = 0.01, k_floor_size = 0.5;
/// fitted: guess, on six lids of three clothes of web shops. Lengths as shares of the mean of the half extents:
/// smallest width as a share of the length, largest depth, area as a share of the rectangle around (an ellipse has
/// 0.79); vertices beyond this share of the half extents are at the rim.
inline constexpr double k_lid_roundness = 0.3, k_lid_depth = 0.3, k_lid_cover = 0.6, k_lid_rim = 0.6;
/// fitted: likewise. The rim is nearer to the cloth than this, for this share of its vertices; the middle is farther,
/// in half widths. Share of the cloth near the rim, by its area, that is as steep as at a cap: a neck has 0.67.
inline constexpr double k_lid_reach = 0.15, k_lid_outline = 0.9, k_lid_middle = 0.5, k_lid_steep = 0.5;
/// fitted: guess, on one file of two shirts, 0.09 diagonals apart, one of which is 0.8 as large. A garment that stands
/// beside another: gap as a share of the diagonal round both, least size as a share of the other's diagonal, and how
/// much of the lower one's height they share.
inline constexpr double k_beside_gap = 0.02, k_beside_size = 0.5, k_beside_overlap = 0.5;
/// fitted: guess, on two crumpled cuffs of a web shop, 0.3 and 0.45. Largest depth of a lid of many triangles from rim
/// to rim.
inline constexpr double k_filled_lid_depth = 0.6;

// ---- outward orientation (outward_cloth.cpp) ----------------------------------------------------------------------

/// fitted: on the garments. Volume / area^1.5 of a patch: a sphere has 0.094, a sleeve 0.03, a pocket 0.002.
inline constexpr double k_flat_patch = 0.01;
/// fitted: guess, on few. Largest distance between the two sheets of cloth with thickness, padding included, as a share
/// of the root of the area of both: of eight closed garments with tunnels seven have 0.001 to 0.005, and padded shorts
/// 0.024. Two sheets of a skirt, folded flat, would have more than 0.05.
inline constexpr double k_thickest = 0.03;
/// fitted: guess. m, distance on both sides of a flat patch at which the winding number is compared.
inline constexpr double k_side_step = 0.02;

/// Diagonals of the box: an armhole that a strap in a ring parts from the neck is no shorter round. guess; a camisole's
/// is 1.0 long, what the buckle of a skirt's belt would part .5
inline constexpr double k_strap_border = 0.7;

/// fitted: guess. Share of the garment's area that panels with thickness have: from here on it is in parts. Straps and
/// labels stay below.
inline constexpr double k_panel_share = 0.1;
/// derived: length of the slits of a closed panel over the root of its area, both sheets. One sheet alone has a border
/// of 3.5 and more, a disc's.
inline constexpr double k_longest_slits = 1.75;
/// fitted: of 152 garments of the house, the catalogue and the wild data, which are no such ones, trousers of 17 pieces
/// have 9.5 diagonals of border, and the next one 5.8; four clothes of web shops have 11 to 25. Diagonals.
inline constexpr double k_longest_borders = 10;
/// Girth, in diagonals, and roundness of the border of an opening, beyond which it is a crack. fitted: a guess between
/// 3.4, the most of 87 garments of the house, the catalogue and the wild data, and 7.7, of one polo shirt of a shop;
/// three others of a shop, with 4.7 to 18, are wrapped for other reasons.
inline constexpr double k_longest_opening = 5, k_roundest_crack = 0.1;
/// fitted: guess, on one shirt of a web shop, whose cuffs have .2 and .3. Distance of two borders that lie in each
/// other, and length of the tubes that lead to them, in radii of the shorter one. Of 88 other clothes of shops that
/// are not in parts, the nearest two without a tube are .9 apart.
inline constexpr double k_doubled_rims = 0.5, k_doubled_tube = 0.7;
/// fitted: guess, on two clothes of shops whose sheets are not joined at the hem, .02 and .14 apart; of 190 garments
/// the nearest two others that face each other are .5 apart, with unlike girths, and of those without thickness 1.2.
/// Distance of two borders at one place in radii, and cosine between one's facing and the opposite of the other's.
inline constexpr double k_opposed_rims = 0.25, k_opposed_facing = 0.9;
/// fitted: guess, on seven clothes of web shops: with a sixtieth, trousers are sealed at their hems. Shares of the
/// diagonal: the wrap spans what is narrower than about twice the first, and keeps the second off the cloth.
inline constexpr double k_garment_wrap = 0.0115, k_garment_wrap_offset = 0.0025;
/// Openings with which the inner sheet of a wrap has all that count, as many as trousers. fitted: of 64 clothes of web
/// shops, the inner sheet has the three of trousers or the four of a top in 47, the outer one in 39; in four the inner
/// one is closed, at cuffs for example, where the outer one is open.
inline constexpr std::size_t k_enough_openings = 3;
/// Diagonals of border beyond which an inner sheet is ragged. fitted: a guess between 3.7, the most of 50 of the same
/// wraps that are clean, and 4.2 to 9.7, of ten with pleats and frills.
inline constexpr double k_longest_sheet_borders = 4;

// ---- outer sheet (outer_sheet.cpp) --------------------------------------------------------------------------------

/// fitted: guess, on the garments. Thicknesses: the other sheet is closer than this. Along a rim the next cloth is
/// farther away.
inline constexpr double k_backing = 3;
/// fitted: guess, on a coarse hoodie of a shop, whose sheets pass through each other. 1 - cosine between neighbours in
/// a smooth region, 45 degrees; how far the share of one of two sheets in the area of both is from a half.
inline constexpr double k_smooth_region = 0.3, k_half_of_sheets = 0.2;
/// fitted: guess, on the garments. Share of the sheet's area: a smaller connected part is a strip of a rim or a fold.
inline constexpr double k_small_part = 0.05;
/// fitted: guess, on the garments. Cosine between two faces: below it the face behind is not the other sheet.
inline constexpr double k_back_cosine = 0.5;

// ---- vertical axis (way_up.cpp) -----------------------------------------------------------------------------------

/// fitted: guess, on the garments. rad: a worn garment's axes deviate from the vertical by up to 15 degrees.
inline constexpr double k_nearly_along = 0.26;
/// fitted: guess. rad: smallest angle between two axes that are both tried.
inline constexpr double k_apart = 0.17;
/// fitted: guess. Ratio of girths of two sleeves or two legs.
inline constexpr double k_twin_girths = 1.4;
/// fitted: guess. Smallest distance between two sleeves or legs, in girths.
inline constexpr double k_twin_distance = 0.5;
/// fitted: guess. Share of the largest distance between openings: a shorter line is no evidence for an axis.
inline constexpr double k_long_line = 0.4;
/// fitted: guess. Sine between such a line and the line from one sleeve or leg to the other.
inline constexpr double k_line_across = 0.8;

// ---- sleeves and legs (type_guess.cpp) ----------------------------------------------------------------------------
// fitted: guesses, on the garments. "Height" is the vertical component of a unit normal, or a share of the piece's
// height.

/// Two openings are a pair: ratio of girths, difference of heights, horizontal distance in girths.
inline constexpr double k_pair_girths = 1.4, k_pair_lift = 0.15, k_pair_distance = 0.25;
/// Height of the normals of legs, of a hem, and of the highest opening above legs. A jacket on its back fails the last
/// test.
inline constexpr double k_leg_normal = -0.5, k_hem_between_legs = -0.8, k_waist_normal = -0.3;
/// Distance between two short sleeves that hang, in widths of the widest other opening; long ones need 1, the derived
/// limit: two draped sweaters have 1.44.
inline constexpr double k_arms_beyond = 1.5;
/// Distance between the shoulders' ends of two long sleeves that end anywhere, in girths of a sleeve: chests have one
/// or more, the two tubes of a strap or of a hood less. A guess, chosen on two seen shirts with one arm bent.
inline constexpr double k_shoulders_apart = 0.5;
/// Girth of an arm's opening as a share of the widest other opening.
inline constexpr double k_narrow = 0.9;
/// Sleeve opposite an armhole: smallest length in girths, ratios of girth and length, height of a hem's normal, cosine
/// to the line across, height of that line.
inline constexpr double k_sleeve_tube = 0.25, k_stub_girth = 1.25, k_stub_length = 2, k_hem_below = -0.6,
                        k_sleeve_facing = 0.5, k_across_lift = 0.6;
/// Share of a piece's height, hood included: arms are above.
inline constexpr double k_arm_height = 0.45;

// ---- probability of a name (coverage.cpp) -------------------------------------------------------------------------

/// Log odds that the name is right where the kind of coverage is: constant, and change with the confidence of
/// guess_type. Tops with sleeves are one name. fitted: logistic regression, ridge 0.1 and 1, on the 126 fits of two
/// catalogues whose kind was the guessed one and right: 125 names were right, and the confidence says next to nothing.
/// (Of the exact names, such as blouse or tshirt, 107 were.)
inline constexpr double k_name_log_odds = 4.55, k_name_confidence_log_odds = -0.17;

// ---- type (type_guess.cpp) ----------------------------------------------------------------------------------------
// fitted: guesses, on the garments. Most garments are far from each limit, see the figures.

/// Result of armhole_likeness: sleeves have 0.1 to 0.4, a vest 0.7.
inline constexpr double k_armhole = 0.55;
/// Its change with the height of the normals.
inline constexpr double k_armhole_normal = 0.15;
/// Length in girths: an armhole has less, a T-shirt's sleeve 0.35.
inline constexpr double k_armhole_length = 0.25;
/// Length in girths: a sleeve to the elbow has 0.5, to the wrist 1.4.
inline constexpr double k_long_sleeve = 0.9;
/// Length in girths of sleeves that leave the forearm bare, whatever the type. fitted: guess, between a blouse of a
/// shop with short sleeves (0.47 girths) and a jacket of the catalogue with sleeves of half an arm (0.61 girths).
inline constexpr double k_short_sleeve = 0.55;
/// Relative distance from a limit at which the confidence of a decision is 1 (a reciprocal).
inline constexpr double k_confidence_slope = 2;
/// Height of a jumpsuit in lengths of its legs; length in girths of the legs of trousers.
inline constexpr double k_jumpsuit_height = 1.5, k_trouser_length = 1.0;
/// Length of a coat's skirts below the arms in widths of the chest; horizontal part of the normal of a jacket's open
/// front.
inline constexpr double k_coat_skirts = 1.5, k_jacket_front = 0.3;
/// Height of a dress in girths of its hem's waist; height of the normal of a hood's opening.
inline constexpr double k_dress_height = 1.1, k_hood_normal = 0.5;
/// Height of an opening that is an open front, as a share of the piece's height.
inline constexpr double k_open_front = 0.6;

// ---- size (garment_size.cpp) --------------------------------------------------------------------------------------

/// m, and the spread of its natural logarithm.
struct Usual {
    double size, spread;
};
/// Stature of the usual wearer, and measures of that person's garments: from sleeve to sleeve or armhole to armhole,
/// girths of sleeve, trunk (at its narrowest) and leg. fitted: medians of 140 garments of two catalogues, most of them
/// made for bodies between 1.6 and 1.85 m; spreads of one half of 125 garments of a catalogue.
inline constexpr double k_usual_wearer = 1.7;
inline constexpr Usual k_usual_shoulders { 0.336, 0.14 }, k_usual_sleeve { 0.459, 0.19 }, k_usual_trunk { 0.88, 0.18 },
    k_usual_leg { 0.605, 0.16 };
/// Of garments with legs, with sleeves or armholes, and of others. fitted: on the same half; the spreads of others are
/// guesses, for skirts may be flared
struct UsualExtents {
    Usual depth, width;
};
inline constexpr UsualExtents k_usual_with_legs { { 0.29, 0.13 }, { 0.47, 0.1 } },
    k_usual_with_arms { { 0.335, 0.19 }, { 0.75, 0.37 } }, k_usual_without { { 0.39, 0.28 }, { 0.555, 0.28 } };
/// Share of the stature that the longest trousers have, from waist to hem. fitted: guess; of the two catalogues'
/// trousers the longest have 0.6
inline constexpr Usual k_longest_trousers { 0.62, 0.05 };
/// Likewise the longest sleeves, along the cloth, to where they leave the trunk. fitted: guess; of 54 clothes of a
/// catalogue for people of 1.6 to 1.85 m the longest are 0.61 m long, two jumpsuits' apart with 0.66 and 0.69
inline constexpr Usual k_longest_sleeves { 0.36, 0.05 };

// ---- upright or not (type_guess.cpp) ------------------------------------------------------------------------------
// fitted: guesses, on the garments.

/// Sines: normals below the first are horizontal, above the second vertical.
inline constexpr double k_level = 0.25, k_plumb = 0.6;
/// Difference of girths of waist and hem as a share of the hem's: limit, and full evidence.
inline constexpr double k_least_narrower = 0.05, k_clearly_narrower = 0.3;
/// A hem: height of its normal, and its own height as a share of the piece's. Above legs an opening is evidence for the
/// front only below the second share.
inline constexpr double k_hem_normal = -0.8, k_hem_share = 0.5, k_level_share = 0.25;

/// m below the top of a garment, and length of a tube: openings that reach up there without one are parted by the strap of
/// a halter. guess, on two halter dresses
inline constexpr double k_neck_strap = 0.08;
/// Height of the normal of the opening for arms and back of a halter, at most. guess: two halter dresses have 0.07 and
/// 0.15; the largest opening of four clothes with one sleeve, which a strap divides as well, 0.85 and more
inline constexpr double k_back_facing = 0.8;

}  // namespace garmentfit::garment_tuning
