// SPDX-License-Identifier: GPL-3.0-or-later
#include "weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "vertex_tree.h"
#include "warps.h"

namespace garmentfit {

Weld::Weld(const GarmentMesh& garment) : cloth_vertex_(garment.positions.rows())
{
    const Positions& rest = garment.positions;
    std::vector<char> is_cloth(rest.rows(), 0);
    for (const int v : garment.triangles.reshaped())
        is_cloth[v] = 1;
    std::map<std::array<double, 3>, int> places;
    for (int v = 0; v < given(); ++v) {
        if (!is_cloth[v])
            continue;
        const auto [place, is_new] = places.try_emplace({ rest(v, 0), rest(v, 1), rest(v, 2) }, int(places.size()));
        cloth_vertex_[v] = place->second;
        if (is_new)
            last_.push_back(v);
        last_[place->second] = v;
    }
    if (last_.empty() || std::find(is_cloth.begin(), is_cloth.end(), 0) == is_cloth.end())
        return;
    const Positions cloth = rest(last_, Eigen::all);
    const VertexTree tree(cloth);
    for (int v = 0; v < given(); ++v)
        if (!is_cloth[v]) {
            cloth_vertex_[v] = tree.index(rest.row(v), INFINITY);
            strays_.push_back({ v, rest.row(v) - cloth.row(cloth_vertex_[v]) });
        }
}

Positions Weld::gather(const Positions& garment) const { return garment(last_, Eigen::all); }

GarmentMesh Weld::gather(const GarmentMesh& garment) const
{
    Triangles welded(garment.triangles.rows(), 3);
    std::vector<int> kept;
    for (Eigen::Index f = 0; f < welded.rows(); ++f) {
        for (int k = 0; k < 3; ++k)
            welded(f, k) = cloth_vertex_[garment.triangles(f, k)];
        const auto& corners = welded.row(f);
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
            kept.push_back(int(f));
    }
    return with_triangles({ {}, std::move(welded), garment.warps }, gather(garment.positions), kept);
}

Positions Weld::spread(const Positions& cloth) const { return cloth(cloth_vertex_, Eigen::all); }

Positions Weld::place(const Positions& cloth) const
{
    Positions result = spread(cloth);
    for (const Stray& stray : strays_)
        result.row(stray.vertex) += stray.offset;
    return result;
}

}  // namespace garmentfit
