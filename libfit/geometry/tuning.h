// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Numbers of geometry that were chosen on data. Lengths in m are metres on a body of human size; bodies of other sizes
// are scaled to it before anything runs. Most lengths here are shares of the diagonal of the mesh's box, or of a mean
// spacing.

namespace garmentfit {

// ---- mesh.cpp -------------------------------------------------------------------------------------------------------

/// Dimensionless. A vertex is astray where it is further from the middle than this many diagonals of the box of the
/// others. One in so many vertices may be astray at either end of an axis, of meshes with at least so many vertices.
/// fitted: guess; whole bodies and garments reach less than two diagonals.
inline constexpr double k_stray_reach = 100;
inline constexpr int k_vertices_a_stray = 100, k_fewest_for_strays = 16;

// ---- warps.cpp ------------------------------------------------------------------------------------------------------

/// Cosine between u and v of texture coordinates on the surface, on the mean by area, at most. fitted: guess, on 61
/// files of strangers: 57 have up to 0.12, the four others 0.15 to 0.24, of which that with 0.24 was laid out by a program
/// that knows of no cloth.
inline constexpr double k_most_askew = 0.2;

// ---- closed_surface.cpp ---------------------------------------------------------------------------------------------

/// Dimensionless, shares of the diagonal. Distances within which vertices become one, tried in turn: 2 micrometres of a
/// body, up to 1 mm for soups that were rounded or shaken. fitted: guess, on damaged copies of the bodies in
/// tests/bodies.
inline constexpr double k_weld_shares[] = { 1e-6, 1e-5, 1e-4, 5e-4 };
/// Dimensionless, a share of the body's size (Piece::size). A piece of this size beside the body is a limb or somebody
/// else; smaller ones are islands and go. fitted: guess, on scans with islands and on bodies in parts.
inline constexpr double k_largest_island = 0.2;
/// Edges of a hole. Up to here all patches are tried where Delaunay's triangulation finds none. The time grows with the
/// third power: one second at 300. fitted: by that second.
inline constexpr int k_largest_cubic_hole = 300;
/// Vertices of a piece that are tried for whether the piece lies within the body. fitted: guess.
inline constexpr int k_piece_samples = 9;

// ---- remeshed_cloth.cpp ---------------------------------------------------------------------------------------------

/// Rounds of splits, collapses, flips and smoothing. unit: three are usual; more change little
inline constexpr int k_remeshing_rounds = 3;
/// Dimensionless, area as a share of the squared side of the new triangles: smaller pieces have no shape in them.
/// fitted: guess.
inline constexpr double k_least_piece = 20;

// ---- loose_vertices.cpp ---------------------------------------------------------------------------------------------

/// Dimensionless, a share of the diagonal. A head, a hand or a foot that was cut off reaches this far from its stump.
/// fitted: guess, on bodies of tests/bodies with parts cut off.
inline constexpr double k_reach_of_stump = 0.15;

// ---- proxy_surface.cpp ----------------------------------------------------------------------------------------------

/// Dimensionless. Above this multiple of the wanted vertices the shortest edges are collapsed first: far cheaper, and
/// far below the resolution that is wanted. fitted: by time, on scans of 10^6 vertices.
inline constexpr int k_coarse_multiple = 4;
/// Dimensionless, a share of the wanted vertices. With fewer, triangles are quartered: on larger ones the contraction
/// to a curve skeleton fails at wrists and armpits. fitted: on the bodies of tests/bodies, thinned out.
inline constexpr double k_fewest_proxy_vertices = 0.65;

// ---- short_edges.cpp ------------------------------------------------------------------------------------------------

/// Dimensionless, a share of the edge that an even mesh of the wanted size has. The first sweep takes shorter edges;
/// each further one takes edges longer by the growth. fitted: guess, by evenness and time on scans of 10^6 vertices.
inline constexpr double k_first_short_edge = 0.3, k_short_edge_growth = 1.25;
/// Sweeps. fitted: guess; the last one takes edges of 3.5 times the even length.
inline constexpr int k_most_sweeps = 12;

// ---- reconstruct.cpp ------------------------------------------------------------------------------------------------

/// Points. Fewer cannot show hands and feet. fitted: guess.
inline constexpr int k_fewest_points = 500;
/// Points. Denser clouds are thinned out: the rig reads no more than a fraction. fitted: by time, some seconds.
inline constexpr double k_most_points = 50000;
/// Points. The spacing at a point is the mean distance to so many neighbours. fitted: guess.
inline constexpr int k_spacing_neighbours = 24;
/// Dimensionless, in spacings. A point whose neighbours are this far on average is an outlier; on the surface it is
/// about half of that. fitted: guess, on noisy samples of the bodies in tests/bodies.
inline constexpr double k_outlier = 3;
/// Rounds of smoothing; noise as large as the spacing goes. fitted: guess, on the same samples.
inline constexpr int k_scale_steps = 4;
/// Dimensionless, in spacings. Wider gaps stay open, or an arm would be sewn to the trunk. fitted: guess, on the same
/// samples.
inline constexpr double k_longest_bridge = 8;

// ---- wrapped_surface.cpp --------------------------------------------------------------------------------------------

/// Dimensionless, shares of the diagonal. Holes narrower than the first are wrapped over, and the wrap keeps the second
/// off the surface. fitted: guess, on torn copies of the bodies in tests/bodies.
inline constexpr double k_wrap_alpha = 0.012, k_wrap_offset = 0.001;

/// The same for bodies in parts that lie further apart, in turn. fitted: guess, on bodies cut into shells.
inline constexpr double k_wide_wrap_alphas[] = { 0.025, 0.05 };
/// The same where no human is found in a body in parts: the narrow wrap keeps arms off the trunk. fitted: guess, on
/// figures of 2 to 94 parts.
inline constexpr double k_join_narrow = 0.005, k_join_wide = 0.025;
/// Points that CGAL puts into such a wrap before it is given up. Figures that the narrow wrap helped have up to 25,000;
/// tangled hair, clothes and layers cost half a minute. fitted: guess, on eight bodies of strangers.
inline constexpr std::size_t k_most_joined = 35'000;
/// Samples of a surface, how near a closed surface has to be, a share of the diagonal, and the least share of samples
/// there, where it counts as joined. fitted: guess.
inline constexpr int k_cover_samples = 400;
inline constexpr double k_cover_distance = 0.01, k_least_cover = 0.9;

// ---- sewn_pieces.cpp -----------------------------------------------------------------------------------------------
// "The wild data" are fifteen garments of strangers, made for other bodies and programs; six of them have 2 to 21
// pieces, 49 of them small. Score: how many pieces are taken for what a look at them says.

/// m, and mean edges of the border: from a border to the one that it is sewn to. Of curved seams with other vertices on
/// either side, borders are up to a tenth of an edge apart.
/// fitted: guess, on the wild data. The hems of layers of one outfit are 7 mm apart (house data).
inline constexpr double k_seam_distance = 1e-3, k_seam_edges = 0.1;
/// Fraction of the vertices of a border that a seam has at least, and the least number of vertices that it ties.
/// fitted: guess.
inline constexpr double k_seam_share = 0.05;
inline constexpr std::size_t k_least_seam = 3;
/// Mean edges and m: the same of seams that gape, and the fraction of the border that these have at least: the fronts of a
/// jacket share a quarter. fitted: guess, on a skirt of a shop, two panels of which .55 are up to .35 edges apart.
inline constexpr double k_gaping_edges = 0.4, k_gaping_distance = 0.015, k_gaping_share = 0.4;
/// Edges within which a border is no seam with itself, how many vertices near by are looked at, and the least number that
/// it ties. fitted: guess, between a sweater of a shop whose front and back are joined at the armpits alone (300 vertices)
/// and garments with slits that end in a point.
inline constexpr int k_own_seam_rings = 3, k_own_seam_candidates = 32;
inline constexpr std::size_t k_least_own_seam = 12;
/// Of the edge opposite: distance of a vertex across a hole without area; and the steps along the border to that edge at
/// most. fitted: guess, on a dress of a shop with 55 such holes, where nine in ten distances are 0.03 at most. With three
/// steps its seams close a little better, but ties to and fro across them do not come to rest.
inline constexpr double k_t_junction = 0.1;
inline constexpr int k_t_junction_steps = 2;
/// Mean edges of the border: from a border to the surface that it is sewn on, if that is more than k_seam_distance; and
/// the fraction of the border that has to lie there. A square flap has a quarter of it at its seam.
/// fitted: guess, on the wild data. Layers of one outfit touch each other with up to 15 % of a border (house data).
inline constexpr double k_border_edges = 0.05, k_border_share = 0.2;
/// m, diagonal of the box: what is smaller is no garment, and so belongs to one.
/// fitted: guess, on the coats of the house data.
inline constexpr double k_small_piece = 0.25;
/// m, diagonal of the box: a smaller piece that is held by its back is a detail, which is stiff in the search for rest.
/// fitted: guess; belt loops and buckles of the wild data have up to 0.07, pockets and flaps 0.1 and more.
inline constexpr double k_largest_detail = 0.08;
/// m, from a small piece to what it lies on, and the fraction of its vertices that have to be as near. A sock in a
/// trouser leg is small, but only its upper part is near.
/// fitted: guess, on the wild data, where all vertices of all small pieces are.
inline constexpr double k_small_piece_distance = 0.02, k_small_piece_share = 0.8;
/// Fraction of a piece's vertices that are nearest to what it is held on, at least. Buttons have up to 0.12 beyond
/// their flaps, belt loops 0.25 on the trousers and the rest on the belt.
/// fitted: guess, on the wild data.
inline constexpr double k_holder_share = 0.2;
/// Distance and fraction, as of small pieces, of larger ones: plackets and linings. A fraction of 0.55 of a waistcoat
/// is as near to the jacket over it, and 0.6 of a belt to its trousers.
/// fitted: guess, on the wild and the house data.
inline constexpr double k_lining_distance = 0.01, k_lining_share = 0.9;

/// m, from a border to the surface that it is sewn on all along, and the fraction of the border that has to lie there:
/// of yokes and pockets drawn a little off the cloth. Layers of one outfit come as near with 0.29 of a border, a belt to
/// its trousers with 0.3.
/// fitted: guess, on the wild and the house data; judged on patches of tests/cloth.
inline constexpr double k_along_distance = 3e-3, k_along_share = 0.6;
/// m, diagonal of the box: a larger piece without a hole for a limb may be a cape or an apron, which is worn by itself;
/// and the fraction of its border that has to lie within k_lining_distance: a hoodie's pocket is open at both sides.
/// fitted: guess; all pieces of the wild data of that kind are small ones.
inline constexpr double k_patch = 0.6, k_patch_share = 0.5;

/// Dimensionless, area of a strand as a share of the square of its length. fitted: guess; a drawstring has 0.05, a
/// sleeve that is not sewn on 0.7, a square 0.5.
inline constexpr double k_strand_area = 0.15;

/// m; what lies further from a larger piece is not beside it.
/// fitted: guess.
inline constexpr double k_beside = 0.05;

// ---- panel.cpp ------------------------------------------------------------------------------------------------------
// By four garments of web shops: panels of trousers, of a hoodie and of a jacket are 0.5 to 4.6 mm thick.

/// m, and share of the root of the area: thickness of a panel at most. fitted: guess; panels have up to 0.01, buttons
/// 0.2.
inline constexpr double k_thickest_panel = 0.02, k_panel_thickness = 0.06;
/// Thicknesses, from the border of a panel to the one that it is sewn to, at most. fitted: guess; borders of the
/// trousers are up to one apart.
inline constexpr double k_panel_seam = 1.5;
/// Cosine between the normals of the two faces at an edge: below it, an edge of a panel is one of its rim. fitted:
/// guess.
inline constexpr double k_rim_cosine = 0.6;

// ---- close_seams.cpp -----------------------------------------------------------------------------------------------

/// Dimensionless, a share of the shorter of two border edges. A vertex of one border that is this close to one of the
/// other, along the seam, becomes one with it. derived: below a half, two vertices of one border never become one.
inline constexpr double k_same_vertex_share = 0.25;
/// Dimensionless: cosine between the directions from the seam into the two pieces. Above, one is folded back on the
/// other, as a lining on its cloth, and the hem between them stays a hem. fitted: guess.
inline constexpr double k_folded_back = 0.5;

}  // namespace garmentfit
