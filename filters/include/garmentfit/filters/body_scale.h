// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Bodies outside of human size: a doll, a giant.
//
// Lengths in libfit's methods are metres on a body of human size. Filters scale a scene whose body is smaller or larger
// to that size before they work on it, and scale back what they made (docs/decisions/0017-body-scale.md).

#include "garmentfit/filters/filters.h"

namespace garmentfit {

/// How tall the body is when it stands upright, m: its height along y, as far as its volume allows. The volume leaves
/// 15 %, whatever the posture. O(n).
double stature_of(const BodyMesh& body);

/// What lengths of this body are multiplied by to be those of a body of human size: 1 for bodies between about 0.5 m
/// and 2.5 m tall, whatever their posture. O(n).
double factor_to_human_size(const BodyMesh& body);

/// The scene with all lengths multiplied by `factor`. Speeds and pressures stay: they are those at human size.
Scene scale_scene(Scene scene, double factor);
/// Joints given by hand, in the same way.
GivenJoints scale_joints(GivenJoints joints, double factor);

/// Writes what a filter made of scale_scene(scene, factor) into `scene`, scaled back to the size of `scene`. What it
/// left where it was given, vertices of the body, say, is bit for bit what was given.
/// @param outputs  of the filter
void restore_size(Scene& scene, const Scene& at_human_size, double factor, const std::vector<Data>& outputs);

/// The fit map of a garment on a body as it is posed, measured at human size; ease in metres of the body as given.
FitMap fit_map_on(const BodyMesh& body, const TriangleMesh& posed, const WornGarment& worn, const ClothOptions& cloth);

}  // namespace garmentfit
