// SPDX-License-Identifier: GPL-3.0-or-later
#include "tightness.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "nearest.h"
#include "quantile.h"
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

/// An edge that runs round a bone.
struct Span {
    int bone;
    double along;  // m, of its middle on the bone's line
    double radius;  // m, from there
    double now, rest;  // m, lengths
};

/// What edges that run round a bone amount to.
class Girdle {
public:
    void add(const Span& span) { add(span, 1); }
    void remove(const Span& span) { add(span, -1); }

    double stretch() const { return now_ / rest_ - 1; }
    double girth() const { return 2 * M_PI * radii_ / count_; }  // m
    double rounds() const { return count_ > 0 ? now_ / girth() : 0; }

private:
    void add(const Span& span, int sign)
    {
        now_ += sign * span.now;
        rest_ += sign * span.rest;
        radii_ += sign * span.radius;
        count_ += sign;
    }

    double now_ = 0, rest_ = 0, radii_ = 0;
    int count_ = 0;
};

/// The most stretched ring of the edges round a part: of those that are wide enough and hold enough rounds.
Girdle tightest_ring(std::vector<Span> spans, const Girdle& all)
{
    std::sort(spans.begin(), spans.end(),
              [](const Span& a, const Span& b) { return std::tie(a.bone, a.along) < std::tie(b.bone, b.along); });
    Girdle tightest = all, ring;
    auto first = spans.begin();
    for (auto last = spans.begin(); last != spans.end(); ++last) {
        if (last->bone != first->bone) {
            ring = {};
            first = last;
        }
        ring.add(*last);
        const auto is_ring
            = [&] { return last->along - first->along >= k_ring_width && ring.rounds() >= k_ring_rounds; };
        if (!is_ring())
            continue;
        for (; is_ring(); ring.remove(*first++))
            if (ring.stretch() > tightest.stretch())
                tightest = ring;
    }
    return tightest;
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
    std::array<Girdle, k_body_parts> whole;
    std::array<std::vector<Span>, k_body_parts> spans;
    for (Eigen::Index e = 0; e < edges_.rows(); ++e) {
        const int i = edges_(e, 0), j = edges_(e, 1), part = part_of(bones_[i]);
        const Vec3 edge = positions.row(j) - positions.row(i);
        const int bone = encircled_bone(bones_[i]);
        const Vec3 axis = skeleton_.direction(bone);
        const double rest = (rest_.row(i) - rest_.row(j)).norm();
        if (part < 0 || part != part_of(bones_[j]) || std::abs(edge.dot(axis)) > k_across_bone * edge.norm()
            || rest == 0)
            continue;
        const Vec3 middle = (positions.row(i) + positions.row(j)) / 2;
        const Span span { bone, (middle - skeleton_.head(bone)).dot(axis),
                          distance_to_line(positions.row(i), skeleton_, bone),
                          std::min(edge.norm(), (1 + caught_) * rest), rest };
        whole[part].add(span);
        spans[part].push_back(span);
    }
    std::vector<PartStretch> result;
    for (std::size_t p = 0; p < whole.size(); ++p)
        if (whole[p].rounds() > k_fewest_rounds) {
            const Girdle ring = tightest_ring(std::move(spans[p]), whole[p]);
            result.push_back({ int(p), whole[p].stretch(), whole[p].girth(), ring.stretch(), ring.girth() });
        }
    return result;
}

double Tightness::largest_stretch(const Positions& positions) const
{
    double largest = 0;
    for (const PartStretch& part : measure_parts(positions))
        largest = std::max(largest, part.mean);
    return largest;
}

TooTight Tightness::missing_girth(int part, double girth, double stretch, double growth) const
{
    const double needed = girth * (1 + growth), unstretched = girth / (1 + stretch);
    return { index_, part_name(part), needed - unstretched, needed / unstretched - 1 };
}

std::vector<TooTight> Tightness::list_tight_parts(const Positions& positions, double share, const PerPart& growth) const
{
    std::vector<TooTight> result;
    for (const PartStretch& part : measure_parts(positions))
        if (part.mean > share * allowed_)
            result.push_back(missing_girth(part.part, part.girth, part.mean, growth[part.part]));
    return sort_worst_first(result);
}

std::vector<TooTight> Tightness::list_tight_parts_at_rest(const Positions& positions) const
{
    if (quantile(stretches(rest_, positions, edges_), k_stretch_quantile) < allowed_)
        return list_tight_parts(positions, 1, {});
    std::vector<TooTight> result;
    for (const PartStretch& part : measure_parts(positions))
        if (part.tightest > allowed_)
            result.push_back(missing_girth(part.part, part.tightest_girth, part.tightest, 0));
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
