// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Skin weights of clothes, so that a dressed body can be moved by other programs.
//
// Method  robust transfer and inpainting [abdrashitov_2023_weights], with certainty in place of a limit of distance.
//         Cloth is drawn to the weights of the nearest skin: the nearer and the more alike in direction, the firmer. The
//         smoothest weights that follow these are taken. So cloth that touches skin has its weights; the front of a
//         skirt follows the nearer thigh and changes over to the other one as slowly as it is far from them; the inner
//         side of a sleeve beside the trunk, which is of another direction, continues the rest of the sleeve.
// Seams   vertices at the same place have the same weights. Buttons, pockets and flaps follow the cloth that they are
//         sewn to (docs/geometry.md, Sewn pieces).
// Units   none: body and garment have one unit, lengths are shares of the body's diagonal.
// Cost    O(n log m) for the search, one sparse factorisation for the rest; n cloth and m skin vertices.

#include <Eigen/SparseCore>

#include "garmentfit/export.h"
#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Vertices x joints of any skeleton. Rows are non-negative and sum to 1.
using JointWeights = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The same weights as a column for each bone.
GARMENTFIT_API JointWeights joint_weights_of(const SkinWeights& weights);

/// The four largest of each row, largest first, scaled to sum to 1. @pre The columns are bones.
GARMENTFIT_API SkinWeights skin_weights_of(const JointWeights& weights);

struct GarmentWeightOptions {
    /// Degrees between the normals of skin and cloth: skin of this angle no longer draws cloth.
    double largest_angle = 60;  // fitted: guess, on pairs of docs/outfits.md; 73 and 90 are worse in skirts and coats
    int joints_per_vertex = 4;  ///< at most; 1..8
};

/// Weights of a garment over the joints of the body.
/// @param body          in the pose in which the garment is worn
/// @param body_weights  a row for each vertex of `body`, over any joints
/// @param garment       as given: its shape sets what is near along the cloth
/// @param worn          n x 3, the garment on the body, in the order of `garment`
/// Where one piece of cloth has two sheets (cloth with modelled thickness), skin may lie on either side of it.
/// @throws InvalidInput: numbers of rows differ, options out of range, a row of weights that does not sum to 1.
///         SolverFailure.
GARMENTFIT_API JointWeights garment_weights(const TriangleMesh& body, const JointWeights& body_weights,
                                            const GarmentMesh& garment, const Positions& worn,
                                            const GarmentWeightOptions& options = {});

/// The same over the bones of libfit, at most four a vertex.
GARMENTFIT_API SkinWeights garment_weights(const TriangleMesh& body, const SkinWeights& body_weights,
                                           const GarmentMesh& garment, const Positions& worn,
                                           const GarmentWeightOptions& options = {});

}  // namespace garmentfit
