// SPDX-License-Identifier: GPL-3.0-or-later
#include "sleeve_retraction.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "disjoint_sets.h"
#include "extremity_skin.h"
#include "nearest.h"
#include "segment.h"

namespace garmentfit {
namespace {

constexpr std::array<Extremity, 4> k_ends { lhand_tip, rhand_tip, lfoot_tip, rfoot_tip };
// How far along the bone sleeves are pushed up: clear of the skin that grows with a hand.
constexpr double k_pushed_to = 0.76;
// What hangs together with other cloth further along than this is no sleeve of this limb.
constexpr double k_latest_begin = 0.5;
// Cloth that goes round a limb leaves no wider angle about it open.
constexpr double k_widest_gap = std::numbers::pi / 2;
// Buttons and the like lie no further from the cloth that they belong to, m.
constexpr double k_attached = 0.02;

/// The limb that each point is nearest to, by the hand or foot at its end; -1 for all others. Hands and feet count as lying straight on.
int limb_of(const Vec3& p, const Skeleton& joints)
{
    int limb = -1;
    double least = INFINITY;
    const auto look = [&](int name, const Vec3& from, const Vec3& to) {
        if (const double d = squared_distance_to_segment(p, from, to); d < least) {
            least = d;
            limb = name;
        }
    };
    for (int bone = 0; bone < bone_count; ++bone) {
        const auto end
            = std::find_if(k_ends.begin(), k_ends.end(), [&](Extremity e) { return bone_before(e) == bone; });
        const Vec3& joint = joints.tail(bone);
        if (end == k_ends.end())
            look(-1, joints.head(bone), joint);
        else
            look(*end, joints.head(bone), joint + (joints.tips[*end] - joint).norm() * joints.direction(bone));
    }
    return limb;
}

double widest_gap(std::vector<double> angles)
{
    if (angles.empty())
        return 2 * std::numbers::pi;
    std::sort(angles.begin(), angles.end());
    double widest = angles.front() + 2 * std::numbers::pi - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i)
        widest = std::max(widest, angles[i] - angles[i - 1]);
    return widest;
}

/// A bone with cloth about it.
class Limb {
public:
    Limb(const Skeleton& joints, int bone) :
        head_(joints.head(bone)), along_(joints.direction(bone)), side_(along_.unitOrthogonal()),
        other_(along_.cross(side_)), length_(joints.length(bone))
    {
    }

    double length() const { return length_; }
    double at(const Vec3& p) const { return (p - head_).dot(along_); }
    /// The mean of the points about the bone's line straight on, beyond a place on it; across the line.
    Vec3 middle_beyond(double place, const Positions& points, const std::vector<int>& which) const
    {
        Vec3 sum = Vec3::Zero();
        int count = 0;
        for (const int v : which)
            if (const Vec3 p = points.row(v).transpose(); at(p) > place) {
                sum += p - head_ - at(p) * along_;
                ++count;
            }
        return sum / std::max(1, count);
    }
    const Vec3& along() const { return along_; }

    /// Whether these points go all round the bone's outer half.
    bool is_enclosed(const Positions& points, const std::vector<int>& which) const
    {
        std::vector<double> angles;
        for (const int v : which)
            if (const Vec3 p = points.row(v).transpose(); at(p) > 0.5 * length_)
                angles.push_back(std::atan2((p - head_).dot(other_), (p - head_).dot(side_)));
        return widest_gap(std::move(angles)) < k_widest_gap;
    }

private:
    Vec3 head_, along_, side_, other_;
    double length_;
};

/// Vertices that hang together, of those that are marked alike.
std::map<int, std::vector<int>> pieces_of(const Triangles& triangles, const std::vector<int>& mark, int wanted)
{
    DisjointSets joined(int(mark.size()));
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            if (const int a = triangles(f, k), b = triangles(f, (k + 1) % 3); mark[a] == mark[b])
                joined.join(a, b);
    std::map<int, std::vector<int>> pieces;
    for (int v = 0; v < int(mark.size()); ++v)
        if (mark[v] == wanted)
            pieces[joined.root(v)].push_back(v);
    return pieces;
}

}  // namespace

SleeveRetraction::SleeveRetraction(const Skeleton& joints, const GarmentMesh& garment) : positions_(garment.positions)
{
    std::vector<int> limbs(garment.positions.rows());
    for (std::size_t v = 0; v < limbs.size(); ++v)
        limbs[v] = limb_of(garment.positions.row(Eigen::Index(v)), joints);
    std::vector<char> goes_over(limbs.size(), 0);  // to a vertex of another limb
    for (const auto& corners : garment.triangles.rowwise())
        for (int k = 0; k < 3; ++k)
            if (limbs[corners[k]] != limbs[corners[(k + 1) % 3]])
                goes_over[corners[k]] = goes_over[corners[(k + 1) % 3]] = 1;
    for (const Extremity end : k_ends) {
        const Limb limb(joints, bone_before(end));
        if (ExtremityBend(joints, end).is_stump)
            continue;
        std::vector<int> tube;
        std::vector<std::vector<int>> others;
        for (const auto& [name, piece] : pieces_of(garment.triangles, limbs, end))
            if (limb.is_enclosed(garment.positions, piece))
                tube.insert(tube.end(), piece.begin(), piece.end());
            else
                others.push_back(piece);
        double begin = 0, reach = 0;  // no vertex jumps where the tube goes over into other cloth
        for (const int v : tube) {
            const double at = limb.at(garment.positions.row(v));
            reach = std::max(reach, at);
            if (goes_over[v])
                begin = std::max(begin, at);
        }
        pushed_[end] = reach > limb.length() && begin < k_latest_begin * limb.length();
        if (!pushed_[end])
            continue;
        const double share = (k_pushed_to * limb.length() - begin) / (reach - begin), beyond = reach - limb.length();
        // a sleeve may lead off the bone's line where the hand is bent: its end comes back to it
        const Vec3 off = limb.middle_beyond(reach - 0.3 * beyond, garment.positions, tube);
        const NearestPoint sleeve(garment.positions(tube, Eigen::all));
        for (const auto& piece : others)
            if (std::all_of(piece.begin(), piece.end(),
                            [&](int v) { return sleeve.distance(garment.positions.row(v)) < k_attached; }))
                tube.insert(tube.end(), piece.begin(), piece.end());
        for (const int v : tube)
            if (const double at = limb.at(garment.positions.row(v)); at > begin)
                positions_.row(v)
                    -= (1 - share) * (at - begin) * limb.along() + std::max(0.0, (at - limb.length()) / beyond) * off;
    }
}

bool SleeveRetraction::any() const
{
    return std::any_of(pushed_.begin(), pushed_.end(), [](bool pushed) { return pushed; });
}

std::vector<double> SleeveRetraction::freed(const Positions& skin, const SkinWeights& weights,
                                            const Skeleton& joints) const
{
    std::vector<double> result(skin.rows(), 0);
    for (const Extremity end : k_ends) {
        if (!pushed_[end])
            continue;
        const ExtremityBend bend(joints, end);
        for (Eigen::Index v = 0; v < skin.rows(); ++v)
            result[v] += weight_of(weights, v, bone_before(end)) * bend.share(skin.row(v));
    }
    return result;
}

}  // namespace garmentfit
