// SPDX-License-Identifier: GPL-3.0-or-later
#include "moved_scene.h"

namespace garmentfit {
namespace {

/// What was given, in each row that is still where it was for the filter.
/// @param made    what the filter left, before it was scaled or moved back
/// @param before  what it got
void restore_rows(Positions& positions, const Positions& made, const Positions& before, const Positions& given)
{
    if (positions.rows() != given.rows())
        return;
    for (Eigen::Index v = 0; v < given.rows(); ++v)
        if (made.row(v) == before.row(v))
            positions.row(v) = given.row(v);
}

/// @param made  the dressing that `dressing` was scaled or moved back from
void restore_rows(Dressing& dressing, const Dressing& made, const Scene& worked, const Scene& given)
{
    const Positions &body = given.body->surface.positions, &body_before = worked.body->surface.positions;
    restore_rows(dressing.body, made.body, body_before, body);
    for (std::size_t i = 0; i < dressing.frames.size(); ++i)
        restore_rows(dressing.frames[i].body, made.frames[i].body, body_before, body);
    for (const std::size_t i : dressing.worn())
        restore_rows(dressing.garments[i].rest.positions, made.garments[i].rest.positions,
                     worked.garments[i].mesh.positions, given.garments[i].mesh.positions);
}

std::optional<Dressing> restore_given(const std::optional<Dressing>& dressing, const std::optional<Dressing>& made,
                                      const Scene& worked, const Scene& given)
{
    std::optional<Dressing> result = dressing;
    if (result)
        restore_rows(*result, *made, worked, given);
    return result;
}

}  // namespace

void take_outputs(Scene& given, const Scene& made, const Scene& worked, const std::vector<Data>& outputs)
{
    for (const Data output : outputs)
        switch (output) {
        case Data::rig: given.rig = made.rig; break;
        case Data::fits:
            given.fits = made.fits;
            given.automatic_layers = made.automatic_layers;
            given.one_pose = made.one_pose;
            given.conflicts = made.conflicts;
            break;
        case Data::draped: given.draped = restore_given(made.draped, worked.draped, worked, given); break;
        case Data::recovered: given.recovered = restore_given(made.recovered, worked.recovered, worked, given); break;
        case Data::body:
        case Data::garments: break;  // no filter makes them
        }
    given.seconds = made.seconds;
}

}  // namespace garmentfit
