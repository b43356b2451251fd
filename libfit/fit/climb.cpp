// SPDX-License-Identifier: GPL-3.0-or-later
#include "climb.h"

#include "search_grids.h"

namespace garmentfit {
namespace {

constexpr double k_lever = 0.2;  // m; a step of translation moves as far as a bone's far end at this distance
constexpr double k_least_gain = 1e-4;  // m; of a step
constexpr double k_furthest_way = 0.02;  // m; that a joint goes for the paper's E alone
constexpr double k_clearance_lost = 0.04;  // m, of a bone's five samples: 8 mm each
constexpr double k_energy_lost = 0.3;  // m; tight clothes have ten times that
// All but the hip joints, which are as good as fixed to the pelvis. First the trunk.
constexpr std::array<int, 15> k_bending { lowerback, upperback, thorax,   lowerneck, upperneck,
                                          lclavicle, rclavicle, lhumerus, rhumerus,  lradius,
                                          rradius,   lfemur,    rfemur,   ltibia,    rtibia };
constexpr int k_root_freedoms = 6, k_freedoms = k_root_freedoms + 2 * int(k_bending.size()),
              k_trunk_freedoms = k_root_freedoms + 2 * 7;

// Degrees of freedom: three of translation, three of rotation, and two of each bone that bends.
Posture moved(const SkeletonSearch& search, const Posture& present, int freedom, double step)
{
    if (freedom >= 3 && freedom < k_root_freedoms)
        return search.turned(present, step * Vec3::Unit(freedom - 3));
    Posture moved = present;
    if (freedom < 3) {
        moved.root[freedom] += k_lever * step;
    } else {
        Vec3& direction = moved.directions[k_bending[(freedom - k_root_freedoms) / 2]];
        const Vec3 across = direction.unitOrthogonal(), axis = freedom % 2 ? across : Vec3(direction.cross(across));
        direction = turned_by(step * axis) * direction;
    }
    return moved;
}

// A bare forearm goes along with its upper arm, a bare shin with its thigh.
Posture with_bare_limbs_along(const SkeletonSearch& search, const Posture& before, Posture after)
{
    for (const auto& [bones, end] : k_limbs)
        if (const auto [upper, lower] = bones; !search.metric().figure().covered[lower])
            after.directions[lower]
                = shortest_arc(before.directions[upper], after.directions[upper]) * after.directions[lower];
    return after;
}

// Arms and legs stay where they are, as far as they can, while the trunk moves.
Posture with_limbs_kept(const Skeleton& own, const PlacedBones& before, Posture after)
{
    const Skeleton& from = before.joints;
    Skeleton to = place_bones(own, after, before).joints;
    for (const Limb& limb : k_limbs)
        for (const int b : limb.bones)
            if (limb.end != head_top) {
                after.directions[b] = (from.tail(b) - to.head(b)).normalized();
                to.tails[b] = to.head(b) + own.length(b) * after.directions[b];
            }
    return after;
}

// As far again.
Posture beyond(const Posture& from, const Posture& to)
{
    Posture next = to;
    next.root += to.root - from.root;
    next.turn = (to.turn * from.turn.conjugate() * to.turn).normalized();
    for (int b = 0; b < bone_count; ++b)
        next.directions[b] = shortest_arc(from.directions[b], to.directions[b]) * to.directions[b];
    return next;
}

std::vector<Posture> beyond(const std::vector<Posture>& from, const std::vector<Posture>& to)
{
    std::vector<Posture> next;
    for (std::size_t i = 0; i < to.size(); ++i)
        next.push_back(beyond(from[i], to[i]));
    return next;
}

// step_taken(freedom, step) and taken(next) make a better state the present one: a posture, or several that go together.
template <class State, class StepTaken, class Taken>
void climb(const State& present, int freedoms, const Steps& steps, const StepTaken& step_taken, const Taken& taken)
{
    for (double step = steps.first; step >= steps.last; step *= 0.5)
        for (int in_vain = 0; in_vain < freedoms;) {  // freedoms in a row that gave nothing
            State from = present;
            bool improves = false;
            for (int freedom = 0; freedom < freedoms && in_vain < freedoms; ++freedom) {
                const bool better = step_taken(freedom, step) || step_taken(freedom, -step);
                in_vain = better ? 0 : in_vain + 1;
                improves = improves || better;
            }
            for (State here = present; improves && taken(beyond(from, here)); here = present) {
                from = here;
                in_vain = 0;
            }
        }
}

// The trunk moves with its limbs or between them; what is bare goes along with what it hangs on. `bones` are the present posture's.
template <class Taken>
void climb_in_cloth(const SkeletonSearch& search, const Posture& present, const PlacedBones& bones, const Steps& steps,
                    const Taken& taken)
{
    const auto taken_whole = [&](const Posture& next) { return taken(with_bare_limbs_along(search, present, next)); };
    const auto step_taken = [&](int freedom, double step) {
        const Posture next = moved(search, present, freedom, step);
        return taken_whole(next)
            || (freedom < k_trunk_freedoms && taken_whole(with_limbs_kept(search.own(), bones, next)));
    };
    climb(present, k_freedoms, steps, step_taken, taken_whole);
}

Vec3 on_bone(const Skeleton& joints, int bone, double share)
{
    return joints.head(bone) + share * (joints.tail(bone) - joints.head(bone));
}

// Skin cuts the corner between neck and shoulders, and a neckline may come between.
int corners_through_cloth(const SkeletonSearch& search, const Posture& posture)
{
    const Skeleton joints = place_bones(search.own(), posture).joints;
    int count = 0;
    for (const int clavicle : { lclavicle, rclavicle })
        for (const double out : { 0.3, 0.5, 0.7 })
            for (const double up : { 0.3, 0.5, 0.7 })
                count
                    += search.metric().cloth().crosses(on_bone(joints, clavicle, out), on_bone(joints, lowerneck, up));
    return count;
}

double energy(const SkeletonSearch& search, const Posture& posture) { return search.energy(posture); }
double total(const SkeletonSearch& search, const Posture& posture) { return search.total(posture); }

// The bones of all postures point as those of the first do, seen from the root.
std::vector<Posture> alike(std::vector<Posture> postures, bool one_root)
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
auto sum_over(const std::vector<const SkeletonSearch*>& searches, const std::vector<Posture>& postures,
              const Value& value)
{
    auto sum = value(*searches[0], postures[0]);
    for (std::size_t i = 1; i < searches.size(); ++i)
        sum += value(*searches[i], postures[i]);
    return sum;
}

// What must hold while a posture is raised by the paper's E alone: joints stay near, and bones keep the room they need.
class ClearanceKept {
public:
    ClearanceKept(const SkeletonSearch& search, const Posture& start) :
        search_(search), joints_(place_bones(search.own(), start).joints),
        least_energy_(search.total(start) - k_energy_lost), corners_(corners_through_cloth(search, start))
    {
        for (int b = 0; b < bone_count; ++b)
            min_clearance_[b] = needed(b, joints_) - k_clearance_lost;
    }

