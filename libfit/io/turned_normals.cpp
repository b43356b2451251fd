// SPDX-License-Identifier: GPL-3.0-or-later
#include "turned_normals.h"

#include <cmath>

namespace garmentfit {
namespace {

Vec3 area_of(const Triangles& triangles, Eigen::Index f, const Positions& positions)
{
    const Vec3 a = positions.row(triangles(f, 0)), b = positions.row(triangles(f, 1)),
               c = positions.row(triangles(f, 2));
    return (b - a).cross(c - a);
}

Positions area_normals(Eigen::Index count, const Triangles& corners, const Triangles& triangles,
                       const Positions& positions)
{
    Positions sums = Positions::Zero(count, 3);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Vec3 area = area_of(triangles, f, positions);
        for (int k = 0; k < 3; ++k)
            if (corners(f, k) >= 0)
                sums.row(corners(f, k)) += area;
    }
    return sums;
}

}  // namespace

Positions turn_normals(const Positions& normals, const Triangles& corners, const Triangles& triangles,
                       const Positions& before, const Positions& after)
{
    const Positions from = area_normals(normals.rows(), corners, triangles, before);
    const Positions to = area_normals(normals.rows(), corners, triangles, after);
    Positions turned = normals;
    for (Eigen::Index n = 0; n < normals.rows(); ++n) {
        const Vec3 u = from.row(n), v = to.row(n);
        if (u != v && u.norm() > 0 && v.norm() > 0)
            turned.row(n) = Eigen::Quaterniond::FromTwoVectors(u, v) * Vec3(normals.row(n));
    }
    return turned;
}

double share_against_faces(const Positions& normals, const Triangles& corners, const Triangles& triangles,
                           const Positions& positions)
{
    double against = 0, all = 0;
    for (Eigen::Index f = 0; f < triangles.rows() && normals.rows() > 0; ++f) {
        const Vec3 area = area_of(triangles, f, positions);
        for (int k = 0; k < 3; ++k)
            if (corners(f, k) >= 0) {
                const double along = area.dot(normals.row(corners(f, k)));
                all += along == 0 || !std::isfinite(along) ? 0 : area.norm();
                against += along < 0 ? area.norm() : 0;
            }
    }
    return all > 0 ? against / all : 0;
}

}  // namespace garmentfit
