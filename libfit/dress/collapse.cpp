// SPDX-License-Identifier: GPL-3.0-or-later
#include "collapse.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace garmentfit {
namespace {

// derived: bones, then what lies beyond the last joints
constexpr int k_segments = int(bone_count) + int(extremity_count);

/// The skeleton as a tree of segments, distances measured along it.
class SkeletonTree {
public:
    struct Place {
        int segment;
        double at;  ///< metres from the segment's head
    };

    explicit SkeletonTree(const Skeleton& skeleton) : skeleton_(skeleton)
    {
        for (int s = 0; s < k_segments; ++s) {
            length_[s] = (tail(s) - head(s)).norm();
            depth_[s] = parent(s) < 0 ? 0 : depth_[parent(s)] + length_[parent(s)];
        }
    }

    Vec3 point(const Place& p) const
    {
        return length_[p.segment] > 0
            ? Vec3(head(p.segment) + p.at / length_[p.segment] * (tail(p.segment) - head(p.segment)))
            : head(p.segment);
    }

    /// The nearest point on a bone, or beyond it on the extremity that it carries.
    Place nearest(const Vec3& p, int bone) const
    {
        Place best = nearest_on(p, bone);
        for (int e = 0; e < extremity_count; ++e)
            if (bone_before(Extremity(e)) == bone)
                if (const Place beyond = nearest_on(p, bone_count + e);
                    (p - point(beyond)).squaredNorm() < (p - point(best)).squaredNorm())
                    best = beyond;
        return best;
    }

    /// The weighted mean: minimises the sum of squared distances along the tree. On each segment the sum is a parabola.
    Place mean(const std::array<Place, 4>& places, const std::array<double, 4>& weights) const
    {
        Place best { 0, 0 };
        double least = INFINITY;
        for (int s = 0; s < k_segments; ++s) {
            std::array<double, 4> along;  // m from the segment's head, with the tree unfolded onto its line
            double total = 0, sum = 0, cost = 0;
            for (int k = 0; k < 4; ++k)
                if (weights[k] > 0) {
                    along[k] = unfold(places[k], s);
                    total += weights[k];
                    sum += weights[k] * along[k];
                }
            const double at = std::clamp(sum / total, 0.0, length_[s]);
            for (int k = 0; k < 4; ++k)
                if (weights[k] > 0)
                    cost += weights[k] * (along[k] - at) * (along[k] - at);
            if (cost < least) {
                least = cost;
                best = { s, at };
            }
        }
        return best;
    }

private:
    const Vec3& head(int s) const { return s < bone_count ? skeleton_.head(s) : skeleton_.tail(parent(s)); }
    const Vec3& tail(int s) const { return s < bone_count ? skeleton_.tail(s) : skeleton_.tips[s - bone_count]; }
    static int parent(int s) { return s < bone_count ? parent_of(s) : bone_before(Extremity(s - bone_count)); }

    static bool is_above(int ancestor, int s)
    {
        while (s >= 0 && s != ancestor)
            s = parent(s);
        return s == ancestor;
    }

    /// From the head of segment `a` to the place, along the tree.
    double from_head(int a, const Place& p) const
    {
        int common = parent(a);
        while (common >= 0 && !is_above(common, p.segment))
            common = parent(common);
        if (common == p.segment)  // the tree path leaves that segment at its tail, or the place lies towards the root
            return depth_[a] - depth_[common] - p.at;
        const double branch = common < 0 ? 0 : depth_[common] + length_[common];
        return (depth_[a] - branch) + (depth_[p.segment] + p.at - branch);
    }

    /// Where the place lies on the line of segment `s` when the tree is unfolded onto it; metres from the head.
    double unfold(const Place& p, int s) const
    {
        if (p.segment == s)
            return p.at;
        return is_above(s, p.segment) ? depth_[p.segment] + p.at - depth_[s] : -from_head(s, p);
    }

    Place nearest_on(const Vec3& p, int s) const
    {
        const Vec3 along = tail(s) - head(s);
        const double t = length_[s] > 0 ? (p - head(s)).dot(along) / length_[s] : 0;
        return { s, std::clamp(t, 0.0, length_[s]) };
    }

    const Skeleton& skeleton_;
    std::array<double, k_segments> length_ {}, depth_ {};  // depth: from the root to the head
};

}  // namespace

Positions collapse(const Positions& positions, const SkinWeights& weights, const Skeleton& skeleton)
{
    const SkeletonTree tree(skeleton);
    Positions result(positions.rows(), 3);
    for (Eigen::Index v = 0; v < positions.rows(); ++v) {
        std::array<SkeletonTree::Place, 4> places {};
        std::array<double, 4> shares {};
        for (int k = 0; k < 4; ++k)
            if ((shares[k] = weights.weights(v, k)) > 0)
                places[k] = tree.nearest(positions.row(v), weights.bones(v, k));
        result.row(v) = tree.point(tree.mean(places, shares));
    }
    return result;
}

}  // namespace garmentfit
