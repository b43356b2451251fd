// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A wrap takes seconds, and in one run a garment is asked for it as it lies in its file, in metres and turned: those
// made last are kept.

#include <deque>
#include <functional>
#include <mutex>

#include "garmentfit/mesh.h"

namespace garmentfit {

/// Thread-safe.
class KeptWraps {
public:
    /// The wrap of a garment: `make()`, or one that was made of the same garment in another place, size or turn, moved
    /// to where the garment is.
    /// @param opened  its triangles without closed ends: a garment that has only these is the same
    TriangleMesh of(const GarmentMesh& garment, const Triangles& opened, const std::function<TriangleMesh()>& make);

private:
    struct Kept {
        GarmentMesh garment;
        Triangles opened;
        TriangleMesh wrap;
    };

    std::mutex mutex_;
    std::deque<Kept> kept_;  // the last one used in front
};

}  // namespace garmentfit
