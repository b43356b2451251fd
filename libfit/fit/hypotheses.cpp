// SPDX-License-Identifier: GPL-3.0-or-later
#include "hypotheses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "best_start.h"
#include "outline.h"
#include "outward_cloth.h"
#include "place_of_garment.h"
#include "posture_moves.h"
#include "shoulder_lids.h"
#include "tuning.h"
#include "way_up.h"

namespace garmentfit {
namespace {

std::shared_ptr<const HeldGarment> hold(const HeldGarment& given, const WayUp& way, const std::optional<Vec3>& front)
{
    auto held = std::make_shared<HeldGarment>();
    held->turn = way.turn;
    held->upright = way.evidence;
    held->askew = way.askew;
    held->outward = rotate(given.outward, way.turn);
    held->openings = rotate(given.openings, held->outward, way.turn);
    held->cues = cues_of(held->openings, front ? std::optional<Vec3>(way.turn * *front) : std::nullopt);
    held->clearance
        = std::make_unique<const ClearanceField>(held->outward, lids_at_shoulders(held->outward, held->openings));
    return held;
}

bool is_as_given(const WayUp& way) { return way.turn.w() == 1; }

// A body that faces as the garment does, according to the user; the garment is held upright.
StartHypothesis facing_like(const Rig& rig, const Vec3& front)
{
    const Vec3 own = upright_turn(rig, 0) * rig.front;
    return { upright_turn(rig, std::atan2(front.x(), front.z()) - std::atan2(own.x(), own.z())) };
}

std::vector<StartHypothesis> facings(const Attempt& attempt, const FitOptions& options)
{
    if (options.as_placed)
        return {};
    if (options.front)
        return { facing_like(attempt.rig(), *attempt.cues().front_given) };
    return facing_hypotheses(attempt.energy());
}

// A garment as it was given.
struct Garment {
    HeldGarment held;
    std::vector<BodyPlace> places;  // none where the body's surface is not known
};

// One coverage of a held garment, before and after the ascent of its postures.
struct Search {
    std::shared_ptr<const Attempt> attempt;
    std::vector<Posture> rough;
    std::vector<BodyPlace> in_place;  // where the garment lies round the body
    std::vector<Wearing> wearings;

