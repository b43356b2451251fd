// SPDX-License-Identifier: GPL-3.0-or-later
#include "fast_fit.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "best_start.h"
#include "climb.h"
#include "error_metric.h"
#include "garmentfit/error.h"
#include "type_guess.h"
#include "nearest.h"
#include "outward_cloth.h"
#include "parallel.h"
#include "way_up.h"

namespace garmentfit {
namespace {

constexpr double k_shortest_tip = 0.02;  // of an extremity; below, it ends at its joint
constexpr double k_clear_of_cloth = 0.002,
                 k_clear_step = 0.003;  // m; an extremity keeps so far away, looked at so often
constexpr int k_partly_inside = 2, k_mostly_inside = 3;  // of a bone's five samples
constexpr double k_least_room = 0.2;  // share of the room that covered bones need
constexpr double k_tight = 0.58, k_wide = 0.93, k_given_up = 0.05;  // of the same; the last for the paper's E
constexpr int k_most_stuck = 1;  // bones that pass through cloth before they are freed
constexpr double k_clear_up = 1;  // m of energy; so much better, a way up leaves no doubt
constexpr Steps k_last_steps { 0.16, 0.005 }, k_large_steps { 0.16, 0.04 }, k_nearby_steps { 0.08, 0.0025 };  // rad
constexpr double k_spoken_for = 0.5;  // m of energy that clear evidence for a way up is worth
constexpr double k_as_given = 1;  // m of energy; most garments are given the way they are worn, and so is one of which nothing else is known
constexpr double k_same_way = 0.7;  // cosine; ways up nearer to each other than that do not compete

// The evidence: of the bones that the type names, those that have at least so many of their five samples inside.
std::vector<Bone> bones_inside(const SkeletonSearch& search, const Posture& posture, int samples)
{
    const Skeleton joints = place_bones(search.own(), posture).joints;
    std::vector<Bone> inside;
    for (int b = 0; b < bone_count; ++b)
        if (search.metric().figure().covered[b]
            && search.metric().samples_inside(joints.head(b), joints.tail(b)) >= samples)
            inside.push_back(Bone(b));
    return inside;
}

std::string sizes(const Rig& rig, const ClearanceField& cloth)
{
    const Vec3 size = 100 * (cloth.high() - cloth.low());
    const Skeleton& own = rig.skeleton;
    char text[160];
    std::snprintf(text, sizeof text, "the garment is %.3g x %.3g x %.3g cm, the body's legs are %.3g cm long", size.x(),
                  size.y(), size.z(), 100 * (own.length(lfemur) + own.length(ltibia)));
    return text;
}

// How much of the room that the covered bones need they have, 0 to about 1; tight clothes have 0.6 and more.
double share_of_room(const SkeletonSearch& search, const Posture& posture)
{
    const Figure& figure = search.metric().figure();
    const auto by_bone = search.scores(posture);
    double needed = 0, found = 0;
    for (int b = 0; b < bone_count; ++b) {
        needed += figure.covered[b] ? k_samples * figure.radii[b] : 0;
        found += std::max(0.0, by_bone[b]);
    }
    return needed > 0 ? found / needed : 0;
}

// What is inside must also have some room there: above a plate everything is half inside. And a bone or two may still be
// freed from the cloth, but among scraps there is no way for any of them.
void require_fit(const SkeletonSearch& search, const Posture& posture, const std::string& sizes)
{
    const std::vector<Bone> inside = bones_inside(search, posture, k_mostly_inside);
    const auto& covered_bones = search.metric().figure().covered;
    const auto covered = std::size_t(std::count(covered_bones.begin(), covered_bones.end(), true));
    const int stuck = search.bones_through_cloth(posture);
    if (2 * inside.size() < covered || share_of_room(search, posture) < k_least_room || stuck > k_most_stuck)
        throw InvalidInput("no body fits into the garment: of the " + std::to_string(covered)
                           + " bones it should cover, " + std::to_string(inside.size()) + " can be put inside, and "
                           + std::to_string(stuck) + " of all pass through cloth; " + sizes
                           + "; check the garment's units and type");
}

void require_clear(const SkeletonSearch& search, const Posture& posture)
{
    const Skeleton joints = place_bones(search.own(), posture).joints;
    const auto require = [&](const std::string& name, const Vec3& from, const Vec3& to) {
        if (!search.metric().cloth().crosses(from, to))
            return;
        char place[96];
        std::snprintf(place, sizeof place, "(%.2f, %.2f, %.2f) and (%.2f, %.2f, %.2f) m", from.x(), from.y(), from.z(),
                      to.x(), to.y(), to.z());
        throw SolverFailure("no pose found that keeps the bones clear of the cloth: " + name
                            + " passes through it between " + place
                            + "; check the garment's type, and that its openings are open");
    };
    for (int b = 0; b < bone_count; ++b)
        require(std::string(bone_name(b)), joints.head(b), joints.tail(b));
    require("the head", joints.tail(upperneck), joints.tips[head_top]);
}

void require_way_in(const TriangleMesh& outward)
{
    constexpr double k_small = 0.25;  // m; no garment goes round a body with less
    const Pieces pieces = pieces_in(outward);
    char text[256];
    if (pieces.count > 1 && pieces.largest < k_small) {
        std::snprintf(
            text, sizeof text,
            "garment is %d loose pieces, the largest %.3g cm across, such as buttons: none of them goes round a "
            "body; give the cloth that they belong to, or check its unit",
            pieces.count, 100 * pieces.largest);
        throw InvalidInput(text);
    }
    if (is_sealed(outward))
        throw InvalidInput("garment is closed all round: nobody can get in; give a garment with openings");
}

// The paper's start: the root in the middle of the cloth.
Posture at_barycentre(const Rig& rig, const SkeletonSearch& search)
{
    const Vec3 middle = search.metric().cloth().barycentre();
    return search.at_ease(middle, upright(rig, 0));
}

// Cloth that is tight leaves no choice; where it is wide, the paper's E has a say, and where there is all the room needed, the last.
Posture raised_where_wide(const SkeletonSearch& search, const Posture& posture, PaperClimb& paper)
{
    const double before = share_of_room(search, posture);
    if (before < k_tight)
        return posture;
    // Where small steps led to the end of the first climb, large ones may go on.
    const Posture first = raised(search, posture, paper, k_last_steps),
                  together = raised(search, first, paper, k_large_steps);
    const double after = share_of_room(search, together);
    if (after < before - k_given_up)
        return posture;
    return after < k_wide ? together : raised_alone(search, together, paper, k_nearby_steps);
}

// Refined, and raised: what the second asks is made ready meanwhile.
Posture settled(const SkeletonSearch& search, const Posture& start, const TriangleMesh& outward)
{
    std::optional<Posture> posture;
    std::optional<PaperClimb> paper;
    parallel_for<int>(2, [&](int part) {
        if (part == 0)
            posture = refined(search, start);
        else
            paper.emplace(outward, search.metric().figure().covered);
    });
    return raised_where_wide(search, *posture, *paper);
}

// What a garment offers, held in some way.
struct Seen {
    TriangleMesh outward;
    std::vector<Opening> openings;
    std::unique_ptr<const ClearanceField> clearance;
};

Seen seen(const TriangleMesh& outward)
{
    Seen result { outward, {}, {} };
    parallel_for<int>(2, [&](int part) {
        if (part == 0)
            result.clearance = std::make_unique<const ClearanceField>(outward);
        else
            result.openings = openings_of(outward);
    });
    return result;
}

Seen turned(const Seen& garment, const Eigen::Quaterniond& turn)
{
    Seen result { rotate(garment.outward, turn), {}, {} };
    result.openings = rotate(garment.openings, result.outward, turn);
    result.clearance = std::make_unique<const ClearanceField>(result.outward);
    return result;
}

// One way up of a garment, and how well a body stands in it.
class Attempt {
public:
    /// @throws InvalidInput when no body fits into the garment held like this.
    Attempt(const Rig& rig, Seen garment, GarmentType given, const Progress& progress) :
        rig_(rig), seen_(std::move(garment)), cloth_(*seen_.clearance), guess_(resolve_type(given, seen_.openings)),
        cues_(cues_of(seen_.openings)), limits_(rig),
        metric_(cloth_, figure_of(rig, bones_covered_by(guess_.type, seen_.openings))),
        search_(rig_, limits_, metric_, cues_), start_(best_start(rig_, search_, progress))
    {
        require_fit(search_, start_.posture, sizes(rig_, cloth_));
    }

