// SPDX-License-Identifier: GPL-3.0-or-later
#include "other_wearings.h"

#include <algorithm>
#include <string>
#include <utility>

#include "garmentfit/filters/outcome.h"
#include "tuning.h"

namespace garmentfit {
namespace {

double largest_stretch(const Dressing& end)
{
    double largest = 0;
    for (const Overstretch& stretch : end.overstretches)
        largest = std::max(largest, stretch.largest);
    return largest;
}

double furthest_slip(const Dressing& end)
{
    double furthest = 0;
    for (const WornGarment& garment : end.garments)
        furthest = std::max(furthest, garment.slipped);
    return furthest;
}

enum class End { worn, torn_or_slipped, hindered, refused };

// Less is better: how it ended, then how far it came.
std::pair<End, double> badness(const Scene& scene)
{
    const Dressing* end = final_dressing(scene);
    if (!end)
        return { End::refused, 0 };
    if (outcome_of(*end) != Outcome::done)
        return { End::hindered, -end->scale_reached - end->pose_reached };
    const bool is_worn = largest_stretch(*end) <= k_torn && furthest_slip(*end) <= k_slipped;
    return { is_worn ? End::worn : End::torn_or_slipped, is_worn ? 0 : largest_stretch(*end) };
}

// A less probable way has to be worn as it should. Torn or round the knees it does not beat a more probable one, of
// which the user is told that the garment is too small.
bool is_better(const Scene& other, const Scene& present)
{
    const auto now = badness(present), then = badness(other);
    return then < now && (then.first == End::worn || then.first == now.first || now.first == End::refused);
}

// The garment with the tightest part, or the one that was put on last; without an end, the first.
std::size_t garment_at_fault(const Scene& scene)
{
    const Dressing* found = final_dressing(scene);
    if (!found)
        return 0;
    const Dressing& end = *found;
    if (outcome_of(end) == Outcome::done) {
        const auto worst
            = std::max_element(end.overstretches.begin(), end.overstretches.end(),
                               [](const Overstretch& a, const Overstretch& b) { return a.largest < b.largest; });
        return std::size_t(worst - end.overstretches.begin());
    }
    return end.too_tight.empty() ? end.outermost : std::size_t(end.too_tight.front().garment);
}

std::vector<std::string> names_of(const Scene& scene)
{
    std::vector<std::string> names;
    for (const GarmentInput& garment : scene.garments)
        names.push_back(garment.name.empty() ? "the garment" : garment.name);
    return names;
}

Rejected rejected(const FitResult& fit, const std::string& reason)
{
    return { fit.type, fit.up, fit.front, fit.probability, reason };
}

std::string reason_against(const Scene& scene)
{
    const Dressing* found = final_dressing(scene);
    if (!found)
        return "its cloth lies across the bones of the body";
    const Dressing& end = *found;
    if (outcome_of(end) != Outcome::done)
        return explain(end, names_of(scene));
    return largest_stretch(end) > k_torn ? "the cloth is stretched too far" : "it slips down";
}

}  // namespace

void try_other_wearings(Scene& scene, const DressingSteps& steps, const Progress& progress)
{
    std::size_t garment = 0;
    for (int tried = 0; tried < k_other_wearings && badness(scene).first != End::worn && !progress.is_late(); ++tried) {
        const std::size_t at_fault = garment_at_fault(scene);
        if (tried > 0 && at_fault != garment)
            return;  // another garment hinders now
        garment = at_fault;
        Scene other = scene;
        other.garments[garment].skipped = tried + 1;
        other.draped.reset();
        other.recovered.reset();
        try {
            steps.fit(other);
            if (other.fits[garment].probability < k_worth_trying)
                return;
            steps.drape_and_recover(other);
        } catch (const InvalidInput&) {
            return;
        } catch (const SolverFailure&) {
            return;
        }
        const bool wins = is_better(other, scene);
        Scene& worse = wins ? scene : other;
        const Rejected loser = rejected(worse.fits[garment], reason_against(worse));
        if (wins) {
            const std::vector<Rejected> before = std::exchange(scene, std::move(other)).fits[garment].rejected;
            auto& all = scene.fits[garment].rejected;
            all.insert(all.begin(), before.begin(), before.end());
        }
        scene.fits[garment].rejected.push_back(loser);
    }
}

}  // namespace garmentfit