    double best_log_odds() const { return wearings.empty() ? FitEnergy::k_any : log_odds(wearings[0].evidence); }
};

std::vector<Wearing> wearings_of(const Search& search, const std::vector<Posture>& postures, const Garment& given,
                                 const FitOptions& options)
{
    const HeldGarment& garment = search.attempt->garment();
    const Skeleton& rest = search.attempt->energy().rest();
    const double leg = rest.length(lfemur) + rest.length(ltibia);
    const WearingContext context { search.attempt->energy(),
                                   search.attempt->coverage(),
                                   garment.turn,
                                   garment.openings,
                                   taper_of(garment.clearance->patches(), garment.openings, garment.cues, leg),
                                   reach_of(garment.clearance->patches(), garment.openings),
                                   garment.upright,
                                   garment.askew,
                                   given.places };
    std::vector<Wearing> wearings = garmentfit::wearings_of(context, postures, search.in_place);
    std::erase_if(wearings, [&](const Wearing& wearing) {
        return (options.as_placed && !wearing.is_in_place)
            || (options.front && wearing.front.dot(*options.front) < k_same_direction);
    });
    return wearings;
}

bool lies_round_body(const Attempt& attempt, const BodyPlace& place, const FitOptions& options)
{
    const Posture posture = input_posture(attempt.energy().rest(), place.shift);
    return (options.as_placed || place.inside_share <= k_most_inside_body) && attempt.garment().turn.w() == 1
        && (place.near_share >= k_plainly_near || !bones_inside(attempt.energy(), posture, k_partly_inside).empty());
}

bool has_room(const Attempt& attempt, const Posture& posture)
{
    const FitEnergy& energy = attempt.energy();
    return 2 * bones_inside(energy, posture, k_mostly_inside).size() >= attempt.coverage().bones.size()
        && energy.clearance_share(posture) >= k_min_clearance_share;
}

// Cloth near the skin says how a garment is worn that has no room for most bones of any coverage where it lies, such as
// straps and bikinis. Of others the bones say it: a skirt that is turned round is near the skin, too.
std::vector<BodyPlace> without_needless_evidence(std::vector<BodyPlace> places,
                                                 const std::vector<std::shared_ptr<const Attempt>>& attempts)
{
    for (BodyPlace& place : places)
        if (std::any_of(attempts.begin(), attempts.end(), [&](const std::shared_ptr<const Attempt>& attempt) {
                return has_room(*attempt, input_posture(attempt->energy().rest(), place.shift));
            }))
            place.near_share = 0;
    return places;
}

Search search_roughly(const std::shared_ptr<const Attempt>& attempt, const Garment& given,
                      const std::vector<BodyPlace>& places, const FitOptions& options)
{
    Search search { attempt, find_rough_starts(attempt->energy(), facings(*attempt, options)), {}, {} };
    for (const BodyPlace& place : places)
        if (lies_round_body(*attempt, place, options))
            search.in_place.push_back(place);
    search.wearings = wearings_of(search, search.rough, given, options);
    return search;
}

std::vector<Search> search_roughly(const Rig& rig, const Garment& given, const WayUp& way, const FitOptions& options)
{
    const std::shared_ptr<const HeldGarment> held = hold(given.held, way, options.front);
    std::vector<std::shared_ptr<const Attempt>> attempts;
    for (const Coverage& coverage : possible_coverages(options.type, held->openings))
        attempts.push_back(std::make_shared<const Attempt>(rig, held, coverage));
    const std::vector<BodyPlace> places = without_needless_evidence(given.places, attempts);
    std::vector<Search> searches;
    for (const std::shared_ptr<const Attempt>& attempt : attempts)
        searches.push_back(search_roughly(attempt, given, places, options));
    return searches;
}

// Only what the rough postures leave in the running is worth an ascent, and what the openings suggest: in slim legs no
// rough posture may be clear of the cloth.
void search_closely(std::vector<Search>& searches, const Garment& given, const FitOptions& options,
                    const Progress& progress)
{
    double best = FitEnergy::k_any;
    for (const Search& search : searches)
        best = std::max(best, search.best_log_odds());
    for (std::size_t i = 0; i < searches.size(); ++i) {
        progress.at(double(i) / double(searches.size()));
        Search& search = searches[i];
        if (!search.attempt->coverage().is_guessed && search.best_log_odds() < best - k_hopeless)
            continue;
        std::vector<Posture> in_place;
        for (const BodyPlace& place : search.in_place)
            in_place.push_back(input_posture(search.attempt->energy().rest(), place.shift));
        const auto ascended = ascend_starts(search.attempt->energy(), search.rough, in_place);
        search.wearings = wearings_of(search, ascended, given, options);
    }
}

std::vector<Hypothesis> search(const Rig& rig, const Garment& given, const std::vector<WayUp>& ways,
                               const FitOptions& options, const Progress& progress)
{
    std::vector<Search> searches;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        progress.at(0.4 * double(i) / double(ways.size()));
        for (Search& found : search_roughly(rig, given, ways[i], options))
            searches.push_back(std::move(found));
    }
    search_closely(searches, given, options, progress.part(0.4, 1));
    std::vector<Hypothesis> hypotheses;
    for (const Search& found : searches)
        for (const Wearing& wearing : found.wearings)
            hypotheses.push_back({ found.attempt, wearing });
    return hypotheses;
}

// As the file has it, and as the openings would have it; all where the openings do not speak for the way that the file
// has it. The rest are tried only where no body fits in those.
std::vector<WayUp> likely_ways(std::vector<WayUp>& ways, const FitOptions& options)
{
    const bool is_settled = options.as_placed || options.front;
    const bool is_given_likely
        = std::any_of(ways.begin(), ways.end(), [](const WayUp& way) { return is_as_given(way) && way.evidence > 0; });
    const auto rest = std::stable_partition(ways.begin(), ways.end(), [&](const WayUp& way) {
        return is_as_given(way) || (!is_settled && (way.evidence > 0 || !is_given_likely));
    });
    std::vector<WayUp> likely(ways.begin(), rest);
    ways.erase(ways.begin(), is_settled ? ways.end() : rest);
    return likely;
}

bool any_possible(const std::vector<Hypothesis>& hypotheses)
{
    return std::any_of(hypotheses.begin(), hypotheses.end(), [](const Hypothesis& h) { return h.is_possible(); });
}

const Hypothesis& first_of_its_facing(const std::vector<Hypothesis>& all, const Hypothesis& one)
{
    return *std::find_if(all.begin(), all.end(),
                         [&](const Hypothesis& other) { return other.wearing.rank == 0 && is_same_way(other, one); });
}

// Of the facings that were searched for one attempt.
double best_pose(const std::vector<Hypothesis>& all, const Attempt& attempt)
{
    double best = -std::numeric_limits<double>::infinity();
    for (const auto& [of, wearing, probability] : all)
        if (of.get() == &attempt && wearing.rank == 0 && !wearing.is_in_place)
            best = std::max(best, pose_log_odds(wearing.evidence));
    return best;
}

// The input pose is no facing that a search may have missed: how well it fits tells whether the garment lies right.
double log_odds_among(const std::vector<Hypothesis>& all, const Hypothesis& one)
{
    return one.wearing.is_in_place ? log_odds(one.wearing.evidence)
                                   : log_odds(one.wearing.evidence, best_pose(all, *one.attempt));
}

void sort_by_probability(std::vector<Hypothesis>& hypotheses)
{
    std::vector<double> odds;
    for (const Hypothesis& hypothesis : hypotheses)
        if (hypothesis.wearing.rank == 0)
            odds.push_back(log_odds_among(hypotheses, hypothesis));
    const std::vector<double> p = probabilities(odds);
    auto next = p.begin();
    for (Hypothesis& hypothesis : hypotheses)
        if (hypothesis.wearing.rank == 0)
            hypothesis.probability = *next++;
    for (Hypothesis& hypothesis : hypotheses)
        if (hypothesis.wearing.rank > 0)
            hypothesis.probability = first_of_its_facing(hypotheses, hypothesis).probability;
    std::stable_sort(hypotheses.begin(), hypotheses.end(), [](const Hypothesis& a, const Hypothesis& b) {
        return std::make_pair(-a.probability, a.wearing.rank) < std::make_pair(-b.probability, b.wearing.rank);
    });
}

// Whatever its openings and straps leave bare.
bool lies_plainly_round(const Wearing& wearing)
{
    return wearing.is_in_place
        && wearing.evidence[in_place_near_evidence] * k_tenth + k_near_by_chance >= k_plainly_near;
}

Garment measure(const Rig& rig, const TriangleMesh& body, const TriangleMesh& outward, const FitOptions& options)
{
    Garment given;
    given.held.turn = Eigen::Quaterniond::Identity();
    given.held.outward = outward;
    given.held.openings = openings_of(outward);
    if (body.positions.rows() == 0)
        return given;
    const BodySurface surface(body);
    const Positions corners = spread_corners(outward);
    for (const Vec3& shift : body_shifts(body.positions, rig.skeleton.root.y()))
        if (shift.isZero() || !options.as_placed)
            given.places.push_back(surface.place_of(corners, shift, options.as_placed));
    return given;
}

}  // namespace

