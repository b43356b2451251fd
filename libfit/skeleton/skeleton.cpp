// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/skeleton.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tuning.h"

namespace garmentfit {
namespace {

struct BoneRow {
    std::string_view name;
    int parent, mirror;
};

constexpr std::array<BoneRow, bone_count> k_bones { {
    { "lhipjoint", -1, rhipjoint },
    { "lfemur", lhipjoint, rfemur },
    { "ltibia", lfemur, rtibia },
    { "rhipjoint", -1, lhipjoint },
    { "rfemur", rhipjoint, lfemur },
    { "rtibia", rfemur, ltibia },
    { "lowerback", -1, lowerback },
    { "upperback", lowerback, upperback },
    { "thorax", upperback, thorax },
    { "lowerneck", thorax, lowerneck },
    { "upperneck", lowerneck, upperneck },
    { "lclavicle", thorax, rclavicle },
    { "lhumerus", lclavicle, rhumerus },
    { "lradius", lhumerus, rradius },
    { "rclavicle", thorax, lclavicle },
    { "rhumerus", rclavicle, lhumerus },
    { "rradius", rhumerus, lradius },
} };

struct DualQuaternion {
    Eigen::Vector4d real, dual;  // coefficients x, y, z, w
};

DualQuaternion dual_quaternion(const Eigen::Isometry3d& transform)
{
    const Eigen::Quaterniond q(transform.linear());
    const Vec3 t = transform.translation();
    const Eigen::Quaterniond d = Eigen::Quaterniond(0, t.x(), t.y(), t.z()) * q;
    return { q.coeffs(), 0.5 * d.coeffs() };
}

bool is_identity(const Eigen::Isometry3d& t) { return t.matrix() == Eigen::Matrix4d::Identity(); }

}  // namespace

std::string_view bone_name(int bone) { return k_bones[bone].name; }
int parent_of(int bone) { return k_bones[bone].parent; }
int mirror_of(int bone) { return k_bones[bone].mirror; }

int bone_of(std::string_view name)
{
    for (int b = 0; b < bone_count; ++b)
        if (k_bones[b].name == name)
            return b;
    return -1;
}

int bone_before(Extremity extremity)
{
    constexpr std::array<int, extremity_count> bones { upperneck, lradius, rradius, ltibia, rtibia };
    return bones[extremity];
}

const Vec3& Skeleton::head(int bone) const { return parent_of(bone) < 0 ? root : tails[parent_of(bone)]; }

Pose::Pose() { rotations.fill(Eigen::Quaterniond::Identity()); }

bool is_same(const Pose& a, const Pose& b)
{
    for (int bone = 0; bone < bone_count; ++bone)
        if (a.rotations[bone].coeffs() != b.rotations[bone].coeffs())
            return false;
    return a.root_translation == b.root_translation && a.root_rotation.coeffs() == b.root_rotation.coeffs();
}

BoneTransforms bone_transforms(const Skeleton& rest, const Pose& pose)
{
    const auto about = [](const Vec3& from, const Vec3& to, const Eigen::Quaterniond& rotation) {
        Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
        t.linear() = rotation.toRotationMatrix();
        t.translation() = (to - from) + (from - t.linear() * from);  // exactly zero for the identity rotation
        return t;
    };
    std::array<Eigen::Quaterniond, bone_count> world;
    BoneTransforms transforms;
    for (int b = 0; b < bone_count; ++b) {
        const int p = parent_of(b);
        world[b] = (p < 0 ? pose.root_rotation : world[p]) * pose.rotations[b];
        const Vec3 head = rest.head(b);
        const Vec3 posed_head = p < 0 ? Vec3(rest.root + pose.root_translation) : Vec3(transforms[p] * head);
        transforms[b] = about(head, posed_head, world[b]);
    }
    return transforms;
}

Skeleton pose_skeleton(const Skeleton& rest, const Pose& pose)
{
    const auto transforms = bone_transforms(rest, pose);
    Skeleton result = rest;
    result.root = rest.root + pose.root_translation;
    for (int b = 0; b < bone_count; ++b)
        result.tails[b] = transforms[b] * rest.tails[b];
    for (int e = 0; e < extremity_count; ++e)
        result.tips[e] = transforms[bone_before(Extremity(e))] * rest.tips[e];
    return result;
}

Pose slerp(const Pose& from, const Pose& to, double t)
{
    if (t <= 0 || t >= 1)
        return t <= 0 ? from : to;
    Pose result;
    result.root_translation = (1 - t) * from.root_translation + t * to.root_translation;
    result.root_rotation = from.root_rotation.slerp(t, to.root_rotation);
    for (int b = 0; b < bone_count; ++b)
        result.rotations[b] = from.rotations[b].slerp(t, to.rotations[b]);
    return result;
}

namespace {

/// [kavan_2008_dual_quaternions], algorithm 1. Antipodal quaternions are flipped towards the vertex's first bone. A
/// vertex whose bones do not move returns bit for bit.
class DualQuaternionBlend {
public:
    explicit DualQuaternionBlend(const BoneTransforms& transforms)
    {
        for (int b = 0; b < bone_count; ++b) {
            dual_[b] = dual_quaternion(transforms[b]);
            still_[b] = is_identity(transforms[b]);
        }
    }

