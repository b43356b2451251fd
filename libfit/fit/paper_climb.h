// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The paper's E for poses that follow each other in small steps.

#include <array>
#include <vector>

#include "error_metric.h"
#include "vertex_tree.h"

namespace garmentfit {

/// Equations (1) to (4) of [wu_2018_garment_fitting]. Every sample remembers vertices that were nearest to it before; the cloth is no
/// further from it than those, so that most poses are known to be worse without a search. Not for several threads.
class PaperClimb {
public:
    /// @param outward  from outward_cloth: what the paper takes a garment's normals to be
    PaperClimb(const TriangleMesh& outward, const std::array<bool, bone_count>& covered);

    /// Is E there by more than `gain` above the present one? The first pose asked for is above any. O(log n) a sample.
    bool is_above(const Skeleton& joints, double gain);
    /// By how much, m, where it was.
    double gain() const { return next_.total - present_.total; }
    /// What was asked for last becomes the present pose.
    void accept() { present_ = next_; }

    double total() const { return present_.total; }

private:
    static constexpr int k_remembered = 8;
    struct Sample {
        int bone, place;  // of its five
        std::array<int, k_remembered> vertices;
        int oldest = 0;
    };
    struct State {
        std::vector<Vec3> at;
        std::vector<double> delta;  // m
        double total;
    };

    double furthest(const Sample& sample, const Vec3& at) const;
    double delta(Sample& sample, const Vec3& at, double furthest) const;

    Positions positions_, normals_;
    VertexTree nearest_;
    std::vector<Sample> samples_;
    State present_, next_;
};

}  // namespace garmentfit
