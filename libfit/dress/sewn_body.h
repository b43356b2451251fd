// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "garmentfit/drape_garment.h"
#include "partial_body.h"
#include "weld.h"

namespace garmentfit {

/// A body whose vertices at one place are one, as files with hard edges or a vertex for each corner of a face have them
/// several times. Each of them would stop at the cloth for itself, and the skin would tear. A body without such vertices,
/// or one that is torn already, stays as it is, to the bit.
class SewnBody {
public:
    /// Keeps a reference to the body. O(n log n)
    SewnBody(const Rig& rig, const BodyMesh& body, const DressedBody& dressed);

    /// Whether it differs from the body that was given.
    bool is_other() const { return sewn_.has_value(); }
    // The others: @pre is_other()
    const Rig& rig() const { return sewn_->rig; }
    const BodyMesh& body() const { return sewn_->body; }
    /// With the positions of the sewn body.
    DressedBody gather(DressedBody dressed) const;
    /// Positions of all vertices from those of the sewn body; those of the input where it is as in the input.
    Positions spread(const Positions& sewn) const;

private:
    const Positions& given_;
    Weld weld_;
    std::optional<PartialBody> sewn_;
};

/// What `move` makes of the sewn body. Where that does not end certified, and nothing is too tight, what it makes of the
/// body as it was given, if that does: torn skin may let go cloth that is pinched between two sheets of the body.
/// @param move  of a rig, a body, what it wears and a Progress a DrapeResult or a RecoverResult
template <class Move>
auto move_sewn(const Rig& rig, const BodyMesh& body, const DressedBody& dressed, const Progress& progress,
               const Move& move)
{
    constexpr double k_progress_of_sewn = 0.9;  // unit: share of the progress; the rest is for the body as given
    const SewnBody sewn(rig, body, dressed);
    if (!sewn.is_other())
        return move(rig, body, dressed, progress);
    auto result = move(sewn.rig(), sewn.body(), sewn.gather(dressed), progress.part(0, k_progress_of_sewn));
    result.body = sewn.spread(result.body);
    if constexpr (requires { result.frames; })
        for (auto& frame : result.frames)
            frame.body = sewn.spread(frame.body);
    if (result.certified || !result.too_tight.empty() || result.out_of_time)
        return result;
    auto torn = move(rig, body, dressed, progress.part(k_progress_of_sewn, 1));
    return torn.certified ? torn : result;
}

}  // namespace garmentfit