    Vec3 apply(const Vec3& p, const SkinWeights& weights, Eigen::Index v) const
    {
        Eigen::Vector4d real = Eigen::Vector4d::Zero(), dual = Eigen::Vector4d::Zero();
        bool moves = false;
        const Eigen::Vector4d& first = dual_[weights.bones(v, 0)].real;
        for (int k = 0; k < 4; ++k) {
            const double w = weights.weights(v, k);
            if (w == 0)
                continue;
            const int b = weights.bones(v, k);
            moves |= !still_[b];
            const double sign = first.dot(dual_[b].real) < 0 ? -w : w;
            real += sign * dual_[b].real;
            dual += sign * dual_[b].dual;
        }
        return moves ? transform(p, real, dual) : p;
    }

private:
    static Vec3 transform(const Vec3& p, Eigen::Vector4d real, Eigen::Vector4d dual)
    {
        const double norm = real.norm();
        real /= norm;
        dual /= norm;
        const Vec3 r = real.head<3>(), d = dual.head<3>();
        const double w = real.w(), dw = dual.w();
        return p + 2 * r.cross(r.cross(p) + w * p) + 2 * (w * d - dw * r + r.cross(d));
    }

    std::array<DualQuaternion, bone_count> dual_;
    std::array<bool, bone_count> still_ {};
};

}  // namespace

Positions skin(const Positions& rest_positions, const SkinWeights& weights, const BoneTransforms& transforms)
{
    const DualQuaternionBlend blend(transforms);
    Positions result(rest_positions.rows(), 3);
    for (Eigen::Index v = 0; v < rest_positions.rows(); ++v)
        result.row(v) = blend.apply(rest_positions.row(v), weights, v);
    return result;
}

std::array<double, bone_count> bone_radii(const Skeleton& rest, const SkinWeights& weights,
                                          const Positions& rest_positions)
{
    std::array<std::vector<double>, bone_count> distances;
    for (Eigen::Index v = 0; v < rest_positions.rows(); ++v) {
        int slot = 0;
        weights.weights.row(v).maxCoeff(&slot);
        const int b = weights.bones(v, slot);
        const Vec3 from_head = Vec3(rest_positions.row(v)) - rest.head(b);
        const double along = from_head.dot(rest.direction(b));
        if (along > 0 && along < rest.length(b))  // excludes the skin of hands and feet
            distances[b].push_back((from_head - along * rest.direction(b)).norm());
    }
    std::array<double, bone_count> radii {};
    for (int b = 0; b < bone_count; ++b)
        if (auto& d = distances[b]; !d.empty()) {
            std::nth_element(d.begin(), d.begin() + d.size() / skeleton_tuning::k_radius_quantile, d.end());
            radii[b] = d[d.size() / skeleton_tuning::k_radius_quantile];
        }
    return radii;
}

}  // namespace garmentfit
