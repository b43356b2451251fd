// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "coordinate_ascent.h"
#include "garmentfit/error.h"
#include "garmentfit/fit_skeleton.h"
#include "outward_cloth.h"
#include "shoulder_lids.h"

namespace garmentfit {
namespace {

// A garment held upright, and the posture of its own fit there.
class SingleFit {
public:
    SingleFit(const Rig& rig, const JointLimits& limits, const GarmentMesh& garment, const FitResult& fit,
              const std::array<bool, bone_count>& covered_by_any) :
        turn_(shortest_arc(fit.up, Vec3::UnitY())),
        outward_(rotate(outward_cloth(garment), turn_)), openings_(openings_of(outward_)),
        cloth_(outward_, lids_at_shoulders(outward_, openings_)), metric_(cloth_, limb_radii(rig, fit, covered_by_any)),
        energy_(rig, limits, metric_, cues_of(openings_, front_of(fit, turn_))),
        posture_(rotate(posture_of(rig.skeleton, fit.pose), turn_)), joints_(place_bones(rig.skeleton, posture_).joints)
    {
    }

    const FitEnergy& energy() const { return energy_; }
    const Posture& posture() const { return posture_; }
    bool covers(int bone) const { return metric_.covers(bone); }
    Vec3 direction_from_root(int bone) const { return posture_.turn.conjugate() * posture_.directions[bone]; }

    /// Bones that have lost clearance against the garment's own fit, or pass through cloth; upperneck stands for the
    /// head, too. Hands and feet may pass through cloth.
    std::vector<int> bones_lacking(const Posture& posture) const
    {
        const Skeleton joints = place_bones(energy_.rest(), posture).joints;
        std::vector<int> lacking;
        for (int b = 0; b < bone_count; ++b)
            if (cloth_.crosses(joints.head(b), joints.tail(b)) || lacks_clearance(b, joints)
                || (b == upperneck && cloth_.crosses(joints.tail(b), joints.tips[head_top])))
                lacking.push_back(b);
        return lacking;
    }

    /// The own fit's result with another posture. The bones' rotations are those of `bones`, which all garments share.
    FitResult with_posture(FitResult result, const Posture& posture, const Pose& bones) const
    {
        result.pose = pose_of(energy_.rest(), rotate(posture, turn_.conjugate()));
        result.pose.rotations = bones.rotations;
        result.scores = energy_.bone_scores(posture);
        result.clearance = metric_.clearance_shares(place_bones(energy_.rest(), posture).joints);
        result.score_after = std::accumulate(result.scores.begin(), result.scores.end(), 0.0);
        return result;
    }

private:
    static std::optional<Vec3> front_of(const FitResult& fit, const Eigen::Quaterniond& turn)
    {
        return fit.front_given ? std::optional<Vec3>(turn * *fit.front_given) : std::nullopt;
    }

    static LimbRadii limb_radii(const Rig& rig, const FitResult& fit,
                                const std::array<bool, bone_count>& covered_by_any)
    {
        LimbRadii limbs = limb_radii_of(rig, fit.covered);
        limbs.covered_elsewhere = covered_by_any;
        return limbs;
    }

    bool lacks_clearance(int b, const Skeleton& joints) const
    {
        const auto needed = [&](const Skeleton& s) { return metric_.needed_clearance(b, s.head(b), s.tail(b)); };
        return covers(b) && needed(joints) < k_clearance_kept * needed(joints_) - k_clearance_tolerance;
    }

