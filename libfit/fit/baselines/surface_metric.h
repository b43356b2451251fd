// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The surface metric of [tisserand_2017_garment_positioning], in the form to which [wu_2018_garment_fitting] compares
// its own: every evaluation poses the body's surface and finds the nearest body vertex of each garment vertex.

#include "baselines/error_metric.h"
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
