// SPDX-License-Identifier: GPL-3.0-or-later
#include "coordinate_ascent.h"

#include "posture_moves.h"
#include "search_grids.h"

namespace garmentfit {
namespace {

// All but the hip joints, which are nearly fixed to the pelvis. The trunk comes first.
constexpr std::array<int, 15> k_bending { lowerback, upperback, thorax,   lowerneck, upperneck,
                                          lclavicle, rclavicle, lhumerus, rhumerus,  lradius,
                                          rradius,   lfemur,    rfemur,   ltibia,    rtibia };
// derived: translation and rotation of the root, two directions of each bone that bends
constexpr int k_root_freedoms = 6, k_freedoms = k_root_freedoms + 2 * int(k_bending.size()),
              k_trunk_freedoms = k_root_freedoms + 2 * 7;  // of the root and the first seven bones

// Degrees of freedom: three of translation, three of rotation, and two of each bone that bends.
Posture move_along(const FitEnergy& energy, const Posture& present, int freedom, double step)
{
    if (freedom >= 3 && freedom < k_root_freedoms)
        return rotate_about_trunk(energy, present, step * Vec3::Unit(freedom - 3));
    Posture moved = present;
    if (freedom < 3) {
        moved.root[freedom] += k_lever * step;
    } else {
        Vec3& direction = moved.directions[k_bending[(freedom - k_root_freedoms) / 2]];
        const Vec3 across = direction.unitOrthogonal(), axis = freedom % 2 ? across : Vec3(direction.cross(across));
        direction = rotation_by(step * axis) * direction;
    }
    return moved;
}

// An uncovered forearm turns with its upper arm, an uncovered shin with its thigh.
Posture turn_uncovered_limbs(const FitEnergy& energy, const Posture& before, Posture after)
{
    for (const auto& [bones, end] : k_limbs)
        if (const auto [upper, lower] = bones; !energy.metric().covers(lower))
            after.directions[lower]
                = shortest_arc(before.directions[upper], after.directions[upper]) * after.directions[lower];
    return after;
}

// The trunk moves; arms and legs keep their place as far as possible.
Posture keep_limbs(const Skeleton& rest, const PlacedBones& before, Posture after)
{
    const Skeleton& from = before.joints;
    Skeleton to = place_bones(rest, after, before).joints;
    for (const Limb& limb : k_limbs)
        for (const int b : limb.bones)
            if (limb.end != head_top) {
                after.directions[b] = (from.tail(b) - to.head(b)).normalized();
                to.tails[b] = to.head(b) + rest.length(b) * after.directions[b];
            }
    return after;
}

// The step from one posture to another, once more.
Posture extrapolate(const Posture& from, const Posture& to)
{
    Posture next = to;
    next.root += to.root - from.root;
    next.turn = (to.turn * from.turn.conjugate() * to.turn).normalized();
    for (int b = 0; b < bone_count; ++b)
        next.directions[b] = shortest_arc(from.directions[b], to.directions[b]) * to.directions[b];
    return next;
}

std::vector<Posture> extrapolate(const std::vector<Posture>& from, const std::vector<Posture>& to)
{
    std::vector<Posture> next;
    for (std::size_t i = 0; i < to.size(); ++i)
        next.push_back(extrapolate(from[i], to[i]));
    return next;
}

// try_step(freedom, step) and try_state(next) make a better state the present one, and say whether they did. A state is
// a posture, or one per garment. The ascent by one step ends when all degrees of freedom in a row fail, wherever in a
// sweep that is.
template <class State, class TryStep, class TryState>
void ascend_by(const State& present, int freedoms, const AscentSteps& steps, const TryStep& try_step,
               const TryState& try_state)
{
    for (double step = steps.first; step >= steps.last; step *= 0.5)
        for (int failures = 0; failures < freedoms;) {
            State from = present;
            bool improves = false;
            for (int freedom = 0; freedom < freedoms && failures < freedoms; ++freedom) {
                const bool better = try_step(freedom, step) || try_step(freedom, -step);
                failures = better ? 0 : failures + 1;
                improves = improves || better;
            }
            for (State here = present; improves && try_state(extrapolate(from, here)); here = present) {
                from = here;
                failures = 0;
            }
        }
}

// Moves the trunk with its limbs, or, where that fails, without them. `bones` are the present posture's.
template <class TryPosture>
void ascend_in_cloth(const FitEnergy& energy, const Posture& present, const PlacedBones& bones,
                     const AscentSteps& steps, const TryPosture& try_posture)
{
    const auto try_whole
        = [&](const Posture& next) { return try_posture(turn_uncovered_limbs(energy, present, next)); };
    const auto try_step = [&](int freedom, double step) {
        const Posture next = move_along(energy, present, freedom, step);
        return try_whole(next) || (freedom < k_trunk_freedoms && try_whole(keep_limbs(energy.rest(), bones, next)));
    };
    ascend_by(present, k_freedoms, steps, try_step, try_whole);
}

Vec3 point_on_bone(const Skeleton& joints, int bone, double share)
{
    return joints.head(bone) + share * (joints.tail(bone) - joints.head(bone));
}

// Skin cuts the corner between neck and shoulders, where a neckline may lie.
int corners_through_cloth(const FitEnergy& energy, const Posture& posture)
{
    const Skeleton joints = place_bones(energy.rest(), posture).joints;
    int count = 0;
    for (const int clavicle : { lclavicle, rclavicle })
        for (const double out : k_corner_shares)
            for (const double up : k_corner_shares)
                count += energy.metric().cloth().crosses(point_on_bone(joints, clavicle, out),
                                                         point_on_bone(joints, lowerneck, up));
    return count;
}

double value_of(const FitEnergy& energy, const Posture& posture) { return energy.value(posture); }
double total_of(const FitEnergy& energy, const Posture& posture) { return energy.total(posture); }

// The bones of all postures point as those of the first do, seen from the root.
std::vector<Posture> align_bones(std::vector<Posture> postures, bool one_root)
{
    const Posture& first = postures[0];
    for (Posture& posture : postures) {
        if (one_root) {
            posture = first;
            continue;
        }
        const Eigen::Quaterniond turn = posture.turn * first.turn.conjugate();
        for (int b = 0; &posture != &first && b < bone_count; ++b)
            posture.directions[b] = (turn * first.directions[b]).normalized();
    }
    return postures;
}

template <class Value>
auto sum_over(const std::vector<const FitEnergy*>& energies, const std::vector<Posture>& postures, const Value& value)
{
    auto sum = value(*energies[0], postures[0]);
    for (std::size_t i = 1; i < energies.size(); ++i)
        sum += value(*energies[i], postures[i]);
    return sum;
}

// The constraints of an ascent by the paper's E alone: joints stay near, and bones keep the clearance that they need.
class ClearanceConstraint {
public:
    ClearanceConstraint(const FitEnergy& energy, const Posture& start) :
        energy_(energy), joints_(place_bones(energy.rest(), start).joints),
        min_energy_(energy.total(start) - k_energy_given_up), max_corners_(corners_through_cloth(energy, start))
    {
        for (int b = 0; b < bone_count; ++b)
            min_clearance_[b] = needed(b, joints_) - k_clearance_given_up;
    }

