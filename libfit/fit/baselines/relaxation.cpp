// SPDX-License-Identifier: GPL-3.0-or-later
#include "baselines/relaxation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bone_samples.h"
#include "joint_limits.h"
#include "limbs.h"
#include "parallel.h"
#include "search_grids.h"
#include "segment.h"
#include "topology.h"

namespace garmentfit {
namespace {

constexpr double k_rotation_extent = 0.2, k_rotation_spacing = 0.02;  // rad; literature: [wu_2018_garment_fitting]
constexpr double k_bone_extent = 2 * std::numbers::pi / 3;  // rad; literature: phi0 of [wu_2018_garment_fitting]

// Parents before children.
using BoneChain = std::vector<int>;
const BoneChain k_spine { lowerback, upperback, thorax, lowerneck, upperneck };
const std::array<BoneChain, 4> k_independent { BoneChain { lhipjoint, lfemur, ltibia },
                                               BoneChain { rhipjoint, rfemur, rtibia },
                                               BoneChain { lclavicle, lhumerus, lradius },
                                               BoneChain { rclavicle, rhumerus, rradius } };

bool covers(GarmentType type, Bone bone)
{
    const std::vector<Bone> bones = bones_covered_by(type);
    return std::find(bones.begin(), bones.end(), bone) != bones.end();
}

// Upright, the root at the garment's barycentre. The root of short upper garments lies below the hem: there, the box of
// the grid is moved down by the length of the trunk.
Posture start_of(const Rig& rig, const GarmentMesh& garment, GarmentType type)
{
    const Skeleton& rest = rig.skeleton;
    Posture posture;
    posture.turn = shortest_arc(rig.up.normalized(), Vec3::UnitY());
    posture.root = garment.positions.colwise().mean();
    if (!covers(type, lfemur))
        posture.root -= (rest.tail(thorax) - rest.root).norm() * Vec3::UnitY();
    for (int b = 0; b < bone_count; ++b)
        posture.directions[b] = posture.turn * rest.direction(b);
    return posture;
}

bool is_descendant(int bone, int ancestor)
{
    while (bone >= 0 && bone != ancestor)
        bone = parent_of(bone);
    return bone == ancestor;
}

// The bone's descendants turn with it.
Posture point_bone(Posture posture, int bone, const Vec3& direction)
{
    const Eigen::Quaterniond turn = shortest_arc(posture.directions[bone], direction);
    for (int b = bone + 1; b < bone_count; ++b)
        if (is_descendant(b, bone))
            posture.directions[b] = turn * posture.directions[b];
    posture.directions[bone] = direction;
    return posture;
}

// The chest has more clearance than any sleeve, but the body's own chest fills it.
bool is_in_trunk(int bone, const Skeleton& joints, const std::array<double, bone_count>& radii)
{
    if (!is_arm(bone))
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
        rest_(rig.skeleton), limits_(rig), radii_(limb_radii_of(rig, covered).radii), metric_(metric),
        covered_(covered), r_(r)
    {
    }

    RelaxedPosture translate(const Posture& present, double scale) const
    {
        return find_best(present, grid_offsets(scale * r_.translation_extent, scale * r_.translation_spacing),
                         [&](const Vec3& offset) {
                             Posture moved = present;
                             moved.root += offset;
                             return moved;
                         });
    }

    RelaxedPosture rotate(const Posture& present, double scale) const
    {
        return find_best(present, grid_offsets(scale * r_.rotation_extent, scale * r_.rotation_spacing),
                         [&](const Vec3& rotation_vector) {
                             const Eigen::Quaterniond turn = rotation_by(rotation_vector);
                             Posture moved = present;
                             moved.turn = (turn * present.turn).normalized();
                             for (Vec3& direction : moved.directions)
                                 direction = turn * direction;
                             return moved;
                         });
    }

    RelaxedPosture turn_chain(const Posture& present, const BoneChain& chain, double scale) const
    {
        RelaxedPosture result { present };
        for (const int b : chain)
            if (std::find(covered_.begin(), covered_.end(), b) != covered_.end()) {
                const RelaxedPosture turned = turn_bone(result.posture, b, scale);
                result = { turned.posture, 0, result.bone_evaluations + turned.bone_evaluations };
            }
        return result;
    }

private:
    // Grids begin at the present posture and are sorted by distance from it: of equals, the nearest wins.
    template <class Moved>
    RelaxedPosture find_best(const Posture& present, const std::vector<Vec3>& grid, const Moved& moved) const
    {
        std::vector<double> scores(grid.size());
        parallel_for<std::size_t>(
            grid.size(), [&](std::size_t i) { scores[i] = metric_.total(place_bones(rest_, moved(grid[i]))); }, 16);
        const auto best = std::max_element(scores.begin(), scores.end()) - scores.begin();
        return { best == 0 ? present : moved(grid[best]), static_cast<long long>(grid.size()) };
    }

    RelaxedPosture turn_bone(const Posture& present, int bone, double scale) const
    {
        RelaxedPosture best { present };
        double best_score = metric_.of_bone(bone, place_bones(rest_, present));
        const double spacing = scale * r_.bone_spacing / rest_.length(bone);
        for (const Vec3& direction : directions_about(present.directions[bone], scale * r_.bone_extent, spacing)) {
            const PlacedBones bones = place_bones(rest_, point_bone(present, bone, direction));
            if (!is_human(bone, bones))
                continue;
            ++best.bone_evaluations;
            if (const double score = metric_.of_bone(bone, bones); score > best_score) {
                best_score = score;
                best.posture = point_bone(present, bone, direction);
            }
        }
        return best;
    }

    bool is_human(int bone, const PlacedBones& bones) const
    {
        const Vec3 direction = bones.joints.direction(bone);
        if (is_forearm(bone) && folds_into_chest(bones.joints.direction(parent_of(parent_of(bone))), direction))
            return false;
        return !is_in_trunk(bone, bones.joints, radii_)
            && limits_.excess(bone, bones.parent_turn(bone), direction) == 0;
    }

    const Skeleton& rest_;
    JointLimits limits_;
    std::array<double, bone_count> radii_;  // m, of limbs
    const ErrorMetric& metric_;
    const std::vector<Bone>& covered_;
    const Relaxation& r_;
};

}  // namespace

Relaxation relaxation_of(const Rig& rig, const GarmentMesh& garment, GarmentType type, int iterations)
{
    const double edge = mean_edge_length(garment.positions, edges_of(garment.triangles));
    const Vec3 low = garment.positions.colwise().minCoeff(), high = garment.positions.colwise().maxCoeff();
    return { start_of(rig, garment, type), (high - low) / 2, edge,     k_rotation_extent,
             k_rotation_spacing,           k_bone_extent,    edge / 2, iterations };
}

RelaxedPosture search_relaxed(const Rig& rig, const ErrorMetric& metric, const std::vector<Bone>& covered,
                              const Relaxation& relaxation, const Progress& progress)
{
    const Search search(rig, metric, covered, relaxation);
    RelaxedPosture present { relaxation.start };
    const auto accept = [&](const RelaxedPosture& next) {
        present = { next.posture, present.evaluations + next.evaluations,
                    present.bone_evaluations + next.bone_evaluations };
    };
    for (int i = 0; i < relaxation.iterations; ++i) {
        const double scale = std::pow(0.5, i);
        const Progress round = progress.part(double(i) / relaxation.iterations, double(i + 1) / relaxation.iterations);
        round.at(0);
        accept(search.translate(present.posture, scale));
        round.at(0.5);
        accept(search.rotate(present.posture, scale));
        accept(search.turn_chain(present.posture, k_spine, scale));
        round.at(0.7);
        std::array<RelaxedPosture, k_independent.size()> limbs;
        parallel_for<std::size_t>(limbs.size(), [&](std::size_t l) {
            limbs[l] = search.turn_chain(present.posture, k_independent[l], scale);
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
