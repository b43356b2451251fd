// SPDX-License-Identifier: GPL-3.0-or-later
#include "incremental_paper_metric.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "garmentfit/mesh.h"

namespace garmentfit {

IncrementalPaperMetric::IncrementalPaperMetric(const TriangleMesh& outward,
                                               const std::array<bool, bone_count>& covered) :
    positions_(outward.positions),
    normals_(vertex_normals(outward.positions, outward.triangles)), nearest_(outward.positions)
{
    for (int b = 0; b < bone_count; ++b)
        for (int i = 0; i < k_samples && covered[b]; ++i) {
            samples_.push_back({ b, i, {} });
            samples_.back().vertices.fill(outward.triangles(0, 0));
        }
    const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    present_ = { std::vector<Vec3>(samples_.size(), nowhere), std::vector<double>(samples_.size()),
                 -std::numeric_limits<double>::infinity() };
}

// An upper bound of the distance to the nearest vertex.
double IncrementalPaperMetric::bound_distance(const Sample& sample, const Vec3& at) const
{
    double least = std::numeric_limits<double>::infinity();
    for (const int v : sample.vertices)
        least = std::min(least, (Vec3(positions_.row(v)) - at).squaredNorm());
    return std::sqrt(least);
}

double IncrementalPaperMetric::delta(Sample& sample, const Vec3& at, double max_distance) const
{
    const int nearest = nearest_.index(at, max_distance);
    if (std::find(sample.vertices.begin(), sample.vertices.end(), nearest) == sample.vertices.end()) {
        sample.vertices[sample.oldest] = nearest;
        sample.oldest = (sample.oldest + 1) % k_remembered;
    }
    return paper_delta(at, positions_.row(nearest), normals_.row(nearest));
}

bool IncrementalPaperMetric::is_above(const Skeleton& joints, double gain)
{
    const double least = present_.total + gain;
    next_ = present_;
    next_.total = 0;
    std::vector<std::size_t> moved;
    for (std::size_t s = 0; s < samples_.size(); ++s) {
        const int b = samples_[s].bone;
        next_.at[s] = bone_sample(joints.head(b), joints.tail(b), samples_[s].place);
        if (next_.at[s] != present_.at[s]) {
            next_.delta[s] = bound_distance(samples_[s], next_.at[s]);
            moved.push_back(s);
        }
        next_.total += next_.delta[s];
    }
    // The bounds that may fall most come first: they prove most steps worse after few searches.
    std::sort(moved.begin(), moved.end(), [&](std::size_t a, std::size_t b) {
        return std::make_pair(present_.delta[a] - next_.delta[a], a)
            < std::make_pair(present_.delta[b] - next_.delta[b], b);
    });
    for (const std::size_t s : moved) {
        if (next_.total <= least)
            return false;
        const double bound = next_.delta[s];
        next_.delta[s] = delta(samples_[s], next_.at[s], bound);
        next_.total += next_.delta[s] - bound;
    }
    return next_.total > least;
}

}  // namespace garmentfit
