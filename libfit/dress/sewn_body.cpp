// SPDX-License-Identifier: GPL-3.0-or-later
#include "sewn_body.h"

#include <utility>
#include <vector>

#include "used_vertices.h"

namespace garmentfit {

SewnBody::SewnBody(const Rig& rig, const BodyMesh& body) : rig_(rig), body_(body)
{
    const GarmentMesh surface { body.surface.positions, body.surface.triangles };
    Weld weld(surface);
    GarmentMesh one = weld.gather(surface);
    if (one.positions.rows() == Eigen::Index(used_vertices(surface.triangles).size()))
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
    if (sewn_ && dressed.body.rows() > 0)
        dressed.body = sewn_->weld.gather(dressed.body);
    return dressed;
}

Positions SewnBody::spread(const Positions& sewn) const
{
    if (!sewn_)
        return sewn;
    return sewn == sewn_->body.surface.positions ? body_.surface.positions : sewn_->weld.place(sewn);
}

}  // namespace garmentfit
