// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The path of a body from one pose to another, and where its skin is at each share of the path (0 to 1).

#include "creases.h"
#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"
#include "hand_stretch.h"

namespace garmentfit {

/// Takes what `from` moves to where `to` moves it.
BoneTransforms relative_transforms(const BoneTransforms& from, const BoneTransforms& to);

class PosePath {
public:
    /// @param start  the body's vertices at the start, or none: exactly the pose `from`
    /// @param cloth  all vertices of cloth at the start; only creases near them are bridged
    /// All arguments but these two must outlive this.
    PosePath(const Rig& rig, const BodyMesh& body, const Pose& from, const Pose& to, const Positions& start,
             const Positions& cloth, BridgeEnds ends = BridgeEnds::bottom);

    BoneTransforms transforms(double share) const;
    Positions at(double share) const;
    const Positions& end() const { return end_; }  ///< at(1)

    /// As at(), with the creases of the last pose bridged, more and more up to k_bridged_from. Bridges move as the skin
    /// below them does.
    Positions bridged_at(double share) const;
    /// The last pose, with the skin in creases drawn back into the body.
    Positions withdrawn_end() const;

    /// m; the length of the longest path of a vertex of cloth (n x 3). Uncovered hands go further, but no cloth moves
    /// with them.
    double length(const Positions& cloth, const SkinWeights& weights) const;

private:
    HandStretch::Shares hand_stretch(double share) const;

    const Rig& rig_;
    HandStretch hands_;
    HandStretch::Shares start_stretch_;
    const Pose &from_, &to_;
    Positions end_;
    Creases creases_;
};

}  // namespace garmentfit
