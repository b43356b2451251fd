// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What each vertex of a cloth is made of, where several garments move as one cloth.

#include <algorithm>
#include <vector>

#include "garmentfit/cloth.h"

namespace garmentfit {

/// Young's moduli, N/m; their mean is the stretch stiffness.
inline double stiffness_along_warp(const Material& material)
{
    return 2 * material.stretch_stiffness / (1 + material.weft_to_warp);
}
inline double stiffness_along_weft(const Material& material)
{
    return material.weft_to_warp * stiffness_along_warp(material);
}

/// Of two garments that touch: as soft as the softer, and as rough as both on the mean.
inline Material mixed(Material one, const Material& other)
{
    one.stretch_stiffness = std::min(one.stretch_stiffness, other.stretch_stiffness);
    one.friction = 0.5 * (one.friction + other.friction);
    return one;
}

class Materials {
public:
    /// All cloth is of the fabric of `options`.
    explicit Materials(const ClothOptions& options) : of_garment_ { material_of(options) } { }

    /// @param fabrics   of each garment; empty: all cloth is of the fabric of `options`
    /// @param garments  of each vertex its garment; empty: there is one garment
    Materials(const ClothOptions& options, const std::vector<Fabric>& fabrics, std::vector<int> garments) :
        Materials(options)
    {
        if (fabrics.empty())
            return;
        of_garment_.clear();
        for (const Fabric fabric : fabrics)
            of_garment_.push_back(material_of(options, fabric));
        garments_ = std::move(garments);
    }

    const Material& at(int vertex) const { return of_garment_[garments_.empty() ? 0 : garments_[vertex]]; }

private:
    std::vector<Material> of_garment_;
    std::vector<int> garments_;
};

}  // namespace garmentfit
