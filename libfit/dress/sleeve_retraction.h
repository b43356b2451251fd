// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sleeves and trouser legs that reach beyond wrists and ankles are pushed up before the body grows, as people do who put a garment on: a thumb
// or a heel that grew inside a cuff would be caught there.

#include <array>
#include <vector>

#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

class SleeveRetraction {
public:
    /// @param joints  in the garment's pose
    SleeveRetraction(const Skeleton& joints, const GarmentMesh& garment);

    bool any() const;
    /// The garment's vertices with its sleeves and legs pushed up, n x 3: along each limb a map without folds. What
    /// lies in narrow folds may cross all the same, for triangles stay flat.
    const Positions& positions() const { return positions_; }
    /// Of each vertex of skin (m x 3, in the garment's pose) how far it belongs to a hand or foot that stands free now, 0 to 1.
    std::vector<double> freed(const Positions& skin, const SkinWeights& weights, const Skeleton& joints) const;

private:
    std::array<bool, extremity_count> pushed_ {};
    Positions positions_;
};

}  // namespace garmentfit