    /// The energy but for how high the garment happens to be, m.
    double merit() const { return search_.total(start_.posture) - search_.sag() * cloth_.barycentre().y(); }

    /// @param back  turns the garment back to how it was given
    FitResult result(const Eigen::Quaterniond& back) const
    {
        // Short sleeves were asked for a forearm: a bone that cannot be inside need not be.
        const BoneMetric metric(cloth_, figure_of(rig_, bones_inside(search_, start_.posture, k_partly_inside)));
        const SkeletonSearch search(rig_, limits_, metric, cues_);
        const Posture fitted = settled(search, start_.posture, seen_.outward);
        require_clear(search, fitted);

        FitResult result;
        result.type = guess_.type;
        result.type_margin = guess_.margin;
        result.front_margin = start_.front_margin;
        result.covered = bones_inside(search, fitted, k_mostly_inside);
        result.pose = pose_of(rig_.skeleton, rotate(fitted, back));
        result.scores = search.scores(fitted);
        result.clearance = metric.clearance_shares(place_bones(rig_.skeleton, fitted).joints);
        result.scores_before = search.scores(at_barycentre(rig_, search));
        return result;
    }

private:
    const Rig& rig_;
    Seen seen_;
    const ClearanceField& cloth_;
    TypeGuess guess_;
    GarmentCues cues_;
    JointLimits limits_;
    BoneMetric metric_;
    SkeletonSearch search_;
    BestStart start_;
};

// Met by no cloth, nor nearly: the body is put over its bones with some thickness.
bool is_clear(const TriangleTree& cloth, const Vec3& joint, const Vec3& tip)
{
    const int steps = int(std::ceil((tip - joint).norm() / k_clear_step));
    for (int i = 1; i <= steps; ++i)
        if (cloth.distance(joint + double(i) / steps * (tip - joint)) < k_clear_of_cloth)
            return false;
    return !cloth.is_met(joint, tip);
}

struct Tried {
    std::unique_ptr<const Attempt> attempt;
    Eigen::Quaterniond turn;
    double merit = 0;  // m
    double evidence = 0;  // for this way up
    double margin = 1;  // 0 (another way up is as good) to 1

