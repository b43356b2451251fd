// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The surface metric of [tisserand_2017_garment_positioning], as [wu_2018_garment_fitting] compares itself with: the body's
// surface is posed for every evaluation, and every garment vertex looks for the nearest body vertex.

#include "error_metric.h"
#include "garmentfit/fit_skeleton.h"

namespace garmentfit {

class SurfaceMetric : public ErrorMetric {
public:
    /// Keeps references. Cost of an evaluation: O(n_H n_G) by scan, O((n_H + n_G) log n_H) by KD-tree.
    SurfaceMetric(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment, NearestSearch search);

    double total(const PlacedBones& bones) const override;
    double of_bone(int, const PlacedBones& bones) const override { return total(bones); }

private:
    const Rig& rig_;
    const TriangleMesh& body_;
    const GarmentMesh& garment_;
    Positions garment_normals_;
    NearestSearch search_;
};

}  // namespace garmentfit
