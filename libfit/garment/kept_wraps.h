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
    /// @param garment  without closed ends: it is the same whether it was asked for with them or not
    TriangleMesh of(const GarmentMesh& garment, const std::function<TriangleMesh()>& make);

private:
    struct Kept {
        GarmentMesh garment;
        TriangleMesh wrap;
    };

    std::mutex mutex_;
    std::deque<Kept> kept_;  // the last one used in front
};

}  // namespace garmentfit
