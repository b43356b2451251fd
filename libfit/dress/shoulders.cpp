// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/shoulders.h"

#include "tuning.h"

namespace garmentfit {
namespace {

// The upright rectangle over a collarbone, in its plane: a face of the cloth that lies over the shoulder passes through
// it.
class Curtain {
public:
    Curtain(const Skeleton& joints, Bone clavicle) : low_(joints.head(clavicle))
    {
        const double length = joints.length(clavicle);
        const Vec3 along = joints.direction(clavicle), trunk = joints.direction(thorax);
        const Vec3 up = (trunk - trunk.dot(along) * along).stableNormalized();
        axes_ << along.transpose(), up.transpose(), along.cross(up).transpose();
        window_ = { Eigen::Vector2d::Zero(), Eigen::Vector2d((1 + k_beyond_shoulder) * length, length) };
    }

    bool is_met(const Vec3& a, const Vec3& b, const Vec3& c) const
    {
        const Vec3 corners[] { axes_ * (a - low_), axes_ * (b - low_), axes_ * (c - low_) };
        Eigen::AlignedBox2d section;
        for (int k = 0; k < 3; ++k) {
            const Vec3 &p = corners[k], &q = corners[(k + 1) % 3];
            if (p.z() * q.z() <= 0 && p.z() != q.z())
                section.extend(Vec3(p + p.z() / (p.z() - q.z()) * (q - p)).head<2>());
        }
        return !section.isEmpty() && section.intersects(window_);
    }

private:
    Vec3 low_;
    Eigen::Matrix3d axes_;  // rows: along the bone, up, across the curtain
    Eigen::AlignedBox2d window_;  // along and up
};

}  // namespace

std::vector<Bone> shoulders_under_cloth(const Skeleton& joints, const Positions& positions, const Triangles& triangles)
{
    std::vector<Bone> covered;
    for (const Bone clavicle : { lclavicle, rclavicle }) {
        const Curtain curtain(joints, clavicle);
        const auto corner = [&](Eigen::Index f, int k) { return Vec3(positions.row(triangles(f, k))); };
        for (Eigen::Index f = 0; f < triangles.rows(); ++f)
            if (curtain.is_met(corner(f, 0), corner(f, 1), corner(f, 2))) {
                covered.push_back(clavicle);
                break;
            }
    }
    return covered;
}

}  // namespace garmentfit
