// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Distances between the primitives of triangle meshes, and how far they may move before they meet.
// Closest points after Ericson, "Real-Time Collision Detection" (2005), sec. 5.1; degenerate primitives are welcome.

#include <array>

#include "garmentfit/types.h"

namespace garmentfit {

enum class PairKind : unsigned char { vertex_face, edge_edge };

/// The closest points of two primitives as weights of their four vertices: the separation is sum of weight * position,
/// pointing from the second primitive to the first. vertex_face: vertex, then triangle; edge_edge: two and two.
struct Closest {
    std::array<double, 4> weights;  ///< e.g. (1, -b0, -b1, -b2) or (1-s, s, t-1, -t)
    double distance;
};

using Corners = std::array<Vec3, 4>;

Closest closest(PairKind kind, const Corners& x);

inline Vec3 separation(const std::array<double, 4>& weights, const Corners& x)
{
    return weights[0] * x[0] + weights[1] * x[1] + weights[2] * x[2] + weights[3] * x[3];
}

/// Longest travel of one primitive against the other, their common motion taken out; metres.
double relative_travel(PairKind kind, const Corners& displacements);

/// What a single motion must leave of a distance (metres): four fifths of what exceeds the gap may be used up; below the gap a
/// tenth, and next to nothing below a hundredth of it, so that rounding never decides on which side a vertex is.
double kept_distance(double distance, double gap);

/// The share t in [0, 1] of the displacements during which the distance never falls below kept_distance, by conservative
/// advancement: additive CCD, Li et al. 2021 (C-IPC), algorithm 1.
double free_share(PairKind kind, Corners x, Corners displacements, double gap);

}  // namespace garmentfit
