// SPDX-License-Identifier: GPL-3.0-or-later
#include "baselines/surface_metric.h"

#include "nearest.h"
#include "tuning.h"

namespace garmentfit {
namespace {

BoneTransforms transforms_of(const Skeleton& rest, const PlacedBones& bones)
{
    BoneTransforms transforms;
    for (int b = 0; b < bone_count; ++b)
        transforms[b]
            = Eigen::Translation3d(bones.joints.head(b)) * bones.turns[b] * Eigen::Translation3d(-rest.head(b));
    return transforms;
}

// Half of |a - b|^2 for unit vectors: 0 alike, 2 opposed.
double difference(const Vec3& a, const Vec3& b) { return 1 - a.dot(b); }

template <class Nearest>
double agreement(const Positions& garment, const Positions& garment_normals, const Positions& body,
                 const Positions& body_normals, const Nearest& nearest)
{
    double sum = 0;
    for (Eigen::Index v = 0; v < garment.rows(); ++v) {
        const int b = nearest.index(garment.row(v));
        sum -= (garment.row(v) - body.row(b)).norm()
            + k_normal_weight * difference(garment_normals.row(v), body_normals.row(b));
    }
    return sum;
}

}  // namespace

SurfaceMetric::SurfaceMetric(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment,
                             NearestSearch search) :
    rig_(rig),
    body_(body), garment_(garment), garment_normals_(vertex_normals(garment.positions, garment.triangles)),
    search_(search)
{
}

double SurfaceMetric::total(const PlacedBones& bones) const
{
    const Positions body = skin(body_.positions, rig_.weights, transforms_of(rig_.skeleton, bones));
    const Positions normals = vertex_normals(body, body_.triangles);
    return search_ == NearestSearch::scan
        ? agreement(garment_.positions, garment_normals_, body, normals, PointScan(body))
        : agreement(garment_.positions, garment_normals_, body, normals, NearestPoint(body));
}

}  // namespace garmentfit
