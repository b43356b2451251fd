// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/snapshot.h"

#include <algorithm>
#include <cmath>

#include "garmentfit/closed_ends.h"
#include "garmentfit/error.h"
#include "garmentfit/filters/body_scale.h"
#include "garmentfit/filters/outcome.h"

namespace garmentfit {
namespace {

constexpr double k_rounding = 1e-6;  // unit: files keep six digits; share of the body's diagonal

Positions skinned(const Scene& scene, const Pose& pose)
{
    return skin(scene.body->surface.positions, scene.rig->weights, bone_transforms(scene.rig->skeleton, pose));
}

Snapshot snapshot_before_dressing(const Scene& scene)
{
    if (scene.fits.empty())
        return { {}, scene.body->surface.positions, {}, {} };
    const Pose& pose = scene.fits[outermost(scene.fits)].pose;
    return { pose, skinned(scene, pose), {}, {} };
}

Snapshot end_of(const Dressing& dressing)
{
    Snapshot snapshot { dressing.pose, dressing.body, {}, dressing.maps };
    for (const WornGarment& garment : dressing.garments)
        snapshot.garments.push_back(garment.positions);
    return snapshot;
}

const RecoverFrame& nearest_frame(const std::vector<RecoverFrame>& frames, double share)
{
    return *std::min_element(frames.begin(), frames.end(), [share](const RecoverFrame& a, const RecoverFrame& b) {
        return std::abs(a.share - share) < std::abs(b.share - share);
    });
}

Snapshot snapshot_of(const Scene& scene, const Dressing& dressing, const RecoverFrame& frame, const ClothOptions& cloth)
{
    Snapshot snapshot { slerp(scene.draped->pose, Pose(), frame.share), frame.body, frame.garments,
                        std::vector<FitMap>(frame.garments.size()) };
    const TriangleMesh body { frame.body, scene.body->surface.triangles };
    for (const std::size_t i : dressing.worn()) {
        WornGarment worn = dressing.garments[i];
        worn.positions = frame.garments[i];
        snapshot.maps[i] = fit_map_on(*scene.body, body, worn, cloth);
    }
    return snapshot;
}

void require_same_count(const Positions& given, const Positions& left, const std::string& name)
{
    if (left.rows() != given.rows())
        throw InvalidInput(ErrorCode::count_mismatch,
                           name + " has " + std::to_string(left.rows()) + " vertices after draping, and "
                               + std::to_string(given.rows()) + " as given; give what draping made");
}

/// The vertices of the posed body, replaced where those that were left differ by more than a file rounds.
Positions keep_left(Positions posed, const Positions& left)
{
    const double rounding = k_rounding * (posed.colwise().maxCoeff() - posed.colwise().minCoeff()).norm();
    for (Eigen::Index v = 0; v < posed.rows(); ++v)
        if ((left.row(v) - posed.row(v)).norm() > rounding)
            posed.row(v) = left.row(v);
    return posed;
}

}  // namespace

Snapshot snapshot_of(const Scene& scene, double share, const ClothOptions& cloth)
{
    const Dressing* end = final_dressing(scene);
    if (!end)
        return snapshot_before_dressing(scene);
    if (share >= 1 || end->frames.empty())
        return end_of(*end);
    return snapshot_of(scene, *end, nearest_frame(end->frames, share), cloth);
}

Dressing dressing_from(const Scene& scene, const Pose& pose, const Positions& left, const std::vector<Positions>& worn,
                       const std::vector<std::string>& names)
{
    require_same_count(scene.body->surface.positions, left, "the body");
    Dressing dressing;
    dressing.pose = pose;
    dressing.to_human_size = factor_to_human_size(*scene.body);
    dressing.unit = scene.unit;
    dressing.outermost = scene.fits.size() == worn.size() ? outermost(scene.fits) : worn.size() - 1;
    dressing.body = keep_left(skinned(scene, pose), left);
    for (std::size_t i = 0; i < worn.size(); ++i) {
        const OpenedGarment opened = open_ends(scene.garments[i].mesh);
        require_same_count(opened.garment.positions, worn[i], names[i]);
        dressing.garments.push_back({ opened.garment, worn[i], {} });
        dressing.garments.back().closed_ends = opened.closed_ends;
        dressing.garments.back().left_out = opened.left_out;
    }
    dressing.certified = certify_all(dressing.garments, { dressing.body, scene.body->surface.triangles });
    return dressing;
}

}  // namespace garmentfit
