// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Joints of arms and legs: where a limb bends, where its girth is smallest, where it leaves the trunk. Where none of
// this shows, by the segment lengths of [deleva_1996_segments].

#include <array>

#include "centreline.h"
#include "labelled_surface.h"

namespace garmentfit {

/// Root, middle and end joint of an arm (shoulder, elbow, wrist) or a leg (hip, knee, ankle), and the tip beyond.
struct LimbJoints {
    Vec3 root, middle, end, tip;
    bool whole = true;  ///< with a hand or a foot
    bool widens = true;  ///< beyond its narrowest part, for long or to a thin end: evidence for a hand or foot
};

double length_of(const LimbJoints& limb);  ///< m, root to end
bool are_whole(const std::array<LimbJoints, 2>& limbs);

/// The centre line of a limb from the trunk outwards.
struct LimbLine {
    int curve;  ///< as in BodyGraph::curve
    Centreline line;
    Vec3 tip() const { return line.points.back(); }
    const Vec3& ring() const { return line.points[line.first_free]; }  ///< centroid where it leaves the trunk
};

/// @throws InvalidInput when the limb has no outline of its own.
LimbLine trace_limb(const LabelledSurface& surface, const Slicer& slicer, int curve);

/// @param up  of the trunk, unit
/// @param size  stature, m
/// @throws InvalidInput when a joint is not found.
std::array<LimbJoints, 2> place_legs(const LabelledSurface& surface, const std::array<LimbLine, 2>& legs,
                                     const Vec3& up, double size);
std::array<LimbJoints, 2> place_arms(const LabelledSurface& surface, const std::array<LimbLine, 2>& arms,
                                     const Vec3& up, double size);

/// Gives both upper arms the same length and, if both arms and legs are whole and there is a head, moves shoulders and
/// elbows towards the usual length of arms.
void adjust_arms(std::array<LimbJoints, 2>& arms, const std::array<LimbJoints, 2>& legs, const BodyGraph& graph);

}  // namespace garmentfit
