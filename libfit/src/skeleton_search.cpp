// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace fit {
namespace {

constexpr double k_crossing = 10;        // m; more than any room can repay
constexpr double k_ease = 0.01;          // m/rad^2; worn bones stay near ease among near equals
constexpr double k_own_pose = 0.05;      // m/rad^2; bare limbs stay near the body's own pose
constexpr double k_limit = 2;            // m/rad beyond a joint's range
constexpr double k_upright = 0.5;        // m/rad^2; the trunk stands
constexpr double k_sag = 3;              // m/m; a shirt hangs from the shoulders, trousers are pulled up
constexpr double k_front = 0.3;          // m; for each opening that faces forwards
constexpr double k_own_front = 0.1;      // m; where the garment does not tell its front, the body keeps its own
constexpr double k_empty = 6;            // m/m; mean distance of the cloth from the nearest limb that could fill it
constexpr double k_far_cloth = 0.3;      // m; cloth further away than this is just far: trains, wide skirts
constexpr double k_cover_cells = 12, k_coarse_cover_cells = 6;  // along the garment's longest side
constexpr double k_better = 1e-9;        // m; below this two poses are equal, and the nearer one wins

constexpr std::array<int, 7> k_trunk { lhipjoint, rhipjoint, lowerback, upperback, thorax, lclavicle, rclavicle };

double angle_between(const Vec3& a, const Vec3& b) { return std::acos(std::clamp(a.dot(b), -1.0, 1.0)); }

// One point, the mean, for each cell that has cloth.
Eigen::ArrayX3f spread_points(const ClothRoom& cloth, double cells)
{
    const double cell = (cloth.high() - cloth.low()).maxCoeff() / cells;
    std::map<std::tuple<int, int, int>, std::pair<Vec3, int>> sums;
    for (Eigen::Index i = 0; i < cloth.points().rows(); ++i) {
        const Vec3 p = cloth.points().row(i);
        const Eigen::Vector3i c = ((p - cloth.low()) / cell).array().floor().cast<int>();
        auto& [sum, count] = sums.try_emplace({ c.x(), c.y(), c.z() }, Vec3(Vec3::Zero()), 0).first->second;
        sum += p;
        ++count;
    }
    Eigen::ArrayX3f points(sums.size(), 3);
    Eigen::Index row = 0;
    for (const auto& [key, value] : sums)
        points.row(row++) = (value.first / value.second).cast<float>().transpose();
    return points;
}

bool by_norm(const Vec3& a, const Vec3& b)
{
    return std::make_tuple(a.squaredNorm(), a.y(), a.x(), a.z()) < std::make_tuple(b.squaredNorm(), b.y(), b.x(), b.z());
}

Eigen::Quaterniond turned_by(const Vec3& rotation_vector)
{
    const double angle = rotation_vector.norm();
    if (angle == 0)
        return Eigen::Quaterniond::Identity();
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation_vector / angle));
}

}  // namespace

std::vector<Vec3> directions_about(const Vec3& axis, double extent, double spacing)
{
    const Eigen::Quaterniond from_z = shortest_arc(Vec3::UnitZ(), axis);
    std::vector<Vec3> directions { axis };
    for (double phi = spacing; phi <= std::min(extent, std::numbers::pi) + 1e-9; phi += spacing) {
        const int count = std::max(1, int(std::ceil(2 * std::numbers::pi * std::sin(phi) / spacing)));
        for (int i = 0; i < count; ++i) {
            const double theta = 2 * std::numbers::pi * i / count;
            directions.push_back(from_z * Vec3(std::sin(phi) * std::cos(theta), std::sin(phi) * std::sin(theta), std::cos(phi)));
        }
    }
    return directions;
}

std::vector<Vec3> grid_offsets(double extent, double spacing)
{
    const int n = int(std::floor(extent / spacing + 1e-9));
    std::vector<Vec3> offsets;
    for (int x = -n; x <= n; ++x)
        for (int y = -n; y <= n; ++y)
            for (int z = -n; z <= n; ++z)
                offsets.push_back(spacing * Vec3(x, y, z));
    std::sort(offsets.begin(), offsets.end(), by_norm);
    return offsets;
}