    bool holds(const Posture& posture) const
    {
        const Skeleton joints = place_bones(search_.own(), posture).joints;
        for (int b = 0; b < bone_count; ++b)
            if (search_.metric().figure().covered[b]
                && (is_far(joints.head(b), joints_.head(b)) || is_far(joints.tail(b), joints_.tail(b))
                    || needed(b, joints) < min_clearance_[b]))
                return false;
        return search_.total(posture) >= least_energy_ && corners_through_cloth(search_, posture) <= corners_;
    }

private:
    bool is_far(const Vec3& a, const Vec3& b) const { return (a - b).norm() > k_furthest_way; }
    double needed(int bone, const Skeleton& joints) const
    {
        return search_.metric().needed(bone, joints.head(bone), joints.tail(bone));
    }

    const SkeletonSearch& search_;
    Skeleton joints_;
    double least_energy_;
    int corners_;
    std::array<double, bone_count> min_clearance_ {};
};

}  // namespace

Posture polished(const SkeletonSearch& search, const Posture& start, const Steps& steps)
{
    Posture present = start;
    EnergyParts parts = search.parts(present);
    double score = parts.energy - search.crossing_cost(present);
    const auto taken = [&](const Posture& next) {
        const double bound = search.energy(next, parts);  // crossings only cost
        if (bound <= score + k_least_gain)
            return false;
        const double next_score = bound - search.crossing_cost(next);
        if (next_score <= score + k_least_gain)
            return false;
        present = next;
        parts = search.parts(next);
        score = next_score;
        return true;
    };
    climb(
        present, k_freedoms, steps,
        [&](int freedom, double step) { return taken(moved(search, present, freedom, step)); }, taken);
    return present;
}

std::vector<Posture> polished_together(const std::vector<const SkeletonSearch*>& searches, std::vector<Posture> starts,
                                       bool one_root, const Steps& steps)
{
    std::vector<Posture> present = alike(std::move(starts), one_root);
    double score = sum_over(searches, present, total);
    const int corners = sum_over(searches, present, corners_through_cloth);
    const auto taken = [&](const std::vector<Posture>& given) {
        const std::vector<Posture> next = alike(given, one_root);
        if (sum_over(searches, next, energy) <= score + k_least_gain)  // crossings only cost
            return false;
        const double next_score = sum_over(searches, next, total);
        if (next_score <= score + k_least_gain || sum_over(searches, next, corners_through_cloth) > corners)
            return false;
        present = next;
        score = next_score;
        return true;
    };
    // The first posture leads: the bones of all, and where there is one root, that too.
    const int others = one_root ? 0 : k_root_freedoms * (int(searches.size()) - 1);
    const auto step_taken = [&](int freedom, double step) {
        std::vector<Posture> next = present;
        const std::size_t i = freedom < k_freedoms ? 0 : 1 + std::size_t(freedom - k_freedoms) / k_root_freedoms;
        const int own = freedom < k_freedoms ? freedom : (freedom - k_freedoms) % k_root_freedoms;
        next[i] = moved(*searches[i], present[i], own, step);
        return taken(next);
    };
    climb(present, k_freedoms + others, steps, step_taken, taken);
    return present;
}

Posture raised(const SkeletonSearch& search, const Posture& start, PaperClimb& paper, const Steps& steps)
{
    Posture present = start;
    EnergyParts parts = search.parts(present);
    double score = parts.energy - search.crossing_cost(present);
    const double least = score - k_energy_lost;
    const int corners = corners_through_cloth(search, start);
    paper.is_above(place_bones(search.own(), start).joints, 0);
    paper.accept();
    climb_in_cloth(search, present, parts.bones, steps, [&](const Posture& next) {
        const double bound = search.energy(next, parts);  // crossings only cost
        if (bound < least
            || !paper.is_above(place_bones(search.own(), next, parts.bones).joints, score - bound + k_least_gain))
            return false;
        const double next_score = bound - search.crossing_cost(next);
        if (next_score < least || paper.gain() + next_score <= score + k_least_gain
            || corners_through_cloth(search, next) > corners)
            return false;
        present = next;
        parts = search.parts(next);
        score = next_score;
        paper.accept();
        return true;
    });
    return present;
}

Posture raised_alone(const SkeletonSearch& search, const Posture& start, PaperClimb& paper, const Steps& steps)
{
    Posture present = start;
    PlacedBones bones = place_bones(search.own(), start);
    const ClearanceKept clearance(search, start);
    climb_in_cloth(search, present, bones, steps, [&](const Posture& next) {
        const PlacedBones next_bones = place_bones(search.own(), next, bones);
        if (!paper.is_above(next_bones.joints, k_least_gain) || !clearance.holds(next))
            return false;
        present = next;
        bones = next_bones;
        paper.accept();
        return true;
    });
    return present;
}

}  // namespace garmentfit
