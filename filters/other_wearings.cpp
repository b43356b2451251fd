// SPDX-License-Identifier: GPL-3.0-or-later
#include "other_wearings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "attempt.h"
#include "garment_scale.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/verdict.h"
#include "stages.h"
#include "tuning.h"

namespace garmentfit {
namespace {

constexpr double k_same_direction = 0.5;  // derived: cosine; between quarter turns and noise, as in the fit

double furthest_slip(const Dressing& end)
{
    double furthest = 0;
    for (const WornGarment& garment : end.garments)
        furthest = std::max(furthest, garment.slipped * end.to_human_size);
    return furthest;
}

// Of people for whom the garment is made. Of people of one stature, some have wider girths.
double size_of(const Scene& scene, std::size_t garment)
{
    const Dressing* end = final_dressing(scene);
    if (!end || !end->is_worn(garment))
        return 1;
    const WornGarment& worn = end->garments[garment];
    return worn.size * std::pow(worn.girth, k_size_of_girth);
}

bool is_another_size(double size) { return size > 1 + k_same_size; }

std::size_t most_enlarged(const Scene& scene)
{
    std::size_t most = 0;
    for (std::size_t i = 1; i < scene.garments.size(); ++i)
        if (size_of(scene, i) > size_of(scene, most))
            most = i;
    return most;
}

End end_of(const Scene& scene)
{
    const Dressing* end = final_dressing(scene);
    if (!end)
        return End::refused;
    if (outcome_of(*end) != Outcome::done)
        return outcome_of(*end) == Outcome::too_small ? End::too_small : End::not_certified;
    return first_garment(*end, is_torn) || first_garment(*end, has_slipped_down) ? End::torn_or_slipped : End::worn;
}

// The garment with the tightest part, or the one that was put on last; without an end, the one that was refused.
std::size_t garment_at_fault(const Scene& scene, std::size_t refused)
{
    const Dressing* found = final_dressing(scene);
    if (!found)
        return refused;
    const Dressing& end = *found;
    if (const std::size_t most = most_enlarged(scene); is_another_size(size_of(scene, most)))
        return most;
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

std::string reason_against(const Scene& scene, std::size_t garment)
{
    const Dressing* found = final_dressing(scene);
    if (!found)
        return "its cloth lies across the bones of the body";
    const Dressing& end = *found;
    if (outcome_of(end) != Outcome::done)
        return explain(end, names_of(scene));
    if (const double size = size_of(scene, garment); is_another_size(size))
        return "it has to be " + std::to_string(std::lround(100 * (size - 1))) + "% larger";
    return first_garment(end, is_torn) ? "the cloth is stretched too far" : "it slips down";
}

// Both then count for the second one, which keeps the more probable name.
FitResult with_probability_of(const FitResult& first, FitResult second)
{
    if (!is_within(first, second))
        return second;
    second.probability = std::min(1.0, first.probability + second.probability);
    second.type = first.type;
    second.type_probability = first.type_probability;
    return second;
}

double plausibility_of(const Scene& scene, std::size_t garment)
{
    return plausibility(scene.fits[garment].probability, end_of(scene), size_of(scene, garment));
}

bool is_worn_well(const Scene& scene)
{
    return end_of(scene) == End::worn && !is_another_size(size_of(scene, most_enlarged(scene)));
}

// The more plausible scene of two stays, the other way of wearing the garment is listed in `rejected`.
void keep_better(Scene& scene, Scene&& other, std::size_t garment)
{
    const auto plausibility_in = [&](const Scene& s) { return plausibility_of(s, garment); };
    const bool wins = plausibility_in(other) > plausibility_in(scene);
    const Scene& worse = wins ? scene : other;
    const Rejected loser = rejected(worse.fits[garment], reason_against(worse, garment));
    if (wins) {
        const std::vector<Rejected> before = std::exchange(scene, std::move(other)).fits[garment].rejected;
        auto& all = scene.fits[garment].rejected;
        all.insert(all.begin(), before.begin(), before.end());
    }
    scene.fits[garment].rejected.push_back(loser);
}

bool dress_anew(Scene& scene, const DressingSteps& steps)
{
    scene.draped.reset();
    scene.recovered.reset();
    return succeeds([&] {
        steps.fit(scene);
        steps.drape_and_recover(scene);
    });
}

// A garment whose size is wrong, and other sizes for it.
struct WrongSize {
    std::size_t garment;
    std::span<const double> others;
};

std::optional<WrongSize> find_wrong_size(const Scene& scene, std::size_t refused)
{
    const End end = end_of(scene);
    if (end == End::refused || end == End::too_small)
        return WrongSize { garment_at_fault(scene, refused), k_larger_sizes };
    if (end == End::not_certified)
        return {};
    const std::optional<std::size_t> slipped = first_garment(*final_dressing(scene), has_slipped);
    return slipped ? std::optional(WrongSize { *slipped, k_smaller_sizes }) : std::nullopt;
}

bool stays_on(const Scene& scene)
{
    const Dressing& end = *final_dressing(scene);
    return furthest_slip(end) < k_stays && !first_garment(end, has_slipped) && !first_garment(end, has_lost_a_piece);
}

// Of skirts and the like, either side may come out in front.
bool is_same_way(const FitResult& one, const FitResult& other)
{
    return one.type == other.type && one.up.dot(other.up) > k_same_direction;
}

}  // namespace

bool is_within(const FitResult& way, const FitResult& other)
{
    return way.up.dot(other.up) > k_same_direction && way.front.dot(other.front) > k_same_direction
        && std::all_of(way.covered.begin(), way.covered.end(), [&](Bone bone) {
               return std::find(other.covered.begin(), other.covered.end(), bone) != other.covered.end();
           });
}

double plausibility(double probability, End end, double size)
{
    const double of_size = is_another_size(size) ? density_of_others(-std::log(size)) / density_of_others(0) : 1;
    return probability * k_end_likelihoods[static_cast<int>(end)] * of_size;
}

void try_size_in_unit(Scene& scene, const DressingSteps& steps, const Progress& progress)
{
    if (progress.is_late() || end_of(scene) != End::too_small)
        return;
    Scene other = scene;
    if (take_size_in_unit(other) && dress_anew(other, steps) && end_of(other) == End::worn)
        scene = std::move(other);
}

void try_other_sizes(Scene& scene, const DressingSteps& steps, std::size_t refused, const Progress& progress)
{
    const std::optional<WrongSize> wrong = find_wrong_size(scene, refused);
    if (!wrong || scene.garments[wrong->garment].has_unit)
        return;
    for (const double size : wrong->others) {
        if (progress.is_late())
            return;
        Scene other = scene;
        take_size(other.garments[wrong->garment], size);
        if (dress_anew(other, steps) && end_of(other) == End::worn && stays_on(other)
            && (!final_dressing(scene) || is_same_way(other.fits[wrong->garment], scene.fits[wrong->garment]))) {
            scene = std::move(other);
            return;
        }
    }
}

void try_other_wearings(Scene& scene, const DressingSteps& steps, std::size_t refused, const Progress& progress)
{
    std::vector<int> tried(scene.garments.size(), 0);
    while (!is_worn_well(scene) && !progress.is_late()) {
        const std::size_t garment = garment_at_fault(scene, refused);
        if (++tried[garment] > k_other_wearings)
            return;
        Scene other = scene;
        other.garments[garment].skipped = tried[garment];
        take_as_given(other.garments[garment]);
        other.draped.reset();
        other.recovered.reset();
        if (!succeeds([&] { steps.fit(other); }))
            return;
        FitResult& fit = other.fits[garment];
        if (fit.probability < k_worth_trying)
            return;
        fit = with_probability_of(scene.fits[garment], fit);
        if (plausibility(fit.probability, End::worn) <= plausibility_of(scene, garment))
            return;
        const bool has_ended = succeeds([&] {
            try {
                steps.drape_and_recover(other);
            } catch (const RefusedGarment&) {
                // it may be this garment or one over it: keep_better sees that there is no end
            }
        });
        if (!has_ended)
            return;
        keep_better(scene, std::move(other), garment);
    }
}

}  // namespace garmentfit
