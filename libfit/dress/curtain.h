// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <vector>

#include "garmentfit/skeleton.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// A rectangle that stands on a line in the body. Cloth that lies over that part of the body passes through it.
class Curtain {
public:
    /// @param along, up  need not be of unit length, nor at right angles: the rectangle stands at right angles to along
    /// @param window  along and up, m
    Curtain(const Vec3& low, const Vec3& along, const Vec3& up, const Eigen::AlignedBox2d& window) :
        low_(low), window_(window)
    {
        const Vec3 x = along.stableNormalized(), y = (up - up.dot(x) * x).stableNormalized();
        axes_ << x.transpose(), y.transpose(), x.cross(y).transpose();
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

    /// Whether any face of the cloth does. O(n).
    bool is_met(const Positions& positions, const Triangles& triangles) const
    {
        for (Eigen::Index f = 0; f < triangles.rows(); ++f)
            if (is_met(Vec3(positions.row(triangles(f, 0))), Vec3(positions.row(triangles(f, 1))),
                       Vec3(positions.row(triangles(f, 2)))))
                return true;
        return false;
    }

private:
    Vec3 low_;
    Eigen::Matrix3d axes_;  // rows: along the line, up, across the curtain
    Eigen::AlignedBox2d window_;
};

/// Those of the bones whose curtain cloth meets. O(n) for each.
template <class CurtainOf>
std::vector<Bone> bones_under_cloth(std::initializer_list<Bone> bones, const CurtainOf& curtain_of,
                                    const Positions& positions, const Triangles& triangles)
{
    std::vector<Bone> covered;
    std::copy_if(bones.begin(), bones.end(), std::back_inserter(covered),
                 [&](Bone bone) { return curtain_of(bone).is_met(positions, triangles); });
    return covered;
}

}  // namespace garmentfit