/// The bones of a limb so far.
struct SkeletonSearch::Chain {
    Vec3 tail;
    Eigen::Quaterniond turn;
    std::array<Vec3, 2> directions;
    double score = 0;
    CoverDistances distances;
};

SkeletonSearch::SkeletonSearch(const Rig& rig, const JointLimits& limits, const BoneMetric& metric, const Vec3& front)
    : rig_(rig)
    , limits_(limits)
    , metric_(metric)
    , cover_(spread_points(metric.cloth(), k_cover_cells))
    , coarse_cover_(spread_points(metric.cloth(), k_coarse_cover_cells))
    , front_(front)
    , hangs_from_shoulders_(metric.figure().covered[lclavicle])
{
}

// Worn bones and the trunk would be at ease, bare limbs as they were given; nobody leaves the range of a joint.
double SkeletonSearch::posture_cost(int bone, const Vec3& direction, const Eigen::Quaterniond& parent_turn) const
{
    const bool in_trunk = std::find(k_trunk.begin(), k_trunk.end(), bone) != k_trunk.end();
    const bool eased = metric_.figure().covered[bone] || in_trunk;
    const Vec3 wish = eased ? limits_.at_ease(bone, parent_turn) : parent_turn * rig_.skeleton.direction(bone);
    const double angle = angle_between(direction, wish);
    return (eased ? k_ease : k_own_pose) * angle * angle + k_limit * limits_.excess(bone, parent_turn, direction);
}

double SkeletonSearch::bone_energy(int bone, const Vec3& head, const Vec3& tail, const Eigen::Quaterniond& parent_turn) const
{
    return metric_.value(bone, head, tail) - posture_cost(bone, (tail - head).normalized(), parent_turn);
}

double SkeletonSearch::stance_energy(const Posture& posture) const
{
    const Vec3 front = posture.turn * rig_.front;
    const double tilt = angle_between(posture.turn * rig_.up.normalized(), Vec3::UnitY());
    const double facing = k_front * front.dot(front_) + k_own_front * front.dot(rig_.front);
    return (hangs_from_shoulders_ ? k_sag : -k_sag) * posture.root.y() - k_upright * tilt * tilt + facing;
}

void SkeletonSearch::lower_distances(CoverDistances& distances, int bone, const Vec3& head, const Vec3& tail) const
{
    const auto& points = distances.rows() == cover_.rows() ? cover_ : coarse_cover_;
    const Eigen::Array3f a = head.cast<float>(), ab = (tail - head).cast<float>();
    const float inverse = 1 / ab.square().sum();
    const Eigen::ArrayXf x = points.col(0) - a.x(), y = points.col(1) - a.y(), z = points.col(2) - a.z();
    const Eigen::ArrayXf t = ((x * ab.x() + y * ab.y() + z * ab.z()) * inverse).max(0.f).min(1.f);
    const float radius = float(metric_.figure().radii[bone]);
    distances = distances.min(((x - t * ab.x()).square() + (y - t * ab.y()).square() + (z - t * ab.z()).square()).sqrt() - radius);
    distances = distances.max(0.f);
}

SkeletonSearch::CoverDistances SkeletonSearch::cover_distances(const PlacedBones& bones, const Limb* without, bool coarse) const
{
    CoverDistances distances = CoverDistances::Constant((coarse ? coarse_cover_ : cover_).rows(), k_far_cloth);
    for (int b = 0; b < bone_count; ++b)
        if (metric_.figure().covered[b] && !(without && (b == without->bones[0] || b == without->bones[1])))
            lower_distances(distances, b, bones.joints.head(b), bones.joints.tail(b));
    return distances;
}

double SkeletonSearch::emptiness(const CoverDistances& distances) const { return k_empty * double(distances.mean()); }

