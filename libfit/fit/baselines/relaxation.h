// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The optimisation of [wu_2018_garment_fitting]: the search over all degrees of freedom, relaxed into sub-problems.
// Grid search solves them one after the other, in several rounds from coarse to fine.

#include <vector>

#include "baselines/error_metric.h"
#include "garmentfit/fit_skeleton.h"

namespace garmentfit {

/// A start and its grids. Every iteration halves extents and spacings.
struct Relaxation {
    Posture start;
    Vec3 translation_extent;  // m, to each side of the start
    double translation_spacing;  // m
    double rotation_extent, rotation_spacing;  // rad
    double bone_extent;  // rad
    double bone_spacing;  // m, on the sphere of the bone's far end
    int iterations;
};

/// The paper's start, extents and spacings for a garment.
Relaxation relaxation_of(const Rig& rig, const GarmentMesh& garment, GarmentType type, int iterations);

struct RelaxedPosture {
    Posture posture;
    long long evaluations = 0, bone_evaluations = 0;  // of E and of E_B
};

/// Translation, rotation, then the covered bones, parents before children, the two arms and the two legs in parallel.
/// Postures beyond the limits of joints do not count.
RelaxedPosture search_relaxed(const Rig& rig, const ErrorMetric& metric, const std::vector<Bone>& covered,
                              const Relaxation& relaxation, const Progress& progress);

}  // namespace garmentfit
