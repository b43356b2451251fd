// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How far all vertices may move so that nothing crosses.
//
// A crossing must begin with a vertex on a face or an edge on an edge. No pair gets there, so crossings neither come
// nor go: those that a garment was given with stay the same pairs. docs/cloth.md has the proof.

#include <vector>

#include "contact.h"

namespace garmentfit {

/// The fraction of its displacement, in [0, 1], that each vertex may go so that no pair comes nearer than
/// required_distance allows. `pairs` as detected at `x` for these displacements or longer ones, with margins of at
/// least `min_distance`. Same bits for any number of threads.
std::vector<double> collision_free_fractions(const std::vector<ContactPair>& pairs, const Positions& x,
                                             const Positions& displacements, double min_distance);

/// Displacements in which pairs that cannot move independently move as rigid impact zones [provot_1997_collision]: all
/// vertices of a zone get the mean displacement of its members. An obstacle of which no vertex is to move stays where
/// it is, and so does a zone with one of its vertices. Same bits for any number of threads.
/// @param cloth_vertices  the vertices from there on belong to the obstacle
Positions merge_impact_zones(const std::vector<ContactPair>& pairs, int cloth_vertices, const Positions& x,
                             const Positions& displacements, double min_distance);

}  // namespace garmentfit
