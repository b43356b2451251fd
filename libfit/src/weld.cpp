// SPDX-License-Identifier: GPL-3.0-or-later
#include "weld.h"

#include <array>
#include <map>

namespace fit {

Weld::Weld(const Positions& rest) : cloth_vertex_(rest.rows())
{
    std::map<std::array<double, 3>, int> places;
    for (Eigen::Index v = 0; v < rest.rows(); ++v)
        cloth_vertex_[v] = places.try_emplace({ rest(v, 0), rest(v, 1), rest(v, 2) }, int(places.size())).first->second;
    count_ = int(places.size());
}

Positions Weld::gathered(const Positions& garment) const
{
    Positions result(count_, 3);
    for (int v = 0; v < given(); ++v)
        result.row(cloth_vertex_[v]) = garment.row(v);
    return result;
}

GarmentMesh Weld::gathered(const GarmentMesh& garment) const
{
    GarmentMesh result { gathered(garment.positions), Triangles(garment.triangles.rows(), 3) };
    Eigen::Index kept = 0;
    for (const auto& corners : garment.triangles.rowwise()) {
        const int a = cloth_vertex_[corners[0]], b = cloth_vertex_[corners[1]], c = cloth_vertex_[corners[2]];
        if (a != b && b != c && c != a)
            result.triangles.row(kept++) << a, b, c;
    }
    result.triangles.conservativeResize(kept, 3);
    return result;
}

Positions Weld::spread(const Positions& cloth) const { return cloth(cloth_vertex_, Eigen::all); }

}  // namespace fit
