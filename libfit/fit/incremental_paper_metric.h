// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The paper's E for postures that follow each other in small steps.

#include <array>
#include <vector>

#include "bone_samples.h"
#include "garmentfit/skeleton.h"
#include "vertex_tree.h"

namespace garmentfit {

/// Equations (1) to (4) of [wu_2018_garment_fitting]. Each sample remembers vertices that were nearest to it before.
/// The nearest vertex is no further away than those: this bound proves most postures worse without a search. Not for
/// several threads.
class IncrementalPaperMetric {
public:
    /// @param outward  from outward_cloth: the paper requires normals that point outwards
    IncrementalPaperMetric(const TriangleMesh& outward, const std::array<bool, bone_count>& covered);

    /// Is E there greater than the present one by more than `gain`, m? True for the first posture. O(log n) per sample.
    bool is_above(const Skeleton& joints, double gain);
    /// By how much, m; only after is_above returned true.
    double gain() const { return next_.total - present_.total; }
    /// The last posture of is_above becomes the present one.
    void accept() { present_ = next_; }

    double total() const { return present_.total; }

private:
    static constexpr int k_remembered = 8;  // unit: decides the speed, not the result
    struct Sample {
        int bone, place;  // number among the bone's samples
        std::array<int, k_remembered> vertices;
        int oldest = 0;
    };
    struct State {
        std::vector<Vec3> at;
        std::vector<double> delta;  // m
        double total;
    };

    double bound_distance(const Sample& sample, const Vec3& at) const;
    double delta(Sample& sample, const Vec3& at, double max_distance) const;

    Positions positions_, normals_;
    VertexTree nearest_;
    std::vector<Sample> samples_;
    State present_, next_;
};

}  // namespace garmentfit