double SkeletonSearch::energy(const Posture& posture) const
{
    const PlacedBones bones = placed(rig_.skeleton, posture);
    double sum = stance_energy(posture) - emptiness(cover_distances(bones, nullptr, false));
    for (int b = 0; b < bone_count; ++b)
        sum += bone_energy(b, bones.joints.head(b), bones.joints.tail(b), bones.parent_turn(b));
    for (int e = 0; e < extremity_count; ++e)
        sum += metric_.bare_tip(Extremity(e), bones.joints.tail(bone_before(Extremity(e))), bones.joints.tips[e]);
    return sum;
}

int SkeletonSearch::crossings(const Posture& posture) const
{
    const Skeleton joints = placed(rig_.skeleton, posture).joints;
    int count = 0;
    for (int b = 0; b < bone_count; ++b)
        count += metric_.cloth().crosses(joints.head(b), joints.tail(b));
    for (int e = 0; e < extremity_count; ++e)
        count += metric_.cloth().crosses(joints.tail(bone_before(Extremity(e))), joints.tips[e]);
    return count;
}

Posture SkeletonSearch::at_ease(const Vec3& root, const Eigen::Quaterniond& turn) const
{
    Posture posture { root, turn, {} };
    std::array<Eigen::Quaterniond, bone_count> turns;
    for (int b = 0; b < bone_count; ++b) {
        const Eigen::Quaterniond parent_turn = parent_of(b) < 0 ? turn : turns[parent_of(b)];
        posture.directions[b] = limits_.at_ease(b, parent_turn);
        turns[b] = bone_turn(rig_.skeleton, b, parent_turn, posture.directions[b]);
    }
    return posture;
}

double SkeletonSearch::trunk_energy(const Posture& posture) const
{
    const PlacedBones bones = placed(rig_.skeleton, posture);
    double sum = stance_energy(posture);
    for (const int b : k_trunk)
        sum += bone_energy(b, bones.joints.head(b), bones.joints.tail(b), bones.parent_turn(b));
    return sum;
}

double SkeletonSearch::largest_limb_energy() const
{
    double sum = 0;
    for (const Limb& limb : k_limbs)
        for (const int b : limb.bones)
            if (metric_.figure().covered[b])
                sum += 5 * 1.15 * metric_.figure().radii[b];
    return sum;
}

template <class Moved>
Posture SkeletonSearch::best_of(const Posture& present, const Reach& reach, const std::vector<Vec3>& offsets, Moved moved) const
{
    const auto penalty = [&](const Posture& p) { return reach.exact ? k_crossing * crossings(p) : 0.0; };
    Posture best = present;
    double best_score = energy(present) - penalty(present);
    for (const Vec3& offset : offsets) {
        const Posture candidate = moved(offset);
        const double score = energy(candidate);
        if (score <= best_score + k_better)
            continue;
        if (const double exact = score - penalty(candidate); exact > best_score + k_better) {
            best = candidate;
            best_score = exact;
        }
    }
    return best;
}

Posture SkeletonSearch::translated(const Posture& present, const Reach& reach) const
{
    return best_of(present, reach, grid_offsets(reach.extent, reach.spacing), [&](const Vec3& offset) {
        Posture moved = present;
        moved.root += offset;
        return moved;
    });
}

// About the middle of the trunk: a turn about the root would swing the shoulders out of the garment.
Posture SkeletonSearch::rotated(const Posture& present, const Reach& reach) const
{
    const Skeleton joints = placed(rig_.skeleton, present).joints;
    const Vec3 centre = hangs_from_shoulders_ ? joints.tail(thorax) : joints.root;
    return best_of(present, reach, grid_offsets(reach.extent, reach.spacing), [&](const Vec3& offset) {
        const Eigen::Quaterniond turn = turned_by(offset);
        Posture moved = present;
        moved.root = centre + turn * (present.root - centre);
        moved.turn = (turn * present.turn).normalized();
        for (Vec3& direction : moved.directions)
            direction = turn * direction;
        return moved;
    });
}

// Bends the spine and the clavicles, one bone at a time; what hangs on them keeps its directions.
Posture SkeletonSearch::trunk_bent(const Posture& present, const Reach& reach) const
{
    Posture best = present;
    for (const int b : { lowerback, upperback, thorax, lclavicle, rclavicle })
        best = best_of(best, reach, directions_about(best.directions[b], reach.extent, reach.spacing), [&](const Vec3& direction) {
            Posture moved = best;
            moved.directions[b] = direction;
            return moved;
        });
    return best;
}

