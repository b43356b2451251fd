// SPDX-License-Identifier: GPL-3.0-or-later
#include "garment_scale.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "garmentfit/filters/frame_choice.h"
#include "tuning.h"

namespace garmentfit {
namespace {

constexpr std::size_t k_min_parts = 2;  // derived: one part may be mistaken for another, two agree

/// What all parts have in common: the least deviation, 0 where some are too large and others too small.
double common_deviation(const std::vector<double>& deviations, double shift)
{
    const auto [least, most] = std::minmax_element(deviations.begin(), deviations.end());
    return std::max(0.0, *least + shift) + std::min(0.0, *most + shift);
}

/// Of a garment that has the size of its unit.
double likelihood(double deviation)
{
    const double spread = deviation > 0 ? k_too_large_spread : k_too_small_spread;
    return std::exp(-0.5 * std::pow(deviation / spread, 2)) / (std::sqrt(2 * std::numbers::pi) * spread);
}

/// No garment hangs far below the feet of whom it fits. @param share  of the longest that a garment may be
double likelihood_of_length(double share)
{
    return share > 1 ? std::exp(-0.5 * std::pow(std::log(share) / k_too_large_spread, 2)) : 1;
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

}  // namespace

ScaleGuess guess_scale(const std::vector<double>& statures, double length, double height, double metres_per_unit,
                       bool as_body)
{
    if (statures.size() < k_min_parts || !(height > 0) || !(length > 0))
        return {};
    std::vector<double> deviations;
    for (const double stature : statures)
        deviations.push_back(std::log(stature / height));

    const double longest = k_longest_share * height / length;
    const auto likelihood_of = [&](double factor) {
        return likelihood(common_deviation(deviations, std::log(factor))) * likelihood_of_length(factor / longest);
    };

    const SizePriors& priors = as_body ? k_priors_as_body : k_priors_otherwise;
    std::vector<ScaleGuess> hypotheses { { 1, priors.guessed_unit * likelihood_of(1) },
                                         { std::min(std::exp(-median(deviations)), longest),
                                           priors.no_unit * k_no_unit_density } };
    for (const std::string_view unit : unit_choices())
        if (unit != "auto" && metres_per(unit) != metres_per_unit) {
            const double factor = metres_per(unit) / metres_per_unit;
            hypotheses.push_back({ factor, priors.other_unit * likelihood_of(factor) });
        }
    double sum = 0;
    for (const ScaleGuess& hypothesis : hypotheses)
        sum += hypothesis.probability;
    ScaleGuess best = *std::max_element(hypotheses.begin(), hypotheses.end(),
                                        [](const auto& a, const auto& b) { return a.probability < b.probability; });
    best.probability /= sum;
    return best;
}

}  // namespace garmentfit
