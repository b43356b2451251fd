// SPDX-License-Identifier: GPL-3.0-or-later
#include "baselines/relaxation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bone_metric.h"
#include "joint_limits.h"
#include "parallel.h"
#include "search_grids.h"
#include "segment.h"

namespace garmentfit {
namespace {

constexpr double k_rotation_extent = 0.2, k_rotation_spacing = 0.02;  // rad
constexpr double k_bone_extent = 2 * std::numbers::pi / 3;  // rad; phi0

// Parents before children.
using BoneChain = std::vector<int>;
const BoneChain k_spine { lowerback, upperback, thorax, lowerneck, upperneck };
const std::array<BoneChain, 4> k_independent { BoneChain { lhipjoint, lfemur, ltibia },
                                               BoneChain { rhipjoint, rfemur, rtibia },
                                               BoneChain { lclavicle, lhumerus, lradius },
                                               BoneChain { rclavicle, rhumerus, rradius } };

double mean_edge(const GarmentMesh& garment)
{
    const auto edges = edges_of(garment.triangles);
    return (garment.positions(edges.col(0), Eigen::all) - garment.positions(edges.col(1), Eigen::all))
        .rowwise()
        .norm()
        .mean();
}

bool covers(GarmentType type, Bone bone)
{
    const std::vector<Bone> bones = bones_covered_by(type);
    return std::find(bones.begin(), bones.end(), bone) != bones.end();
}

// Upright, the root at the garment's barycentre; for short upper garments, whose root lies below the hem, moved down so that the
// box is that of the neck's base.
Posture start_of(const Rig& rig, const GarmentMesh& garment, GarmentType type)
{
    const Skeleton& own = rig.skeleton;
    Posture posture;
    posture.turn = shortest_arc(rig.up.normalized(), Vec3::UnitY());
    posture.root = garment.positions.colwise().mean();
    if (!covers(type, lfemur))
        posture.root -= (own.tail(thorax) - own.root).norm() * Vec3::UnitY();
    for (int b = 0; b < bone_count; ++b)
        posture.directions[b] = posture.turn * own.direction(b);
    return posture;
}

bool hangs_on(int bone, int ancestor)
{
    while (bone >= 0 && bone != ancestor)
        bone = parent_of(bone);
    return bone == ancestor;
}

// What hangs on the bone turns with it.
Posture with_bone_along(Posture posture, int bone, const Vec3& direction)
{
    const Eigen::Quaterniond turn = shortest_arc(posture.directions[bone], direction);
    for (int b = bone + 1; b < bone_count; ++b)
        if (hangs_on(b, bone))
            posture.directions[b] = turn * posture.directions[b];
    posture.directions[bone] = direction;
    return posture;
}

// The chest has more room than any sleeve, but the body's own chest is there: the upper arm may not fold into it either.
bool is_in_trunk(int bone, const Skeleton& joints, const std::array<double, bone_count>& radii)
{
    if (bone != lhumerus && bone != rhumerus && bone != lradius && bone != rradius)
        return false;
    for (const int spine : { lowerback, upperback, thorax })
        for (int i = 0; i < k_samples; ++i)
            if (distance_to_segment(bone_sample(joints.head(bone), joints.tail(bone), i), joints.head(spine),
                                    joints.tail(spine))
                < radii[spine] + radii[bone])
                return true;
    return false;
}

class Search {
public:
    Search(const Rig& rig, const ErrorMetric& metric, const std::vector<Bone>& covered, const Relaxation& r) :
        own_(rig.skeleton), limits_(rig), radii_(figure_of(rig, covered).radii), metric_(metric), covered_(covered),
        r_(r)
    {
    }

    Relaxed translated(const Posture& present, double scale) const
    {
        return best_whole(present, grid_offsets(scale * r_.translation_extent, scale * r_.translation_spacing),
                          [&](const Vec3& offset) {
                              Posture moved = present;
                              moved.root += offset;
                              return moved;
                          });
    }

    Relaxed rotated(const Posture& present, double scale) const
    {
        return best_whole(present, grid_offsets(scale * r_.rotation_extent, scale * r_.rotation_spacing),
                          [&](const Vec3& rotation_vector) {
                              const Eigen::Quaterniond turn = turned_by(rotation_vector);
                              Posture moved = present;
                              moved.turn = (turn * present.turn).normalized();
                              for (Vec3& direction : moved.directions)
                                  direction = turn * direction;
                              return moved;
                          });
    }

