// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Retracts sleeves and trouser legs that reach beyond wrists and ankles, before the body grows, as people do who put a
// garment on. A thumb or a heel that grew inside a cuff would be caught there
// (docs/decisions/0014-sleeve-retraction.md).

#include <array>
#include <vector>

#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"
#include "sewn_pieces.h"

namespace garmentfit {

class SleeveRetraction {
public:
    /// @param joints  in the garment's pose
    /// @param cloth   welded: what is open along a seam goes round no limb
    /// @param ties    of the cloth; a sleeve may be sewn from several pieces
    SleeveRetraction(const Skeleton& joints, const TriangleMesh& cloth, const std::vector<Tie>& ties = {});

    /// Whether any sleeve or leg was retracted.
    bool is_any() const;
    /// The cloth's vertices with sleeves and legs retracted, n x 3. Along each limb the map has no folds. Cloth in
    /// narrow folds may cross all the same, because triangles stay flat.
    const Positions& positions() const { return positions_; }
    /// For each vertex of skin (m x 3, in the garment's pose) the least body scale: 1 on hands and feet that are free
    /// of cloth now, 0 elsewhere, and the share of the hand or foot in between.
    std::vector<double> min_scales(const Positions& skin, const SkinWeights& weights, const Skeleton& joints) const;

private:
    std::array<bool, extremity_count> retracted_ {};
    Positions positions_;
};

}  // namespace garmentfit
