// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The skeleton-based error metric of [wu_2018_garment_fitting], equations (1) to (4), to the letter: the garment's vertices and
// vertex normals as given.

#include <functional>
#include <vector>

#include "error_metric.h"
#include "garmentfit/fit_skeleton.h"

namespace garmentfit {

/// Equation (3): the distance to the nearest vertex, and a hundred times that on the wrong side of it.
double paper_delta(const Vec3& sample, const Vec3& nearest, const Vec3& normal);

class PaperMetric : public ErrorMetric {
public:
    /// Cost of an evaluation: five nearest vertices a bone, each O(log n) by KD-tree or O(n) by scan; the answers are the same.
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