    bool holds(const Posture& posture) const
    {
        const Skeleton joints = place_bones(energy_.rest(), posture).joints;
        for (int b = 0; b < bone_count; ++b)
            if (energy_.metric().covers(b)
                && (is_far(joints.head(b), joints_.head(b)) || is_far(joints.tail(b), joints_.tail(b))
                    || needed(b, joints) < min_clearance_[b]))
                return false;
        return energy_.total(posture) >= min_energy_ && corners_through_cloth(energy_, posture) <= max_corners_;
    }

private:
    bool is_far(const Vec3& a, const Vec3& b) const { return (a - b).norm() > k_max_drift; }
    double needed(int bone, const Skeleton& joints) const
    {
        return energy_.metric().needed_clearance(bone, joints.head(bone), joints.tail(bone));
    }

    const FitEnergy& energy_;
    Skeleton joints_;  // at the start
    double min_energy_;  // m
    int max_corners_;
    std::array<double, bone_count> min_clearance_ {};
};

}  // namespace

Posture ascend(const FitEnergy& energy, const Posture& start, const AscentSteps& steps)
{
    Posture present = start;
    EnergyTerms terms = energy.evaluate(present);
    double score = terms.energy - energy.crossing_cost(present);
    const auto try_posture = [&](const Posture& next) {
        const double bound = energy.value(next, terms);  // an upper bound: crossings only cost
        if (bound <= score + k_min_gain)
            return false;
        const double next_score = bound - energy.crossing_cost(next);
        if (next_score <= score + k_min_gain)
            return false;
        present = next;
        terms = energy.evaluate(next);
        score = next_score;
        return true;
    };
    const auto try_step
        = [&](int freedom, double step) { return try_posture(move_along(energy, present, freedom, step)); };
    ascend_by(present, k_freedoms, steps, try_step, try_posture);
    return present;
}

std::vector<Posture> ascend_together(const std::vector<const FitEnergy*>& energies, std::vector<Posture> starts,
                                     bool one_root, const AscentSteps& steps)
{
    std::vector<Posture> present = align_bones(std::move(starts), one_root);
    double score = sum_over(energies, present, total_of);
    const int corners = sum_over(energies, present, corners_through_cloth);
    const auto try_postures = [&](const std::vector<Posture>& given) {
        const std::vector<Posture> next = align_bones(given, one_root);
        if (sum_over(energies, next, value_of) <= score + k_min_gain)  // crossings only cost
            return false;
        const double next_score = sum_over(energies, next, total_of);
        if (next_score <= score + k_min_gain || sum_over(energies, next, corners_through_cloth) > corners)
            return false;
        present = next;
        score = next_score;
        return true;
    };
    // The first posture has the bones of all, and where there is one root, that too.
    const int others = one_root ? 0 : k_root_freedoms * (int(energies.size()) - 1);
    const auto try_step = [&](int freedom, double step) {
        std::vector<Posture> next = present;
        const std::size_t i = freedom < k_freedoms ? 0 : 1 + std::size_t(freedom - k_freedoms) / k_root_freedoms;
        const int own = freedom < k_freedoms ? freedom : (freedom - k_freedoms) % k_root_freedoms;
        next[i] = move_along(*energies[i], present[i], own, step);
        return try_postures(next);
    };
    ascend_by(present, k_freedoms + others, steps, try_step, try_postures);
    return present;
}

Posture ascend_with_paper(const FitEnergy& energy, const Posture& start, IncrementalPaperMetric& paper,
                          const AscentSteps& steps)
{
    Posture present = start;
    EnergyTerms terms = energy.evaluate(present);
    double score = terms.energy - energy.crossing_cost(present);
    const double min_energy = score - k_energy_given_up;
    const int corners = corners_through_cloth(energy, start);
    paper.is_above(place_bones(energy.rest(), start).joints, 0);
    paper.accept();
    ascend_in_cloth(energy, present, terms.bones, steps, [&](const Posture& next) {
        const double bound = energy.value(next, terms);  // an upper bound: crossings only cost
        if (bound < min_energy
            || !paper.is_above(place_bones(energy.rest(), next, terms.bones).joints, score - bound + k_min_gain))
            return false;
        const double next_score = bound - energy.crossing_cost(next);
        if (next_score < min_energy || paper.gain() + next_score <= score + k_min_gain
            || corners_through_cloth(energy, next) > corners)
            return false;
        present = next;
        terms = energy.evaluate(next);
        score = next_score;
        paper.accept();
        return true;
    });
    return present;
}

Posture ascend_by_paper(const FitEnergy& energy, const Posture& start, IncrementalPaperMetric& paper,
                        const AscentSteps& steps)
{
    Posture present = start;
    PlacedBones bones = place_bones(energy.rest(), start);
    const ClearanceConstraint clearance(energy, start);
    ascend_in_cloth(energy, present, bones, steps, [&](const Posture& next) {
        const PlacedBones next_bones = place_bones(energy.rest(), next, bones);
        if (!paper.is_above(next_bones.joints, k_min_gain) || !clearance.holds(next))
            return false;
        present = next;
        bones = next_bones;
        paper.accept();
        return true;
    });
    return present;
}

}  // namespace garmentfit
