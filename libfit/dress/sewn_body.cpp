// SPDX-License-Identifier: GPL-3.0-or-later
#include "sewn_body.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "used_vertices.h"

namespace garmentfit {
namespace {

/// Whether vertices that were at one place are apart.
bool is_torn(const Positions& body, const Weld& weld, const std::vector<int>& vertices)
{
    const Positions one = weld.gather(body);
    return std::any_of(vertices.begin(), vertices.end(),
                       [&](int v) { return body.row(v) != one.row(weld.cloth_vertex(v)); });
}

}  // namespace

SewnBody::SewnBody(const Rig& rig, const BodyMesh& body, const DressedBody& dressed) : given_(body.surface.positions)
{
    const GarmentMesh surface { body.surface.positions, body.surface.triangles };
    Weld weld(surface);
    GarmentMesh one = weld.gather(surface);
    const std::vector<int> used = used_vertices(surface.triangles);
    if (one.positions.rows() == Eigen::Index(used.size()))
        return;
    if (dressed.body.rows() > 0 && is_torn(dressed.body, weld, used))
        return;
    std::vector<int> rows;
    for (int v = 0; v < int(one.positions.rows()); ++v)
        rows.push_back(weld.given_vertex(v));
    Rig sewn_rig = rig;
    sewn_rig.weights.bones = rig.weights.bones(rows, Eigen::all).eval();
    sewn_rig.weights.weights = rig.weights.weights(rows, Eigen::all).eval();
    sewn_ = Sewn { std::move(weld),
                   std::move(sewn_rig),
                   { { std::move(one.positions), std::move(one.triangles) }, body.closed, body.repaired } };
}

DressedBody SewnBody::gather(DressedBody dressed) const
{
    if (dressed.body.rows() > 0)
        dressed.body = sewn_->weld.gather(dressed.body);
    return dressed;
}

Positions SewnBody::spread(const Positions& sewn) const
{
    return sewn == sewn_->body.surface.positions ? given_ : sewn_->weld.place(sewn);
}

}  // namespace garmentfit
