// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a new garment meets: the body, and the garments that it wears already, at any body scale from the bones (0) to
// full size (1).

#include <optional>
#include <vector>

#include "garmentfit/drape_garment.h"
#include "hand_stretch.h"

namespace garmentfit {

class SleeveRetraction;

/// Rows of all positions: the body's vertices, then those of each garment worn under the new one.
struct GrowingBody {
    TriangleMesh full;
    Positions bridged;  ///< full, with the body's creases bridged
    Positions withdrawn;  ///< full, with the skin in creases drawn back into the body
    Positions core;  ///< on the bones
    Skeleton bones;  ///< that the core lies on
    std::vector<double> min_scale;  ///< of each vertex; 1 for hands and feet that are free of cloth from the start
    Eigen::Index body_vertices = 0;

    Positions at(double scale) const;
    /// At a scale, one of the full bodies: bridged, withdrawn or as it is.
    Positions shrink(const Positions& grown, double scale) const;
    /// The body alone, of such positions.
    auto body_of(const Positions& positions) const { return positions.topRows(body_vertices); }
};

/// Who puts on a garment, and in which pose: the same for every start.
struct Wearer {
    const Rig& rig;
    const BodyMesh& body;
    const DressedBody& dressed;
    HandStretch hands;
    Skeleton joints;  ///< in the pose, hands as in the input
};

/// @param garment     where the cloth starts
/// @param retraction  of its sleeves; hands and feet that this frees have full size at every scale. None: the whole
///                    body grows from its bones.
GrowingBody make_growing_body(const Wearer& wearer, const GarmentMesh& garment, const SleeveRetraction* retraction);

/// The largest initial body scale at which body and cloth do not cross, if there is one. Where there is none at first,
/// faces that span a joint are drawn to the joint: they cut its corner, where a hem or a cuff may lie.
std::optional<double> find_initial_scale(GrowingBody& inside, const TriangleMesh& cloth);

/// @throws InvalidInput that names the bone, and the place, at which the cloth crosses the smallest body.
[[noreturn]] void refuse(const GrowingBody& inside, const TriangleMesh& cloth, const SkinWeights& weights);

}  // namespace garmentfit
