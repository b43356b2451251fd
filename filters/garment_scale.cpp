// SPDX-License-Identifier: GPL-3.0-or-later
#include "garment_scale.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "garmentfit/filters/frame_choice.h"
#include "tuning.h"

namespace garmentfit {
namespace {

double normal(double deviation, double spread)
{
    return std::exp(-0.5 * std::pow(deviation / spread, 2)) / (std::sqrt(2 * std::numbers::pi) * spread);
}

/// No garment hangs far below the feet of whom it fits, and none is a doll's. @param share  of the stature
double likelihood_of_length(double share)
{
    const double beyond
        = std::max({ 0.0, std::log(share / k_longest_share), std::log(k_shortest_share / share) }) / k_length_spread;
    return std::exp(-0.5 * beyond * beyond);
}

/// What the measures of a garment say of the person whom it fits. A measure may be mistaken for another, or be a style:
/// none of them can exclude a size that the others agree on.
class Wearer {
public:
    Wearer(const std::vector<WearerHeight>& wearers, double length, double height) :
        wearers_(wearers), length_(length), height_(height)
    {
    }

    /// That the garment, with its size multiplied by exp(log_factor), fits somebody exp(log_stature) times as tall as the
    /// body, but no taller than people are.
    double likelihood(double log_factor, double log_stature = 0) const
    {
        const double stature = std::min(std::exp(log_stature) * height_, std::max(height_, k_tallest_wearer));
        return likelihood_of_measures(log_factor - log_stature)
            * likelihood_of_length(std::exp(log_factor) * length_ / stature);
    }

    /// The same where it was made for somebody else, as large as the body or not.
    double likelihood_of_others(double log_factor) const
    {
        double sum = 0;
        for (int i = -k_steps_of_others; i <= k_steps_of_others; ++i) {
            const double other = i * k_step;
            sum += density_of_others(other) * likelihood_of_stature(other) * k_step * likelihood(log_factor, other);
        }
        return sum;
    }

    /// With its size multiplied by a factor, for people so much smaller that the fit refuses it, and names its unit as
    /// the reason.
    bool is_dolls(double factor) const
    {
        const std::optional<double> median = median_wearer(wearers_);
        return median && *median * factor <= k_least_wearer * height_;
    }

    /// Logarithms of factors between which any measure fits, one k_step apart.
    std::vector<double> log_factors() const
    {
        std::vector<double> ends;
        for (const WearerHeight& wearer : wearers_)
            for (const double sign : { -1.0, 1.0 })
                ends.push_back(std::log(height_ / wearer.height) + sign * k_widest * wearer.spread);
        const auto [least, most] = std::minmax_element(ends.begin(), ends.end());
        std::vector<double> all(std::size_t((*most - *least) / k_step) + 1);
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = *least + double(i) * k_step;
        return all;
    }

private:
    static constexpr int k_steps_of_others = 100;
    static constexpr double k_widest = 4;  // unit: of a spread, where nothing is left of it

    /// Nobody is taller than people are, but clothes may be made as if for somebody who is.
    double likelihood_of_stature(double log_stature) const
    {
        const double beyond = std::max(0.0, log_stature - std::max(0.0, std::log(k_tallest_wearer / height_)));
        return std::exp(-0.5 * std::pow(beyond / k_oversize, 2));
    }

    double likelihood_of_measures(double log_factor) const
    {
        double log_likelihood = 0;
        for (const WearerHeight& wearer : wearers_)
            log_likelihood += std::log((1 - k_mistaken) * normal(deviation(wearer, log_factor), wearer.spread)
                                       + k_mistaken * k_mistaken_density);
        return std::exp(log_likelihood / k_dependence);
    }

    double deviation(const WearerHeight& wearer, double log_factor) const
    {
        const double taller = std::log(wearer.height / height_) + log_factor;
        return wearer.is_least ? std::max(taller, 0.0) : taller;
    }

