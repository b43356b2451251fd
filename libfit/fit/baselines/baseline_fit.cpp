// SPDX-License-Identifier: GPL-3.0-or-later
#include "baselines/baseline_fit.h"

#include <memory>
#include <string>

#include "baselines/paper_metric.h"
#include "baselines/relaxation.h"
#include "baselines/surface_metric.h"
#include "bone_metric.h"
#include "coverage.h"
#include "garmentfit/error.h"
#include "outward_cloth.h"

namespace garmentfit {
namespace {

std::array<double, bone_count> bone_scores(const ErrorMetric& metric, const PlacedBones& bones,
                                           const std::vector<Bone>& covered)
{
    std::array<double, bone_count> scores {};
    for (const Bone b : covered)
        scores[b] = metric.of_bone(b, bones);
    return scores;
}

std::unique_ptr<ErrorMetric> make_metric(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment,
                                         const std::vector<Bone>& covered, const FitOptions& options)
{
    if (options.method == FitMethod::paper)
        return std::make_unique<PaperMetric>(garment, covered, options.nearest);
    if (body.positions.rows() == 0 || body.positions.rows() != rig.weights.weights.rows())
        throw InvalidInput(ErrorCode::rig_mismatch,
                           "method tisserand reads the body's surface: it has " + std::to_string(body.positions.rows())
                               + " vertices, the rig " + std::to_string(rig.weights.weights.rows())
                               + "; give the body that was rigged");
    return std::make_unique<SurfaceMetric>(rig, body, garment, options.nearest);
}

}  // namespace

FitResult fit_baseline(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment, const FitOptions& options,
                       const Progress& progress)
{
    const TriangleMesh outward = outward_cloth(garment);
    const std::vector<Opening> openings = openings_of(outward);
    FitResult result;
    result.type = resolve_type(options.type, openings);
    result.covered = bones_covered_by(result.type, openings);
    const auto metric = make_metric(rig, body, garment, result.covered, options);
    const Relaxation relaxation = relaxation_of(rig, garment, result.type, options.iterations);
    const RelaxedPosture found
        = search_relaxed(rig, *metric, result.covered, relaxation, progress.part(0, 1, "fit the skeleton"));
    result.pose = pose_of(rig.skeleton, found.posture);
    result.evaluations = found.evaluations;
    result.bone_evaluations = found.bone_evaluations;
    result.scores_before = bone_scores(*metric, place_bones(rig.skeleton, relaxation.start), result.covered);
    const PlacedBones bones = place_bones(rig.skeleton, found.posture);
    result.scores = bone_scores(*metric, bones, result.covered);
    const ClearanceField cloth(outward);
    result.clearance = BoneMetric(cloth, limb_radii_of(rig, result.covered)).clearance_shares(bones.joints);
    return result;
}

std::array<double, bone_count> paper_scores(const Rig& rig, const Pose& pose, const GarmentMesh& garment,
                                            const std::vector<Bone>& covered)
{
    const PaperMetric metric(garment, covered, NearestSearch::kd_tree);
    const Skeleton joints = pose_skeleton(rig.skeleton, pose);
    std::array<double, bone_count> scores {};
    for (const Bone b : covered)
        scores[b] = metric.of_bone(b, joints);
    return scores;
}

}  // namespace garmentfit
