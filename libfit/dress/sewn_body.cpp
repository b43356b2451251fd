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

SewnBody::SewnBody(const Rig& rig, const BodyMesh& body, const DressedBody& dressed) :
    given_(body.surface.positions), weld_(GarmentMesh { body.surface.positions, body.surface.triangles })
{
    GarmentMesh one = weld_.gather(GarmentMesh { body.surface.positions, body.surface.triangles });
    const std::vector<int> used = used_vertices(body.surface.triangles);
    if (one.positions.rows() == Eigen::Index(used.size()))
        return;
    if (dressed.body.rows() > 0 && is_torn(dressed.body, weld_, used))
        return;
    std::vector<int> vertices;
    for (int v = 0; v < int(one.positions.rows()); ++v)
        vertices.push_back(weld_.given_vertex(v));
    sewn_.emplace(rig, body, vertices, std::move(one.triangles));
}

DressedBody SewnBody::gather(DressedBody dressed) const
{
    if (dressed.body.rows() > 0)
        dressed.body = weld_.gather(dressed.body);
    return dressed;
}

Positions SewnBody::spread(const Positions& sewn) const
{
    return sewn == sewn_->body.surface.positions ? given_ : weld_.place(sewn);
}

}  // namespace garmentfit
