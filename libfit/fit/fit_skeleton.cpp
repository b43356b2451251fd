// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/fit_skeleton.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "baselines/baseline_fit.h"
#include "fast_fit.h"
#include "garmentfit/closed_ends.h"
#include "garmentfit/error.h"
#include "garmentfit/number_text.h"
#include "refusal.h"
#include "tuning.h"

namespace garmentfit {
namespace {

constexpr Eigen::Index k_min_triangles
    = 24;  // derived: the coarsest tube with a middle, two rings of six quadrilaterals

double length_of(const GarmentMesh& garment)
{
    Eigen::AlignedBox3d box;  // of the faces: vertices without a face may lie anywhere
    for (const int v : garment.triangles.reshaped())
        box.extend(Vec3(garment.positions.row(v)));
    return box.sizes().maxCoeff();
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

void require_wearable_size(const Rig& rig, const GarmentMesh& garment)
{
    const double height = standing_height(rig.skeleton), length = length_of(garment);
    if (length <= k_max_length * height && length >= k_min_length * height)
        return;
    throw InvalidInput(ErrorCode::wrong_unit,
                       "the garment would be " + rounded_text(length / height, 2)
                           + " times as long as the body is tall; check the units of both, and give the garment's "
                             "(garment_unit)");
}

FitResult fit_skeleton(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment, const FitOptions& options,
                       const Progress& progress)
{
    if (options.iterations < 1)
        throw InvalidInput(ErrorCode::out_of_range,
                           "iterations is " + std::to_string(options.iterations) + "; give at least 1");
    if (garment.triangles.rows() < k_min_triangles)
        throw InvalidInput(ErrorCode::degenerate_mesh,
                           "garment: only " + std::to_string(garment.triangles.rows())
                               + " triangles, too few to go round a body; give a garment of at least "
                               + std::to_string(k_min_triangles));
    require_wearable_size(rig, garment);
    const OpenedGarment opened = open_ends(garment);
    FitResult result = options.method == FitMethod::fast ? fit_fast(rig, body, opened.garment, options, progress)
                                                         : fit_baseline(rig, body, opened.garment, options, progress);
    result.closed_ends = opened.closed_ends;
    result.left_out = opened.left_out;
    result.score_before = std::accumulate(result.scores_before.begin(), result.scores_before.end(), 0.0);
    result.score_after = std::accumulate(result.scores.begin(), result.scores.end(), 0.0);
    return result;
}

FitResult fit_skeleton(const Rig& rig, const GarmentMesh& garment, const FitOptions& options, const Progress& progress)
{
    return fit_skeleton(rig, {}, garment, options, progress);
}

}  // namespace garmentfit
