// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds the skeleton of a body and its skin weights.
//
// Method   curve skeleton by mean curvature flow [tagliasacchi_2012_skeletons] on a decimated proxy, its five ends
//          named head, hands and feet, joints along its limbs; heat weights [baran_2007_pinocchio] restricted to each
//          limb's part of the surface.
// Units    metres, +y up.
// Cost     about linear in the proxy (5 to 15 thousand vertices); the user's vertices only cost a transfer of weights.
// Promise  all joints lie inside the closed surface; turning or mirroring the body turns or mirrors the rig.

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "garmentfit/mesh.h"
#include "garmentfit/progress.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Joints given by the user, m; all, some or none.
struct GivenJoints {
    std::optional<Vec3> root;
    std::array<std::optional<Vec3>, bone_count> tails;
    std::array<std::optional<Vec3>, extremity_count> tips;

    /// Whether root and tails are all given: then no joint is searched.
    GARMENTFIT_API bool is_complete() const;
};

/// Which bodies are rigged.
enum class Humanlike {
    any,  ///< whatever has two arms, two legs and a trunk; Rig::human_probability says how human it is
    strict  ///< human bodies only, others are refused
};
/// "any", "strict" in the order of Humanlike.
GARMENTFIT_API const std::vector<std::string_view>& humanlike_names();

struct RigOptions {
    /// Approximate number of vertices of the decimated surface in which joints are found.
    int proxy_vertices = 8000;  // fitted: guess, on the bodies of docs/rig.md; part of the interface
    bool swap_sides = false;  ///< exchanges left and right, where the classification is wrong
    Humanlike humanlike = Humanlike::any;  ///< which bodies are rigged and which refused
    std::optional<Vec3> front {};  ///< rough direction of the chest, if known: replaces the classification
    GivenJoints joints {};  ///< corrections; joints between them adapt
};

/// @throws InvalidInput that names the failed test, with numbers, when the mesh is not a human body. Cancelled.
GARMENTFIT_API Rig rig_body(const BodyMesh& body, const RigOptions& options = {}, const Progress& progress = {});

/// Checks that a skeleton that another program made, such as that of a skinned file, is this body's: bones of some
/// length, as long on the left as on the right, joints in or near the body. Proportions may be those of a cartoon.
/// O(joints * triangles). @throws InvalidInput (rig_mismatch) that names the failed test, with numbers.
/// @param weights  of the body's vertices; without them the skin of the hands is not looked at
GARMENTFIT_API void check_skeleton(const BodyMesh& body, const Skeleton& skeleton, const SkinWeights& weights = {});

}  // namespace garmentfit
