// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "fit/mesh.h"

namespace fit {

/// Vertices of a garment at exactly one place are one vertex of its cloth: seams of UV charts are no cuts.
class Weld {
public:
    explicit Weld(const Positions& rest);  ///< O(n log n)

    Positions gathered(const Positions& garment) const;  ///< of the cloth, from those of the garment
    GarmentMesh gathered(const GarmentMesh& garment) const;  ///< without faces that the weld leaves no area
    Positions spread(const Positions& cloth) const;  ///< of the garment, from those of the cloth
    int given() const { return int(cloth_vertex_.size()); }  ///< vertices of the garment

private:
    std::vector<int> cloth_vertex_;  // of each vertex of the garment
    int count_;
};

}  // namespace fit
