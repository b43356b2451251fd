// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/widen_garment.h"

#include <algorithm>
#include <array>

#include "body_parts.h"
#include "garmentfit/garment_weights.h"

namespace garmentfit {
namespace {

double factor_at(const Widening& widening, int bone)
{
    const int part = part_of(bone);
    return part < 0 ? 1 : factor_of(widening, part_name(part));
}

Eigen::Matrix3d stretch_of(const Vec3& axis, double across, double along)
{
    const Eigen::Matrix3d on_axis = axis * axis.transpose();
    return across * (Eigen::Matrix3d::Identity() - on_axis) + along * on_axis;
}

/// What a bone does with the cloth round it. Clavicles and hip joints point sideways: the hips are round the spine, and
/// a chest that is wider has wider shoulders.
Eigen::Matrix3d stretch_of(int bone, const Widening& widening, const Skeleton& skeleton)
{
    const double across = factor_at(widening, bone);
    if (bone == lhipjoint || bone == rhipjoint)
        return stretch_of(skeleton.direction(lowerback), across, 1);
    const bool is_shoulder = bone == lclavicle || bone == rclavicle;
    return stretch_of(skeleton.direction(bone), across, is_shoulder ? factor_at(widening, thorax) : 1);
}

using Stretches = std::array<Eigen::Affine3d, bone_count>;

Stretches stretches_of(const Widening& widening, const Skeleton& skeleton)
{
    Stretches result;
    for (int bone = 0; bone < bone_count; ++bone) {
        const Vec3& head = skeleton.head(bone);
        const int parent = parent_of(bone);
        const Vec3 moved = parent < 0 ? head : Vec3(result[parent] * head);
        const Eigen::Matrix3d linear = stretch_of(bone, widening, skeleton);
        result[bone].linear() = linear;
        result[bone].translation() = moved - linear * head;
    }
    return result;
}

}  // namespace

GarmentMesh widen_garment(const Rig& rig, const BodyMesh& body, const Pose& pose, const GarmentMesh& garment,
                          const Widening& widening)
{
    const Positions posed = skin(body.surface.positions, rig.weights, bone_transforms(rig.skeleton, pose));
    const SkinWeights weights
        = garment_weights({ posed, body.surface.triangles }, rig.weights, garment, garment.positions);
    const Stretches stretches = stretches_of(widening, pose_skeleton(rig.skeleton, pose));
    GarmentMesh result = garment;
    for (Eigen::Index v = 0; v < garment.positions.rows(); ++v) {
        const Vec3 from = garment.positions.row(v);
        Vec3 to = Vec3::Zero();
        for (int k = 0; k < 4; ++k)
            to += weights.weights(v, k) * (stretches[weights.bones(v, k)] * from);
        result.positions.row(v) = to;
    }
    return result;
}

double factor_of(const Widening& widening, const std::string& part)
{
    const auto found = widening.find(part);
    return found == widening.end() ? 1 : found->second;
}

void widen_both_sides(Widening& widening, const std::string& part, double factor)
{
    for (int bone = 0; bone < bone_count; ++bone)
        if (const int one = part_of(bone); one >= 0 && part == part_name(one))
            for (const int side : { one, part_of(mirror_of(bone)) })
                widening[part_name(side)] = std::max(factor_of(widening, part_name(side)), factor);
}

double largest_factor(const Widening& widening)
{
    double largest = 1;
    for (const auto& [part, factor] : widening)
        largest = std::max(largest, factor);
    return largest;
}

}  // namespace garmentfit
