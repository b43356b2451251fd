// SPDX-License-Identifier: GPL-3.0-or-later
#include "tightness.h"

#include <algorithm>
#include <cmath>

#include "nearest.h"
#include "skin_weights.h"
#include "stretch.h"

namespace garmentfit {
namespace {

// Edges within 30 degrees of "across the bone" run round it.
constexpr double k_across = 0.5;
// A part speaks when its edges would go round it this often: a hem that just reaches it does not stretch as a whole.
constexpr double k_fewest_rounds = 6;
// Single edges stretch for many reasons; what counts is what all but a twentieth of them stay below.
constexpr double k_most = 0.95;
// An edge that is stretched by more than half is caught somewhere (a cuff on a thumb), and no more a measure of girth.
constexpr double k_caught = 0.5;

// The hip joints point sideways: what goes round the hips goes round the spine.
int bone_inside(int bone) { return bone == lhipjoint || bone == rhipjoint ? int(lowerback) : bone; }

// Metres from the bone that it goes round, or from the bone's line.
double radius(const Vec3& p, const Skeleton& skeleton, int bone)
{
    const Vec3 out = p - skeleton.head(bone), axis = skeleton.direction(bone);
    return (out - out.dot(axis) * axis).norm();
}

std::vector<TooTight> worst_first(std::vector<TooTight> parts)
{
    std::sort(parts.begin(), parts.end(),
              [](const auto& a, const auto& b) { return a.missing_girth > b.missing_girth; });
    return parts;
}

}  // namespace

Tightness::Tightness(const GarmentMesh& garment, const SkinWeights& weights, const Skeleton& skeleton, int index) :
    garment_(garment), skeleton_(skeleton), index_(index), bones_(strongest_bones(weights))
{
}

std::vector<Tightness::Round> Tightness::rounds(const Positions& positions) const
{
    struct Sums {
        double now = 0, rest = 0, radius = 0;
        std::vector<double> stretches;
    };
    std::array<Sums, k_body_parts> sums;
    const auto edges = edges_of(garment_.triangles);
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        const int i = edges(e, 0), j = edges(e, 1), part = part_of(bones_[i]);
        const Vec3 edge = positions.row(j) - positions.row(i);
        const int bone = bone_inside(bones_[i]);
        if (part < 0 || part != part_of(bones_[j])
            || std::abs(edge.dot(skeleton_.direction(bone))) > k_across * edge.norm())
            continue;
        Sums& s = sums[part];
        const double rest = (garment_.positions.row(i) - garment_.positions.row(j)).norm();
        s.now += std::min(edge.norm(), (1 + k_caught) * rest);
        s.rest += rest;
        s.radius += radius(positions.row(i), skeleton_, bone);
        s.stretches.push_back(rest > 0 ? edge.norm() / rest - 1 : 0);
    }
    std::vector<Round> result;
    for (std::size_t p = 0; p < sums.size(); ++p)
        if (const Sums& s = sums[p]; s.rest > 0)
            if (const double girth = 2 * M_PI * s.radius / double(s.stretches.size()); s.now > k_fewest_rounds * girth)
                result.push_back({ int(p), s.now / s.rest - 1, quantile(s.stretches, k_most), girth });
    return result;
}

double Tightness::largest_stretch(const Positions& positions) const
{
    double largest = 0;
    for (const Round& round : rounds(positions))
        largest = std::max(largest, round.stretch);
    return largest;
}

TooTight Tightness::missing(const Round& round, double stretch, double growth) const
{
    const double needed = round.girth * (1 + growth), unstretched = round.girth / (1 + stretch);
    return { index_, part_name(round.part), needed - unstretched, needed / unstretched - 1 };
}

std::vector<TooTight> Tightness::too_tight(const Positions& positions, double allowed, const PerPart& growth) const
{
    std::vector<TooTight> result;
    for (const Round& round : rounds(positions))
        if (round.stretch > allowed)
            result.push_back(missing(round, round.stretch, growth[round.part]));
    return worst_first(result);
}

std::vector<TooTight> Tightness::too_tight_at_rest(const Positions& positions, double allowed) const
{
    if (quantile(stretches(garment_, positions), k_most) < allowed)
        return too_tight(positions, allowed, {});
    std::vector<TooTight> result;
    for (const Round& round : rounds(positions))
        if (round.tightest > allowed)
            result.push_back(missing(round, std::min(round.tightest, k_caught), 0));
    return worst_first(result);
}

namespace {

/// How much wider than the skin under each vertex of cloth something is, on the mean round each part.
/// @param outer  (vertex of the cloth, of the skin under it) -> the place to compare
template <class Outer>
PerPart wider_than(const Positions& skin, const Positions& cloth, const SkinWeights& weights, const Skeleton& skeleton,
                   const Outer& outer)
{
    const std::vector<int> bones = strongest_bones(weights);
    const NearestPoint nearest(skin);
    PerPart wide {}, needed {}, result {};
    for (int v = 0; v < int(cloth.rows()); ++v) {
        const int under = nearest.index(cloth.row(v)), part = part_of(bones[under]), bone = bone_inside(bones[under]);
        if (part < 0)
            continue;
        wide[part] += radius(outer(v, under), skeleton, bone);
        needed[part] += radius(skin.row(under), skeleton, bone);
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
