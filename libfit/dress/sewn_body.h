// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "garmentfit/drape_garment.h"
#include "weld.h"

namespace garmentfit {

constexpr double k_progress_of_sewn = 0.9;  // unit: share of the progress; the rest is for the body as it was given

/// A body whose vertices at one place are one, as files with hard edges or a vertex for each corner of a face have them
/// several times. Each of them would stop at the cloth for itself, and the skin would tear. A body without such vertices,
/// or one that is torn already, stays as it is, to the bit.
class SewnBody {
public:
    /// Keeps references. O(n log n)
    SewnBody(const Rig& rig, const BodyMesh& body, const DressedBody& dressed);

    /// Whether it differs from the body that was given.
    bool is_other() const { return sewn_.has_value(); }
    const Rig& rig() const { return sewn_ ? sewn_->rig : rig_; }
    const BodyMesh& body() const { return sewn_ ? sewn_->body : body_; }

    /// With the positions of the sewn body.
    DressedBody gather(DressedBody dressed) const;
    /// Positions of all vertices from those of the sewn body; those of the input where it is as in the input.
    Positions spread(const Positions& sewn) const;

private:
    struct Sewn {
        Weld weld;
        Rig rig;
        BodyMesh body;
    };

    const Rig& rig_;
    const BodyMesh& body_;
    std::optional<Sewn> sewn_;
};

}  // namespace garmentfit
