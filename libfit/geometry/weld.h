// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "garmentfit/mesh.h"

namespace garmentfit {

/// Vertices of a garment at exactly one place are one vertex of its cloth: seams of UV charts are no cuts. Stray vertices, of no face, are
/// no cloth; they go with the nearest vertex that is.
class Weld {
public:
    explicit Weld(const GarmentMesh& garment);  ///< O(n log n)

    Positions gathered(const Positions& garment) const;  ///< of the cloth, from those of the garment
    GarmentMesh gathered(const GarmentMesh& garment) const;  ///< without faces that the weld leaves no area
    Positions spread(const Positions& cloth) const;  ///< values of the garment, from those of the cloth
    Positions placed(const Positions& cloth) const;  ///< positions: a stray vertex is as far off its nearest as at rest
    int given() const { return int(cloth_vertex_.size()); }  ///< vertices of the garment

private:
    struct Stray {
        int vertex;
        Eigen::RowVector3d offset;  // from its nearest vertex of the cloth
    };

    std::vector<int> cloth_vertex_;  // of each vertex of the garment
    std::vector<int> last_;  // of the vertices of the garment that are a vertex of the cloth
    std::vector<Stray> strays_;
};

}  // namespace garmentfit