    const std::vector<WearerHeight>& wearers_;
    double length_, height_;
};

/// An explanation of the size.
struct Hypothesis {
    double factor = 1, weight = 0;
};

double usualness(const UsualUnit& unit, double usual_unit)
{
    return unit.usualness * (metres_per(unit.name) == usual_unit ? k_usual_unit : 1);
}

/// One for each unit, made for people as large as the body or not.
std::vector<Hypothesis> in_units(const Wearer& wearer, double prior, double metres_per_unit, double usual_unit)
{
    double all = 0;
    for (const UsualUnit& unit : k_usual_units)
        all += usualness(unit, usual_unit);
    std::vector<Hypothesis> hypotheses;
    for (const UsualUnit& unit : k_usual_units) {
        const double factor = metres_per(unit.name) / metres_per_unit;
        const double likelihood = wearer.is_dolls(factor) ? 0 : wearer.likelihood_of_others(std::log(factor));
        hypotheses.push_back({ factor, prior * usualness(unit, usual_unit) / all * likelihood });
    }
    return hypotheses;
}

/// Any size may be the right one, made for the body.
std::vector<Hypothesis> without_unit(const Wearer& wearer, double prior)
{
    std::vector<Hypothesis> hypotheses;
    for (const double log_factor : wearer.log_factors())
        hypotheses.push_back(
            { std::exp(log_factor), prior * k_without_unit_density * k_step * wearer.likelihood(log_factor) });
    return hypotheses;
}

double sum_of(const std::vector<Hypothesis>& hypotheses)
{
    return std::accumulate(hypotheses.begin(), hypotheses.end(), 0.0,
                           [](double sum, const Hypothesis& each) { return sum + each.weight; });
}

/// Half of the weight is on smaller factors.
double median_factor(const std::vector<Hypothesis>& hypotheses)
{
    const double half = 0.5 * sum_of(hypotheses);
    double below = 0;
    const auto found = std::find_if(hypotheses.begin(), hypotheses.end(),
                                    [&](const Hypothesis& each) { return (below += each.weight) >= half; });
    return found == hypotheses.end() ? 1 : found->factor;
}

double weight_near(const std::vector<Hypothesis>& hypotheses, double factor)
{
    double weight = 0;
    for (const Hypothesis& each : hypotheses)
        if (std::abs(std::log(each.factor / factor)) < k_same_size)
            weight += each.weight;
    return weight;
}

}  // namespace

double density_of_others(double log_stature)
{
    return (1 - k_children) * normal(log_stature, k_wearer_spread)
        + k_children * normal(log_stature - k_child_size, k_child_spread);
}

Vec3 extents_of(const Positions& positions, const Triangles& triangles)
{
    if (triangles.rows() == 0)
        return Vec3::Zero();
    const Positions corners = positions(triangles.reshaped(), Eigen::all);
    return (corners.colwise().maxCoeff() - corners.colwise().minCoeff()).transpose();
}

bool is_normalised(const Positions& positions, const Triangles& triangles)
{
    const double longest = extents_of(positions, triangles).maxCoeff();
    return std::abs(longest - 1) < k_normalised || std::abs(longest / 2 - 1) < k_normalised;
}

std::optional<double> median_wearer(std::span<const WearerHeight> wearers)
{
    std::vector<double> heights;
    for (const WearerHeight& wearer : wearers)
        if (!wearer.is_least)
            heights.push_back(wearer.height);
    if (heights.empty())
        return {};
    const auto median = heights.begin() + std::ptrdiff_t(heights.size() / 2);
    std::nth_element(heights.begin(), median, heights.end());
    return *median;
}

ScaleGuess guess_scale(const std::vector<WearerHeight>& wearers, double length, double height, double metres_per_unit,
                       double usual_unit, bool normalised)
{
    if (wearers.empty() || !(height > 0) || !(length > 0))
        return {};
    const Wearer wearer(wearers, length, height);
    const double odds = k_without_unit / (1 - k_without_unit) * (normalised ? k_normalised_odds : 1);
    const double prior = odds / (1 + odds);  // that there is no unit
    const std::vector<Hypothesis> units = in_units(wearer, 1 - prior, metres_per_unit, usual_unit),
                                  any = without_unit(wearer, prior);
    const Hypothesis unit = *std::max_element(units.begin(), units.end(),
                                              [](const auto& a, const auto& b) { return a.weight < b.weight; });
    const double sum = sum_of(units) + sum_of(any);
    if (!(sum > 0))
        return {};
    const double factor = sum_of(any) > unit.weight ? median_factor(any) : unit.factor;
    const auto probability = [&](double of) { return (weight_near(units, of) + weight_near(any, of)) / sum; };
    return { factor, probability(factor), unit.factor, probability(unit.factor) };
}

}  // namespace garmentfit
