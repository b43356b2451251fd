// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Some questions about a garment take seconds, and in one run it is asked them as it lies in its file, in metres and
// turned: the answers given last are kept.

#include <algorithm>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>

#include "garmentfit/mesh.h"

namespace garmentfit {

/// The motion that takes one garment to another with the same faces and the same shape, in another place, size or turn
/// [umeyama_1991_similarity]; none where it is another garment.
std::optional<Eigen::Matrix4d> similarity(const GarmentMesh& from, const GarmentMesh& to);

/// Moves all vertices.
void transform(TriangleMesh& mesh, const Eigen::Matrix4d& motion);

/// Results for which there is a `transform`. Thread-safe.
template <class Result>
class KeptResults {
public:
    /// That of a garment: `make()`, or one that was made of the same garment elsewhere, moved to where the garment is.
    Result of(const GarmentMesh& garment, const std::function<Result()>& make)
    {
        const std::lock_guard lock(mutex_);
        for (auto kept = kept_.begin(); kept != kept_.end(); ++kept)
            if (const auto motion = similarity(kept->garment, garment)) {
                std::rotate(kept_.begin(), kept, kept + 1);
                Result result = kept_.front().result;
                if (!motion->isIdentity(0))
                    transform(result, *motion);
                return result;
            }
        kept_.push_front({ garment, make() });
        if (kept_.size() > k_kept)
            kept_.pop_back();
        return kept_.front().result;
    }

private:
    static constexpr std::size_t k_kept = 4;  // unit: garments of an outfit; some 10 MB each

    struct Kept {
        GarmentMesh garment;
        Result result;
    };

    std::mutex mutex_;
    std::deque<Kept> kept_;  // the last one used in front
};

}  // namespace garmentfit
