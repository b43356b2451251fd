// SPDX-License-Identifier: GPL-3.0-or-later
#include "tightness.h"

#include <algorithm>
#include <cmath>

#include "nearest.h"
#include "skin_weights.h"
#include "stretch.h"
#include "tuning.h"

namespace garmentfit {
namespace {

// The hip joints point sideways: what goes round the hips goes round the spine.
int encircled_bone(int bone) { return bone == lhipjoint || bone == rhipjoint ? int(lowerback) : bone; }

// m, from the bone's line.
double distance_to_line(const Vec3& p, const Skeleton& skeleton, int bone)
{
    const Vec3 out = p - skeleton.head(bone), axis = skeleton.direction(bone);
    return (out - out.dot(axis) * axis).norm();
}

std::vector<TooTight> sort_worst_first(std::vector<TooTight> parts)
{
    std::sort(parts.begin(), parts.end(),
              [](const auto& a, const auto& b) { return a.missing_girth > b.missing_girth; });
    return parts;
}

}  // namespace

Tightness::Tightness(const Positions& rest, const Edges& edges, const SkinWeights& weights, const Skeleton& skeleton,
                     double allowed, int index) :
    rest_(rest),
    edges_(edges), skeleton_(skeleton), allowed_(allowed),
    caught_(std::max(k_caught_stretch, k_caught_share * allowed)), index_(index), bones_(strongest_bones(weights))
{
}

std::vector<Tightness::PartStretch> Tightness::measure_parts(const Positions& positions) const
{
    struct Sums {
        double now = 0, rest = 0, radius = 0;
        std::vector<EdgeStretch> edges;
    };
    std::array<Sums, k_body_parts> sums;
    for (Eigen::Index e = 0; e < edges_.rows(); ++e) {
        const int i = edges_(e, 0), j = edges_(e, 1), part = part_of(bones_[i]);
        const Vec3 edge = positions.row(j) - positions.row(i);
        const int bone = encircled_bone(bones_[i]);
        if (part < 0 || part != part_of(bones_[j])
            || std::abs(edge.dot(skeleton_.direction(bone))) > k_across_bone * edge.norm())
            continue;
        Sums& s = sums[part];
        const double rest = (rest_.row(i) - rest_.row(j)).norm();
        s.now += std::min(edge.norm(), (1 + caught_) * rest);
        s.rest += rest;
        s.radius += distance_to_line(positions.row(i), skeleton_, bone);
        s.edges.push_back({ rest > 0 ? edge.norm() / rest - 1 : 0, rest });
    }
    std::vector<PartStretch> result;
    for (std::size_t p = 0; p < sums.size(); ++p)
        if (const Sums& s = sums[p]; s.rest > 0)
            if (const double girth = 2 * M_PI * s.radius / double(s.edges.size()); s.now > k_fewest_rounds * girth)
                result.push_back(
                    { int(p), s.now / s.rest - 1, quantile_by_length(s.edges, k_stretch_quantile), girth });
    return result;
}

double Tightness::allowed_at(int part) const
{
    return part == part_of(upperneck) ? std::max(allowed_, k_neck_stretch) : allowed_;
}

double Tightness::needed_size(const Positions& positions, double share) const
{
    double size = 0;
    for (const PartStretch& part : measure_parts(positions))
        size = std::max(size, (1 + part.mean) / (1 + share * allowed_at(part.part)));
    return size;
}

TooTight Tightness::missing_girth(const PartStretch& part, double stretch, double growth) const
{
    const double needed = part.girth * (1 + growth), unstretched = part.girth / (1 + stretch);
    return { index_, part_name(part.part), needed - unstretched, needed / unstretched - 1 };
}

std::vector<TooTight> Tightness::list_tight_parts(const Positions& positions, double share, const PerPart& growth) const
{
    std::vector<TooTight> result;
    for (const PartStretch& part : measure_parts(positions))
        if (part.mean > share * allowed_at(part.part))
            if (const TooTight tight = missing_girth(part, part.mean, growth[part.part]); tight.missing_girth > 0)
                result.push_back(tight);
    return sort_worst_first(result);
}

std::vector<TooTight> Tightness::list_tight_parts_at_rest(const Positions& positions) const
{
    if (quantile_by_length(edge_stretches(rest_, positions, edges_), k_stretch_quantile) < allowed_)
        return list_tight_parts(positions, 1, {});
    std::vector<TooTight> result;
    for (const PartStretch& part : measure_parts(positions))
        if (part.tightest > allowed_at(part.part))
            result.push_back(missing_girth(part, std::min(part.tightest, caught_), 0));
    return sort_worst_first(result);
}

namespace {

/// How much wider than the skin under the cloth something is, as a mean over the vertices of cloth round each part.
/// @param outer  (vertex of the cloth, vertex of the skin under it) -> the point to compare
template <class Outer>
PerPart wider_than(const Positions& skin, const Positions& cloth, const SkinWeights& weights, const Skeleton& skeleton,
                   const Outer& outer)
{
    const std::vector<int> bones = strongest_bones(weights);
    const NearestPoint nearest(skin);
    PerPart wide {}, needed {}, result {};
    for (int v = 0; v < int(cloth.rows()); ++v) {
        const int under = nearest.index(cloth.row(v)), part = part_of(bones[under]),
                  bone = encircled_bone(bones[under]);
        if (part < 0)
            continue;
        wide[part] += distance_to_line(outer(v, under), skeleton, bone);
        needed[part] += distance_to_line(skin.row(under), skeleton, bone);
    }
    for (std::size_t p = 0; p < result.size(); ++p)
        result[p] = needed[p] > 0 ? wide[p] / needed[p] - 1 : 0;
    return result;
}

}  // namespace

PerPart slack(const Positions& cloth, const Positions& body, const SkinWeights& weights, const Skeleton& skeleton)
{
    return wider_than(body, cloth, weights, skeleton, [&](int v, int) { return Vec3(cloth.row(v)); });
}

PerPart growth_left(const Positions& cloth, const Positions& body, const Positions& full, const SkinWeights& weights,
                    const Skeleton& skeleton)
{
    return wider_than(body, cloth, weights, skeleton, [&](int, int under) { return Vec3(full.row(under)); });
}

}  // namespace garmentfit
