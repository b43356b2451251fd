// SPDX-License-Identifier: GPL-3.0-or-later
#include "baselines/paper_metric.h"

#include "bone_samples.h"
#include "nearest.h"

namespace garmentfit {
namespace {

std::function<int(const Vec3&)> nearest_by(NearestSearch search, const Positions& points)
{
    if (search == NearestSearch::scan)
        return [scan = PointScan(points)](const Vec3& query) { return scan.index(query); };
    return [tree = NearestPoint(points)](const Vec3& query) { return tree.index(query); };
}

}  // namespace

PaperMetric::PaperMetric(const GarmentMesh& garment, const std::vector<Bone>& covered, NearestSearch search) :
    positions_(garment.positions), normals_(vertex_normals(garment.positions, garment.triangles)), covered_(covered),
    nearest_vertex_(nearest_by(search, garment.positions))
{
}

// (3)
double PaperMetric::delta(const Vec3& p) const
{
    const int nearest = nearest_vertex_(p);
    return paper_delta(p, positions_.row(nearest), normals_.row(nearest));
}

// (1)
double PaperMetric::of_bone(int bone, const Skeleton& joints) const
{
    double sum = 0;
    for (int i = 0; i < k_samples; ++i)
        sum += delta(bone_sample(joints.head(bone), joints.tail(bone), i));
    return sum;
}

// (4)
double PaperMetric::total(const Skeleton& joints) const
{
    double sum = 0;
    for (const Bone bone : covered_)
        sum += of_bone(bone, joints);
    return sum;
}

}  // namespace garmentfit