    Relaxed chain_turned(const Posture& present, const BoneChain& chain, double scale) const
    {
        Relaxed result { present };
        for (const int b : chain)
            if (std::find(covered_.begin(), covered_.end(), b) != covered_.end()) {
                const Relaxed turned = bone_turned(result.posture, b, scale);
                result = { turned.posture, 0, result.bone_evaluations + turned.bone_evaluations };
            }
        return result;
    }

private:
    // The first of the best: grids begin at the present posture and are sorted by distance from it.
    template <class Moved>
    Relaxed best_whole(const Posture& present, const std::vector<Vec3>& grid, const Moved& moved) const
    {
        std::vector<double> scores(grid.size());
        parallel_for<std::size_t>(
            grid.size(), [&](std::size_t i) { scores[i] = metric_.total(place_bones(own_, moved(grid[i]))); }, 16);
        const auto best = std::max_element(scores.begin(), scores.end()) - scores.begin();
        return { best == 0 ? present : moved(grid[best]), static_cast<long long>(grid.size()) };
    }

    Relaxed bone_turned(const Posture& present, int bone, double scale) const
    {
        Relaxed best { present };
        double best_score = metric_.of_bone(bone, place_bones(own_, present));
        const double spacing = scale * r_.bone_spacing / own_.length(bone);
        for (const Vec3& direction : directions_about(present.directions[bone], scale * r_.bone_extent, spacing)) {
            const PlacedBones bones = place_bones(own_, with_bone_along(present, bone, direction));
            if (!is_human(bone, bones))
                continue;
            ++best.bone_evaluations;
            if (const double score = metric_.of_bone(bone, bones); score > best_score) {
                best_score = score;
                best.posture = with_bone_along(present, bone, direction);
            }
        }
        return best;
    }

    bool is_human(int bone, const PlacedBones& bones) const
    {
        const Vec3 direction = bones.joints.direction(bone);
        if ((bone == lradius || bone == rradius)
            && folds_into_chest(bones.joints.direction(parent_of(parent_of(bone))), direction))
            return false;
        return !is_in_trunk(bone, bones.joints, radii_)
            && limits_.excess(bone, bones.parent_turn(bone), direction) == 0;
    }

    const Skeleton& own_;
    JointLimits limits_;
    std::array<double, bone_count> radii_;  // m, of limbs
    const ErrorMetric& metric_;
    const std::vector<Bone>& covered_;
    const Relaxation& r_;
};

}  // namespace

Relaxation relaxation_of(const Rig& rig, const GarmentMesh& garment, GarmentType type, int iterations)
{
    const double edge = mean_edge(garment);
    const Vec3 low = garment.positions.colwise().minCoeff(), high = garment.positions.colwise().maxCoeff();
    return { start_of(rig, garment, type), (high - low) / 2, edge,     k_rotation_extent,
             k_rotation_spacing,           k_bone_extent,    edge / 2, iterations };
}

Relaxed relaxed(const Rig& rig, const ErrorMetric& metric, const std::vector<Bone>& covered,
                const Relaxation& relaxation, const Progress& progress)
{
    const Search search(rig, metric, covered, relaxation);
    Relaxed present { relaxation.start };
    const auto take = [&](const Relaxed& next) {
        present = { next.posture, present.evaluations + next.evaluations,
                    present.bone_evaluations + next.bone_evaluations };
    };
    for (int i = 0; i < relaxation.iterations; ++i) {
        const double scale = std::pow(0.5, i);
        const Progress round = progress.part(double(i) / relaxation.iterations, double(i + 1) / relaxation.iterations);
        round.at(0);
        take(search.translated(present.posture, scale));
        round.at(0.5);
        take(search.rotated(present.posture, scale));
        take(search.chain_turned(present.posture, k_spine, scale));
        round.at(0.7);
        std::array<Relaxed, k_independent.size()> limbs;
        parallel_for<std::size_t>(limbs.size(), [&](std::size_t l) {
            limbs[l] = search.chain_turned(present.posture, k_independent[l], scale);
        });
        for (std::size_t l = 0; l < limbs.size(); ++l) {
            for (const int b : k_independent[l])
                present.posture.directions[b] = limbs[l].posture.directions[b];
            present.bone_evaluations += limbs[l].bone_evaluations;
        }
    }
    return present;
}

}  // namespace garmentfit
