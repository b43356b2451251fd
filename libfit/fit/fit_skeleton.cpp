// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/fit_skeleton.h"

#include <algorithm>
#include <iomanip>
#include <memory>
#include <numeric>
#include <sstream>
#include <string>

#include "bone_metric.h"
#include "fast_fit.h"
#include "garmentfit/error.h"
#include "type_guess.h"
#include "outward_cloth.h"
#include "baselines/paper_metric.h"
#include "baselines/relaxation.h"
#include "baselines/surface_metric.h"

namespace garmentfit {
namespace {

constexpr Eigen::Index k_fewest_triangles = 24;  // two prisms of six sides, one above the other

constexpr double k_longest = 10, k_shortest = 0.01;  // of a garment, in heights of the body

/// Of a body that stands upright, whatever it does: from the ankles to the top of the head, and hips are aslant.
double height_of(const Skeleton& s)
{
    const auto along = [&s](std::initializer_list<Bone> bones) {
        return std::accumulate(bones.begin(), bones.end(), 0.0, [&s](double sum, Bone b) { return sum + s.length(b); });
    };
    return along({ lowerback, upperback, thorax, lowerneck, upperneck }) + (s.tips[head_top] - s.tail(upperneck)).norm()
        + std::max(along({ lhipjoint, lfemur, ltibia }), along({ rhipjoint, rfemur, rtibia }));
}

double length_of(const GarmentMesh& garment)
{
    Eigen::AlignedBox3d box;  // of cloth: stray vertices may lie anywhere
    for (const int v : garment.triangles.reshaped())
        box.extend(Vec3(garment.positions.row(v)));
    return box.sizes().maxCoeff();
}

std::array<double, bone_count> scores(const ErrorMetric& metric, const PlacedBones& bones,
                                      const std::vector<Bone>& covered)
{
    std::array<double, bone_count> result {};
    for (const Bone b : covered)
        result[b] = metric.of_bone(b, bones);
    return result;
}

std::unique_ptr<ErrorMetric> metric_of(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment,
                                       const std::vector<Bone>& covered, const FitOptions& options)
{
    if (options.method == FitMethod::paper)
        return std::make_unique<PaperMetric>(garment, covered, options.nearest);
    if (body.positions.rows() == 0 || body.positions.rows() != rig.weights.weights.rows())
        throw InvalidInput("method tisserand reads the body's surface: it has " + std::to_string(body.positions.rows())
                           + " vertices, the rig " + std::to_string(rig.weights.weights.rows())
                           + "; give the body that was rigged");
    return std::make_unique<SurfaceMetric>(rig, body, garment, options.nearest);
}

FitResult relaxed_fit(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment, const FitOptions& options,
                      const Progress& progress)
{
    const TriangleMesh outward = outward_cloth(garment);
    const std::vector<Opening> openings = openings_of(outward);
    const TypeGuess guess = resolve_type(options.type, openings);
    FitResult result;
    result.type = guess.type;
    result.type_margin = guess.margin;
    result.covered = bones_covered_by(guess.type, openings);
    const auto metric = metric_of(rig, body, garment, result.covered, options);
    const Relaxation relaxation = relaxation_of(rig, garment, guess.type, options.iterations);
    const Relaxed found = relaxed(rig, *metric, result.covered, relaxation, progress.part(0, 1, "fit the skeleton"));
    result.pose = pose_of(rig.skeleton, found.posture);
    result.evaluations = found.evaluations;
    result.bone_evaluations = found.bone_evaluations;
    result.scores_before = scores(*metric, place_bones(rig.skeleton, relaxation.start), result.covered);
    const PlacedBones bones = place_bones(rig.skeleton, found.posture);
    result.scores = scores(*metric, bones, result.covered);
    const ClearanceField cloth(outward);
    result.clearance = BoneMetric(cloth, figure_of(rig, result.covered)).clearance_shares(bones.joints);
    return result;
}

}  // namespace

const std::vector<std::string_view>& fit_method_names()
{
    static const std::vector<std::string_view> names { "fast", "paper", "tisserand" };
    return names;
}

const std::vector<std::string_view>& nearest_search_names()
{
    static const std::vector<std::string_view> names { "kd_tree", "scan" };
    return names;
}

std::array<double, bone_count> paper_scores(const Rig& rig, const Pose& pose, const GarmentMesh& garment,
                                            const std::vector<Bone>& covered)
{
    const PaperMetric metric(garment, covered, NearestSearch::kd_tree);
    const Skeleton joints = pose_skeleton(rig.skeleton, pose);
    std::array<double, bone_count> result {};
    for (const Bone b : covered)
        result[b] = metric.of_bone(b, joints);
    return result;
}

void require_wearable_size(const Rig& rig, const GarmentMesh& garment)
{
    const double height = height_of(rig.skeleton), length = length_of(garment);
    if (length <= k_longest * height && length >= k_shortest * height)
        return;
    std::ostringstream text;
    text << std::setprecision(3) << "the garment would be " << length << " m long on a body of about " << height
         << " m; check its unit (garment_unit)";
    throw InvalidInput(text.str());
}

FitResult fit_skeleton(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment, const FitOptions& options,
                       const Progress& progress)
{
    if (options.iterations < 1)
        throw InvalidInput("iterations is " + std::to_string(options.iterations) + "; give at least 1");
    if (garment.triangles.rows() < k_fewest_triangles)
        throw InvalidInput("garment has " + std::to_string(garment.triangles.rows())
                           + " triangles, too few to go round a body; give a "
                             "garment of at least "
                           + std::to_string(k_fewest_triangles));
    require_wearable_size(rig, garment);
    FitResult result = options.method == FitMethod::fast ? fast_fit(rig, garment, options.type, progress)
                                                         : relaxed_fit(rig, body, garment, options, progress);
    result.score_before = std::accumulate(result.scores_before.begin(), result.scores_before.end(), 0.0);
    result.score_after = std::accumulate(result.scores.begin(), result.scores.end(), 0.0);
    return result;
}

FitResult fit_skeleton(const Rig& rig, const GarmentMesh& garment, const FitOptions& options, const Progress& progress)
{
    return fit_skeleton(rig, {}, garment, options, progress);
}

}  // namespace garmentfit
