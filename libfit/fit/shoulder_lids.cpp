// SPDX-License-Identifier: GPL-3.0-or-later
#include "shoulder_lids.h"

#include <cmath>
#include <optional>
#include <utility>

#include "append_mesh.h"
#include "tuning.h"
#include "type_guess.h"

namespace garmentfit {
namespace {

// A fan about a point. The cloth's edge goes round the other way.
TriangleMesh closing_fan(const Opening& opening, const Vec3& tip)
{
    const Eigen::Index edges = opening.rim.rows();
    TriangleMesh disc { Positions(2 * edges + 1, 3), Triangles(edges, 3) };
    disc.positions << opening.rim, opening.rim_next, tip.transpose();
    for (Eigen::Index i = 0; i < edges; ++i)
        disc.triangles.row(i) << int(2 * edges), int(edges + i), int(i);
    return disc;
}

TriangleMesh lid_of_neck(const Opening& neck)
{
    return closing_fan(neck, { neck.centre.x(), neck.high.y(), neck.centre.z() });
}

Vec3 level(const Vec3& v) { return { v.x(), 0, v.z() }; }

// As deep as the garment: the back is behind the way from the strap to the bodice.
TriangleMesh lid_of_back(const Opening& back, const TriangleMesh& outward)
{
    const Vec3 behind = level(back.facing).normalized();
    const double depth = (outward.positions * behind).maxCoeff() - back.centre.dot(behind);
    return closing_fan(back, back.centre + depth * behind);
}

}  // namespace

TriangleMesh lids_at_shoulders(const TriangleMesh& outward, const std::vector<Opening>& openings)
{
    TriangleMesh lids;
    if (const std::vector<Opening> shoulders = openings_at_shoulders(openings); !shoulders.empty()) {
        append(lids, closing_fan(shoulders[0], shoulders[0].centre));
        append(lids, closing_fan(shoulders[1], shoulders[1].centre));
        append(lids, lid_of_neck(shoulders[2]));
    } else if (const std::optional<Halter> halter = find_halter(openings)) {
        append(lids, lid_of_neck(halter->neck));
        append(lids, lid_of_back(halter->back, outward));
    }
    return lids;
}

}  // namespace garmentfit