    Eigen::Quaterniond turn_;  // upright from as given
    TriangleMesh outward_;
    std::vector<Opening> openings_;
    ClearanceField cloth_;
    BoneMetric metric_;
    FitEnergy energy_;
    Posture posture_;
    Skeleton joints_;
};

using SingleFits = std::vector<std::unique_ptr<const SingleFit>>;

SingleFits single_fits_of(const Rig& rig, const JointLimits& limits, const std::vector<GarmentMesh>& garments,
                          const std::vector<FitResult>& fits)
{
    std::array<bool, bone_count> covered_by_any {};
    for (const FitResult& fit : fits)
        for (const Bone b : fit.covered)
            covered_by_any[b] = true;
    SingleFits result;
    for (std::size_t i = 0; i < fits.size(); ++i)
        result.push_back(std::make_unique<const SingleFit>(rig, limits, garments[i], fits[i], covered_by_any));
    return result;
}

// The garments that decide where a bone points: those that cover it, or else its nearest covered ancestor, or else all.
std::vector<std::size_t> deciding_garments(const SingleFits& garments, int bone)
{
    std::vector<std::size_t> result;
    for (int b = bone; b >= 0 && result.empty(); b = parent_of(b))
        for (std::size_t i = 0; i < garments.size(); ++i)
            if (garments[i]->covers(b))
                result.push_back(i);
    if (result.empty()) {
        result.resize(garments.size());
        std::iota(result.begin(), result.end(), 0);
    }
    return result;
}

// Each garment's own root, and for each bone the mean direction over the garments that decide it.
std::vector<Posture> starts_of(const SingleFits& garments)
{
    std::vector<Posture> starts;
    for (const auto& garment : garments)
        starts.push_back(garment->posture());
    for (int b = 0; b < bone_count; ++b) {
        Vec3 sum = Vec3::Zero();
        for (const std::size_t i : deciding_garments(garments, b))
            sum += garments[i]->direction_from_root(b);
        const Vec3 mean = sum.norm() > 0 ? sum.normalized() : garments[0]->direction_from_root(b);
        for (Posture& start : starts)
            start.directions[b] = start.turn * mean;
    }
    return starts;
}

bool can_share_root(const std::vector<FitResult>& fits)
{
    return std::all_of(fits.begin(), fits.end(), [&](const FitResult& fit) {
        const Pose &a = fits[0].pose, &b = fit.pose;
        return fit.up == fits[0].up && (a.root_translation - b.root_translation).norm() < k_same_root
            && a.root_rotation.angularDistance(b.root_rotation) < k_same_turn;
    });
}

// The first posture decides for all.
std::vector<Posture> with_mean_root(std::vector<Posture> postures)
{
    Vec3 sum = Vec3::Zero();
    for (const Posture& posture : postures)
        sum += posture.root;
    postures[0].root = sum / double(postures.size());
    return postures;
}

double angle_apart(const SingleFit& a, const SingleFit& b, int bone)
{
    return angle_between(a.direction_from_root(bone), b.direction_from_root(bone));
}

// With the garment whose bone points furthest from this one's direction, of those that decide it.
FitConflict conflict_of(const SingleFits& garments, std::size_t where, int bone)
{
    std::vector<std::size_t> others = deciding_garments(garments, bone);
    if (others == std::vector<std::size_t> { where }) {
        others.resize(garments.size());
        std::iota(others.begin(), others.end(), 0);
    }
    std::erase(others, where);
    const auto angle = [&](std::size_t i) { return angle_apart(*garments[where], *garments[i], bone); };
    const std::size_t other = *std::max_element(others.begin(), others.end(),
                                                [&](std::size_t i, std::size_t j) { return angle(i) < angle(j); });
    return { Bone(bone), { int(where), int(other) }, angle(other) };
}

bool are_alike(const FitConflict& a, const FitConflict& b)
{
    return a.bone == b.bone && std::minmax(a.garments[0], a.garments[1]) == std::minmax(b.garments[0], b.garments[1]);
}

std::vector<FitConflict> conflicts_of(const SingleFits& garments, const std::vector<Posture>& postures)
{
    std::vector<FitConflict> conflicts;
    for (std::size_t i = 0; i < garments.size(); ++i)
        for (const int bone : garments[i]->bones_lacking(postures[i])) {
            const FitConflict conflict = conflict_of(garments, i, bone);
            if (std::none_of(conflicts.begin(), conflicts.end(),
                             [&](const FitConflict& other) { return are_alike(other, conflict); }))
                conflicts.push_back(conflict);
        }
    std::stable_sort(conflicts.begin(), conflicts.end(),
                     [](const FitConflict& a, const FitConflict& b) { return a.angle > b.angle; });
    return conflicts;
}

std::vector<Posture> ascend_all(const SingleFits& garments, bool one_root)
{
    std::vector<const FitEnergy*> energies;
    for (const auto& garment : garments)
        energies.push_back(&garment->energy());
    const std::vector<Posture> starts = starts_of(garments);
    return ascend_together(energies, one_root ? with_mean_root(starts) : starts, one_root, k_common_steps);
}

}  // namespace

CommonFit fit_common_pose(const Rig& rig, const std::vector<GarmentMesh>& garments, const std::vector<FitResult>& fits,
                          const Progress& progress)
{
    if (garments.size() != fits.size())
        throw InvalidInput(ErrorCode::count_mismatch,
                           std::to_string(garments.size()) + " garments have " + std::to_string(fits.size())
                               + " fits; give one for each");
    CommonFit result { fits, fits.size() == 1, {} };
    if (fits.size() < 2)
        return result;
    const JointLimits limits(rig);
    const SingleFits singles = single_fits_of(rig, limits, garments, fits);
    for (const bool one_root : { true, false }) {
        progress.at(one_root ? 0.3 : 0.6);
        if (result.one_pose || (one_root && !can_share_root(fits)))
            continue;
        const std::vector<Posture> postures = ascend_all(singles, one_root);
        result.conflicts = conflicts_of(singles, postures);
        result.one_pose = result.conflicts.empty();
        for (std::size_t i = 0; result.one_pose && i < fits.size(); ++i)
            result.fits[i] = singles[i]->with_posture(fits[i], postures[i], pose_of(rig.skeleton, postures[0]));
    }
    return result;
}

}  // namespace garmentfit
