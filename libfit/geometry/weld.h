// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "garmentfit/mesh.h"

namespace garmentfit {

/// Between a garment as given and its cloth. Vertices of the garment at exactly the same place are one vertex of the
/// cloth, because seams of UV charts are no cuts. Stray vertices, which have no face, are not part of the cloth; they
/// follow its nearest vertex.
class Weld {
public:
    explicit Weld(const GarmentMesh& garment);  ///< O(n log n)

    Positions gather(const Positions& garment) const;  ///< positions of the cloth
    GarmentMesh gather(const GarmentMesh& garment) const;  ///< the cloth, without faces that lose a corner
    Positions spread(const Positions& cloth) const;  ///< values at the garment's vertices, from those of the cloth
    Positions place(const Positions& cloth) const;  ///< positions; a stray vertex keeps its offset at rest
    int given() const { return int(cloth_vertex_.size()); }  ///< vertices of the garment
    int cloth_vertex(int given) const { return cloth_vertex_[given]; }  ///< that at one of the garment's
    int given_vertex(int cloth) const { return last_[cloth]; }  ///< one of the garment's vertices at this of the cloth

private:
    struct Stray {
        int vertex;
        Eigen::RowVector3d offset;  // from its nearest vertex of the cloth
    };

    std::vector<int> cloth_vertex_;  // of each vertex of the garment
    std::vector<int> last_;  // vertex of the garment at each vertex of the cloth
    std::vector<Stray> strays_;
};

}  // namespace garmentfit