    Vec3 up() const { return turn.conjugate() * Vec3::UnitY(); }
};

bool is_as_given(const WayUp& way) { return way.turn.w() == 1; }

double spoken_for(const WayUp& way)
{
    return is_as_given(way) && way.evidence <= 0 ? k_as_given : k_spoken_for * way.evidence;
}

bool is_spoken_for(const Tried& best) { return best.attempt && best.evidence > 0; }

// How much better the best is than any that is really another way up.
double margin_of(const Tried& best, const std::vector<std::pair<Vec3, double>>& merits)
{
    double margin = 1;
    for (const auto& [up, merit] : merits)
        if (up.dot(best.up()) < k_same_way)
            margin = std::min(margin, (best.merit - merit) / k_clear_up);
    return std::max(0.0, margin);
}

// The one in which a body stands best, of the ways for which something speaks, or, where no body fits in any of them, of the others.
Tried best_of(const Rig& rig, const Seen& garment, const std::vector<WayUp>& ways, GarmentType given,
              const Progress& progress)
{
    Tried best;
    std::vector<std::pair<Vec3, double>> merits;
    std::optional<InvalidInput> refusal;
    for (std::size_t i = 0; i < ways.size() && (ways[i].evidence > 0 || !is_spoken_for(best)); ++i) {
        const double from = double(i) / double(ways.size());
        try {
            auto attempt
                = std::make_unique<const Attempt>(rig, turned(garment, ways[i].turn), given, progress.part(from, from));
            const double merit = attempt->merit() + spoken_for(ways[i]);
            merits.emplace_back(ways[i].turn.conjugate() * Vec3::UnitY(), merit);
            if (!best.attempt || merit > best.merit)
                best = { std::move(attempt), ways[i].turn, merit, ways[i].evidence };
        } catch (const InvalidInput& error) {
            if (!refusal)
                refusal = error;
        }
    }
    if (!best.attempt)
        throw *refusal;
    best.margin = std::min(margin_of(best, merits), best.evidence > 0 ? best.evidence : 1);
    return best;
}

Tried best_way_up(const Rig& rig, const TriangleMesh& outward, GarmentType given, const Progress& progress)
{
    Seen garment = seen(outward);
    const std::vector<WayUp> ways = ways_up(outward, garment.openings);
    if (ways.size() > 1)
        return best_of(rig, garment, ways, given, progress);
    return { std::make_unique<const Attempt>(rig, std::move(garment), given, progress), ways[0].turn, 0,
             ways[0].evidence, ways[0].evidence };
}

}  // namespace

Skeleton retract_tips(const Skeleton& joints, const GarmentMesh& garment)
{
    const TriangleTree cloth({ garment.positions, garment.triangles });
    Skeleton result = joints;
    for (int e = 0; e < extremity_count; ++e) {
        const Vec3& joint = joints.tail(bone_before(Extremity(e)));
        double reach = 1;
        while (reach > k_shortest_tip && !is_clear(cloth, joint, joint + reach * (joints.tips[e] - joint)))
            reach *= 0.8;
        if (reach < 1)  // once more, to keep some distance
            result.tips[e] = joint + (reach > k_shortest_tip ? 0.8 * reach : 0.0) * (joints.tips[e] - joint);
    }
    return result;
}

FitResult fast_fit(const Rig& rig, const GarmentMesh& garment, GarmentType given, const Progress& progress)
{
    const Progress stage = progress.part(0, 1, "fit the skeleton");
    const TriangleMesh outward = outward_cloth(garment);
    require_way_in(outward);
    const Tried best = best_way_up(rig, outward, given, stage.part(0, 0.8));
    stage.at(0.8);
    FitResult result = best.attempt->result(best.turn.conjugate());
    result.up = best.up();
    result.up_margin = best.margin;
    return result;
}

}  // namespace garmentfit