Attempt::Attempt(const Rig& rig, std::shared_ptr<const HeldGarment> garment, const Coverage& coverage) :
    rig_(rig), garment_(std::move(garment)), coverage_(coverage), limits_(rig),
    metric_(*garment_->clearance, limb_radii_of(rig, coverage.bones)), energy_(rig_, limits_, metric_, garment_->cues)
{
}

// Next to a flat sheet everything is half inside. The refinement may free one bone from the cloth; among scraps of
// cloth it cannot. Where the cloth lies round the body, the body's bones are known to be inside.
bool Hypothesis::is_possible(int max_crossing) const
{
    const FitEnergy& energy = attempt->energy();
    if (lies_plainly_round(wearing))
        return true;
    return has_room(*attempt, wearing.posture)
        && (wearing.is_in_place || energy.bones_through_cloth(wearing.posture) <= max_crossing);
}

bool Hypothesis::is_possible() const
{
    return is_possible(probability > k_likely ? k_max_crossing_bones_likely : k_max_crossing_bones);
}

bool is_same_way(const Hypothesis& a, const Hypothesis& b)
{
    return a.attempt == b.attempt && a.wearing.front.dot(b.wearing.front) > k_same_direction;
}

std::vector<Bone> bones_inside(const FitEnergy& energy, const Posture& posture, int samples)
{
    const Skeleton joints = place_bones(energy.rest(), posture).joints;
    std::vector<Bone> inside;
    for (int b = 0; b < bone_count; ++b)
        if (energy.metric().covers(b) && energy.metric().samples_inside(joints.head(b), joints.tail(b)) >= samples)
            inside.push_back(Bone(b));
    return inside;
}

std::vector<Hypothesis> find_hypotheses(const Rig& rig, const TriangleMesh& body, const TriangleMesh& outward,
                                        const FitOptions& options, const Progress& progress)
{
    const Garment given = measure(rig, body, outward, options);
    std::vector<WayUp> rest = ways_up(outward, given.held.openings);
    const std::vector<WayUp> likely = likely_ways(rest, options);
    std::vector<Hypothesis> all = search(rig, given, likely, options, progress.part(0, 0.5));
    if (!any_possible(all))
        for (Hypothesis& hypothesis : search(rig, given, rest, options, progress.part(0.5, 1)))
            all.push_back(std::move(hypothesis));
    sort_by_probability(all);
    return all;
}

}  // namespace garmentfit
