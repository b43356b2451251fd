// SPDX-License-Identifier: GPL-3.0-or-later
#include "straps.h"

#include "append_mesh.h"
#include "clearance.h"
#include "type_guess.h"
#include "winding_number.h"

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

// The middle between the armholes is not inside by the cloth.
bool hangs_by_straps(const TriangleMesh& outward, const std::vector<Opening>& shoulders)
{
    const Vec3 middle = 0.5 * (shoulders[0].centre + shoulders[1].centre);
    return !Clearance { 0, inside_of(winding_number(outward, middle)) }.is_inside();
}

}  // namespace

TriangleMesh lids_between_straps(const TriangleMesh& outward, const std::vector<Opening>& openings)
{
    const std::vector<Opening> shoulders = openings_at_shoulders(openings);
    TriangleMesh lids;
    if (shoulders.empty() || !hangs_by_straps(outward, shoulders))
        return lids;
    for (const Opening& opening : shoulders) {
        const bool is_neck = &opening == &shoulders.back();
        const Vec3& centre = opening.centre;
        append(lids, closing_fan(opening, { centre.x(), is_neck ? opening.high.y() : centre.y(), centre.z() }));
    }
    return lids;
}

}  // namespace garmentfit
