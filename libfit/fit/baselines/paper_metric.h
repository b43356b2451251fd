// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The skeleton-based error metric of [wu_2018_garment_fitting], equations (1) to (4), without changes: by the garment's
// vertices and vertex normals as given.

#include <functional>
#include <vector>

#include "baselines/error_metric.h"
#include "garmentfit/fit_skeleton.h"

namespace garmentfit {

class PaperMetric : public ErrorMetric {
public:
    /// Keeps a reference. Cost of an evaluation: five nearest vertices per bone, each O(log n) by KD-tree or O(n) by
    /// scan, with the same results.
    PaperMetric(const GarmentMesh& garment, const std::vector<Bone>& covered, NearestSearch search);

    double total(const PlacedBones& bones) const override { return total(bones.joints); }
    double of_bone(int bone, const PlacedBones& bones) const override { return of_bone(bone, bones.joints); }

    double total(const Skeleton& joints) const;
    double of_bone(int bone, const Skeleton& joints) const;

private:
    double delta(const Vec3& sample) const;

    const Positions& positions_;
    Positions normals_;
    std::vector<Bone> covered_;
    std::function<int(const Vec3&)> nearest_vertex_;
};

}  // namespace garmentfit
