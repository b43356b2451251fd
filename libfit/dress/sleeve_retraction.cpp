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
#include "tuning.h"

namespace garmentfit {
namespace {

constexpr std::array<Extremity, 4> k_ends { lhand_tip, rhand_tip, lfoot_tip, rfoot_tip };

/// The limb that a point is nearest to, by the hand or foot at its end; -1 for all other bones. Hands and feet count as
/// straight.
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

/// Radians, between neighbours of a set of directions.
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

/// The last bone of an arm or a leg, as an axis to measure cloth along.
class Limb {
public:
    Limb(const Skeleton& joints, int bone) :
        head_(joints.head(bone)), along_(joints.direction(bone)), side_(along_.unitOrthogonal()),
        other_(along_.cross(side_)), length_(joints.length(bone))
    {
    }

    double length() const { return length_; }
    const Vec3& along() const { return along_; }
    double at(const Vec3& p) const { return (p - head_).dot(along_); }  ///< m, from the head along the bone

    /// The mean offset from the bone's line, across it, of the points beyond a place on the line.
    Vec3 mean_offset_beyond(double place, const Positions& points, const std::vector<int>& which) const
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

    /// Whether these points go all round the outer part of the bone.
    bool is_enclosed_by(const Positions& points, const std::vector<int>& which) const
    {
        std::vector<double> angles;
        for (const int v : which)
            if (const Vec3 p = points.row(v).transpose(); at(p) > k_enclosed_from * length_)
                angles.push_back(std::atan2((p - head_).dot(other_), (p - head_).dot(side_)));
        return widest_gap(std::move(angles)) < k_widest_open_angle;
    }

private:
    Vec3 head_, along_, side_, other_;
    double length_;
};

/// Connected pieces of the vertices with the wanted mark, by their roots.
std::map<int, std::vector<int>> pieces_of(const std::vector<std::array<int, 2>>& links, const std::vector<int>& marks,
                                          int wanted)
{
    DisjointSets joined(int(marks.size()));
    for (const auto& [a, b] : links)
        if (marks[a] == marks[b])
            joined.join(a, b);
    std::map<int, std::vector<int>> pieces;
    for (int v = 0; v < int(marks.size()); ++v)
        if (marks[v] == wanted)
            pieces[joined.root(v)].push_back(v);
    return pieces;
}

/// Pairs of vertices that hang together: by an edge, or by a seam.
std::vector<std::array<int, 2>> links_of(const Triangles& triangles, const std::vector<Tie>& ties)
{
    std::vector<std::array<int, 2>> links;
    for (const auto& corners : triangles.rowwise())
        for (int k = 0; k < 3; ++k)
            links.push_back({ corners[k], corners[(k + 1) % 3] });
    for (const Tie& tie : ties)
        if (tie.is_seam)
            for (int k = 0; k < 3; ++k)
                if (tie.weights[k] > 0)
                    links.push_back({ tie.vertex, tie.corners[k] });
    return links;
}

/// The cloth's vertices told apart by limbs.
struct LimbMap {
    const Positions& positions;
    std::vector<std::array<int, 2>> links;
    std::vector<int> limbs;  // of each vertex, from limb_of
    std::vector<char> is_border;  // linked with a vertex of another limb

    LimbMap(const Skeleton& joints, const TriangleMesh& cloth, const std::vector<Tie>& ties) :
        positions(cloth.positions), links(links_of(cloth.triangles, ties)), limbs(cloth.positions.rows()),
        is_border(limbs.size(), 0)
    {
        for (std::size_t v = 0; v < limbs.size(); ++v)
            limbs[v] = limb_of(positions.row(Eigen::Index(v)), joints);
        for (const auto& [a, b] : links)
            if (limbs[a] != limbs[b])
                is_border[a] = is_border[b] = 1;
    }
};

/// What goes round one limb.
struct Sleeve {
    std::vector<int> vertices;
    std::vector<std::vector<int>> beside;  // other pieces at the limb, that do not go round it
    double begin
        = 0;  // m along the bone; no cloth further along goes over into other cloth, so that no vertex jumps there
    double reach = 0;  // m along the bone, of the hem
};

Sleeve find_sleeve(const LimbMap& map, const Limb& limb, Extremity end)
{
    Sleeve result;
    for (const auto& [root, piece] : pieces_of(map.links, map.limbs, end))
        if (limb.is_enclosed_by(map.positions, piece))
            result.vertices.insert(result.vertices.end(), piece.begin(), piece.end());
        else
            result.beside.push_back(piece);
    for (const int v : result.vertices) {
        const double at = limb.at(map.positions.row(v));
        result.reach = std::max(result.reach, at);
        if (map.is_border[v])
            result.begin = std::max(result.begin, at);
    }
    return result;
}

/// Adds buttons and the like: pieces that lie on the sleeve with all their vertices.
void add_attached_pieces(Sleeve& sleeve, const Positions& positions)
{
    const NearestPoint cloth(positions(sleeve.vertices, Eigen::all));
    for (const auto& piece : sleeve.beside)
        if (std::all_of(piece.begin(), piece.end(),
                        [&](int v) { return cloth.distance(positions.row(v)) < k_attached_distance; }))
            sleeve.vertices.insert(sleeve.vertices.end(), piece.begin(), piece.end());
}

/// Maps the sleeve linearly along the bone, from its begin to k_retracted_end. A sleeve that follows a bent hand leaves
/// the bone's line: its end is drawn back to the line, evenly from the wrist on.
void retract(Sleeve sleeve, const Limb& limb, const Positions& given, Positions& positions)
{
    const double share = (k_retracted_end * limb.length() - sleeve.begin) / (sleeve.reach - sleeve.begin);
    const double beyond = sleeve.reach - limb.length();
    const Vec3 offset = limb.mean_offset_beyond(sleeve.reach - k_hem_share * beyond, given, sleeve.vertices);
    add_attached_pieces(sleeve, given);
    for (const int v : sleeve.vertices)
        if (const double at = limb.at(given.row(v)); at > sleeve.begin)
            positions.row(v) -= (1 - share) * (at - sleeve.begin) * limb.along()
                + std::max(0.0, (at - limb.length()) / beyond) * offset;
}

}  // namespace

SleeveRetraction::SleeveRetraction(const Skeleton& joints, const TriangleMesh& cloth, const std::vector<Tie>& ties) :
    positions_(cloth.positions)
{
    const LimbMap map(joints, cloth, ties);
    for (const Extremity end : k_ends) {
        if (ExtremityBend(joints, end).is_stump)
            continue;
        const Limb limb(joints, bone_before(end));
        const Sleeve sleeve = find_sleeve(map, limb, end);
        retracted_[end] = sleeve.reach > limb.length() && sleeve.begin < k_latest_sleeve_begin * limb.length();
        if (retracted_[end])
            retract(sleeve, limb, cloth.positions, positions_);
    }
}

bool SleeveRetraction::is_any() const
{
    return std::any_of(retracted_.begin(), retracted_.end(), [](bool retracted) { return retracted; });
}

std::vector<double> SleeveRetraction::min_scales(const Positions& skin, const SkinWeights& weights,
                                                 const Skeleton& joints) const
{
    std::vector<double> result(skin.rows(), 0);
    for (const Extremity end : k_ends) {
        if (!retracted_[end])
            continue;
        const ExtremityBend bend(joints, end);
        for (Eigen::Index v = 0; v < skin.rows(); ++v)
            result[v] += weight_of(weights, v, bone_before(end)) * bend.share(skin.row(v));
    }
    return result;
}

}  // namespace garmentfit
