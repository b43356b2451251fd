// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Distances between the primitives of triangle meshes, and how far they may move before they meet.
//
// Closest points  [ericson_2005_collision], sec. 5.1. Degenerate primitives are allowed.
// Step            additive continuous collision detection [li_2021_cipc], algorithm 1; where it is longer, what the gap
//                 along the axis of the closest points allows. docs/cloth.md has the proof.
// Units           metres.

#include <array>

#include "garmentfit/types.h"

namespace garmentfit {

enum class PairKind : unsigned char { vertex_face, edge_edge };

/// unit: m; things nearer than this touch: rounding decides on which side of each other they are.
inline constexpr double k_touching = 1e-9;

/// The closest points of two primitives as weights of their four vertices. The separation is the sum of weight *
/// position and points from the second primitive to the first. vertex_face: vertex, then triangle; edge_edge: two and
/// two.
struct ClosestPoints {
    std::array<double, 4> weights;  ///< (1, -b0, -b1, -b2) or (1 - s, s, t - 1, -t)
    double distance;
};

using Corners = std::array<Vec3, 4>;

inline Corners corners_of(const Positions& x, const std::array<int, 4>& v)
{
    return { Vec3(x.row(v[0])), Vec3(x.row(v[1])), Vec3(x.row(v[2])), Vec3(x.row(v[3])) };
}

ClosestPoints closest_points(PairKind kind, const Corners& x);

/// Whether two primitives are farther apart than this, as far as a look along the line between their middles tells:
/// a fifth of the work of closest_points. False where it does not tell.
bool are_surely_apart(PairKind kind, const Corners& x, double distance);

inline Vec3 separation(const std::array<double, 4>& weights, const Corners& x)
{
    return weights[0] * x[0] + weights[1] * x[1] + weights[2] * x[2] + weights[3] * x[3];
}

/// Longest travel of one primitive against the other, without their common motion.
double relative_travel(PairKind kind, const Corners& displacements);

/// What a single motion must leave of a distance: half of what exceeds the minimum; below the minimum nine tenths,
/// and nearly everything below a hundredth of it. The table in docs/cloth.md says the same.
double required_distance(double distance, double min_distance);

/// The fraction in [0, 1] of the displacements during which the distance never falls below required_distance.
double collision_free_fraction(PairKind kind, const Corners& x, const Corners& displacements, double min_distance);

}  // namespace garmentfit
