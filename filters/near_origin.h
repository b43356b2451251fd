// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Scenes that lie far from the origin: a scan in the coordinates of a map, a figure in a large scene.
//
// A double holds 1e-11 m at 1e5 m, too little for motions that are cut before anything crosses. Filters move such a
// scene to the origin before they work on it, and move back what they made (docs/decisions/0035-near-origin.md).

#include <vector>

#include "garmentfit/filters/filters.h"

namespace garmentfit {

/// What to subtract from a body to bring it near the origin, m; the subtraction is exact. Zero along axes on which it is
/// near already: nearer than a hundred diagonals of its box. O(n).
Vec3 origin_of(const Positions& body);

/// The same for each part of a scene.
struct Origins {
    Vec3 body = Vec3::Zero();
    std::vector<Vec3> garments;  ///< the body's, but for garments that lie far from the body
    Vec3 draped = Vec3::Zero();  ///< of the scene's draped garments

    bool all_zero() const;
};

/// O(n).
Origins origins_of(const Scene& scene);

/// The scene with its origins at zero.
Scene move_to_origin(Scene scene, const Origins& origins);
/// Joints given by hand, in the same way.
GivenJoints move_to_origin(GivenJoints joints, const Origins& origins);

/// Writes what a filter made of move_to_origin(scene, origins) into `scene`, moved back. What it left where it was
/// given is bit for bit what was given; the rest is rounded to the digits that a double has there.
/// @param outputs  of the filter
void move_back(Scene& scene, const Scene& near_origin, const Origins& origins, const std::vector<Data>& outputs);

}  // namespace garmentfit