// A limb fills a tube of its own where the garment covers its lower bone, or is a sleeve; legs in a skirt share theirs.
bool SkeletonSearch::fills_tube(const Limb& limb) const
{
    const bool is_leg = limb.end == lfoot_tip || limb.end == rfoot_tip;
    return metric_.figure().covered[limb.bones[is_leg ? 1 : 0]];
}

std::vector<SkeletonSearch::Chain> SkeletonSearch::extended(const Chain& chain, const Limb& limb, int link, const Vec3& start,
                                                            const Vec3& clavicle, const Reach& reach) const
{
    const int bone = limb.bones[link];
    const bool explains = chain.distances.size() > 0;
    const bool worn = metric_.figure().covered[bone];
    const bool forearm = bone == lradius || bone == rradius;
    std::vector<Chain> result;
    for (const Vec3& direction : directions_about(start, reach.extent, reach.spacing)) {
        if (worn && (limits_.excess(bone, chain.turn, direction) > 0 || (forearm && folds_into_chest(clavicle, direction))))
            continue;
        Chain next = chain;
        next.directions[link] = direction;
        next.tail = chain.tail + rig_.skeleton.length(bone) * direction;
        next.score += bone_energy(bone, chain.tail, next.tail, chain.turn);
        if (explains && worn) {
            lower_distances(next.distances, bone, chain.tail, next.tail);
            next.score += emptiness(chain.distances) - emptiness(next.distances);
        }
        next.turn = bone_turn(rig_.skeleton, bone, chain.turn, direction);
        result.push_back(std::move(next));
    }
    return result;
}

Vec3 SkeletonSearch::tip_of(const Limb& limb, const Chain& chain) const
{
    return chain.tail + chain.turn * (rig_.skeleton.tips[limb.end] - rig_.skeleton.tail(limb.bones[1]));
}

double SkeletonSearch::tip_energy(const Limb& limb, const Chain& chain) const
{
    return metric_.bare_tip(limb.end, chain.tail, tip_of(limb, chain));
}

Posture SkeletonSearch::limb_moved(const Posture& present, const Limb& limb, const Reach& reach) const
{
    const PlacedBones bones = placed(rig_.skeleton, present);
    const auto [upper, lower] = limb.bones;
    const Vec3 parent_direction = bones.joints.direction(parent_of(upper));
    const auto better = [](const Chain& a, const Chain& b) { return a.score > b.score; };
    const auto crosses = [&](const Vec3& from, const Vec3& to) { return reach.exact && metric_.cloth().crosses(from, to); };

    Chain root { bones.joints.head(upper), bones.parent_turn(upper), { Vec3::Zero(), Vec3::Zero() }, 0, {} };
    if (fills_tube(limb))
        root.distances = cover_distances(bones, &limb, !reach.exact);
    std::vector<Chain> uppers = extended(root, limb, 0, present.directions[upper], parent_direction, reach);
    std::stable_sort(uppers.begin(), uppers.end(), better);

    Chain best;
    bool found = false;
    int kept = 0;
    for (const Chain& first : uppers) {
        if (crosses(root.tail, first.tail))
            continue;
        if (++kept > reach.beam)
            break;
        const Vec3 start = shortest_arc(present.directions[upper], first.directions[0]) * present.directions[lower];
        std::vector<Chain> lowers = extended(first, limb, 1, start, parent_direction, reach);
        for (Chain& second : lowers)
            second.score += tip_energy(limb, second);
        std::stable_sort(lowers.begin(), lowers.end(), better);
        for (const Chain& second : lowers) {
            if (found && second.score <= best.score + k_better)
                break;
            if (crosses(first.tail, second.tail) || crosses(second.tail, tip_of(limb, second)))
                continue;
            best = second;
            found = true;
            break;
        }
    }
    if (!found)
        return present;
    Posture moved = present;
    moved.directions[upper] = best.directions[0];
    moved.directions[lower] = best.directions[1];
    return moved;
}

}  // namespace fit
