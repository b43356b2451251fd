// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Skin that clothes cover whatever the body does: files of outfits can leave it out, so that it cannot pass through the
// cloth of a posed body.
//
// Method  depth pictures of body and clothes from many directions, in the rest pose and in 36 poses of everyday movement
//         (standing, reaching, sitting, walking, ...), posed by linear blend skinning; more where one shows skin that is
//         new. Skin that the blending pushes through the cloth over it counts as covered there. Skin that no picture
//         shows is covered, but for a margin along the skin that is seen. The same bits on any number of threads.
// Cost    O(n) for each of some thousand pictures; n faces of body and clothes.

#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

struct SkinnedCloth {
    TriangleMesh surface;  ///< worn in the rest pose
    SkinWeights weights;  ///< a row for each vertex
};

/// Of each vertex of the body, whether it is never seen. Skin that only the body itself hides, such as that of the
/// mouth, is not covered.
/// @param body  in the rest pose of the rig, a row of weights for each vertex
/// @throws InvalidInput: numbers of rows differ.
GARMENTFIT_API std::vector<char> find_covered_skin(const TriangleMesh& body, const Rig& rig,
                                                   const std::vector<SkinnedCloth>& clothes);

/// The faces that have a corner which is not covered. Vertices stay as they are.
GARMENTFIT_API Triangles uncovered_faces(const Triangles& triangles, const std::vector<char>& is_covered);

}  // namespace garmentfit
