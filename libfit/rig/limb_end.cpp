// SPDX-License-Identifier: GPL-3.0-or-later
#include "limb_end.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tuning.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

/// Median of three cuts, because a single cut may be wrong.
double girth_about(const Centreline& line, int row)
{
    const double before = line.girths[std::max(0, row - 1)], here = line.girths[row],
                 after = line.girths[std::min(row + 1, int(line.girths.size()) - 1)];
    return std::max(std::min(before, here), std::min(std::max(before, here), after));
}

/// Largest ratio of a girth in the last part of a limb, m long, to the smallest girth before it. The search begins
/// beyond the elbow, which is wide too.
double widening(const Centreline& line, double last_part, double size)
{
    double smallest = std::numeric_limits<double>::max(), widest = 0;
    for (int i = line.nearest_row(line.at(line.length() - k_limb_end * size)); i + 1 < line.size(); ++i)
        if (const double girth = girth_about(line, i); girth > 0) {
            if (line.length() - line.arcs[i] < last_part)
                widest = std::max(widest, girth / smallest);
            smallest = std::min(smallest, girth);
        }
    return widest;
}

double end_girth(const Centreline& line) { return std::min(line.girths.back(), line.girths[line.size() - 2]); }

/// Ratio of two girths near the end of an arm.
double taper(const Centreline& line, double size)
{
    const auto girth
        = [&](double share) { return girth_about(line, line.nearest_row(line.at(line.length() - share * size))); };
    return girth(k_taper_to) / girth(k_taper_from);
}

/// The last point of the line that is so far from its end, m, as the crow flies.
Vec3 at_distance_from_end(const Centreline& line, double distance)
{
    int i = line.size() - 1;
    while (i > 0 && (line.points[i] - line.points.back()).norm() < distance)
        --i;
    return line.points[i];
}

/// Angle between the shin and the end of a leg, rad: the curve of a leg follows its foot to the toes. Where it goes to and
/// fro at the ankle, lengths along it say little.
double foot_angle(const Centreline& line, double size)
{
    const auto direction = [&](double from, double to) -> Vec3 {
        return (at_distance_from_end(line, to * size) - at_distance_from_end(line, from * size)).normalized();
    };
    const double cosine = direction(k_shin_from, k_shin_to).dot(direction(k_forefoot, 0));
    return std::acos(std::clamp(cosine, -1.0, 1.0));
}

double free_length(const Centreline& line) { return line.length() - line.arcs[line.first_free]; }

}  // namespace

Narrowest find_narrowest(const Centreline& line, const Vec3& tip, const TipDistance& distance)
{
    Narrowest best;
    int wider_in_a_row = 0;
    double least = std::numeric_limits<double>::max(), smallest = least;
    for (int i = line.first_free; i < line.size() && !best.widens; ++i) {
        const double off = (tip - line.points[i]).norm();
        if (!line.free[i] || off > distance.most || off < distance.least)
            continue;
        const double girth = girth_about(line, i);
        wider_in_a_row = girth > k_limb_widening * smallest ? wider_in_a_row + 1 : 0;
        best.widens = wider_in_a_row == k_wider_in_a_row;
        if (wider_in_a_row > 0 || !line.across[i])
            continue;
        smallest = std::min(smallest, girth);
        // derived: negative log-likelihood of two normal distributions, constants and the factor of the first left out
        const double score
            = std::log(girth) / k_girth_spread + 0.5 * std::pow((off - distance.usual) / distance.spread, 2);
        if (score < least) {
            least = score;
            best.row = i;
        }
    }
    return best;
}

bool has_hand(const Centreline& line, double size)
{
    return end_girth(line) < k_thin_hand * size || widening(line, k_palm * size, size) > k_wider_end
        || (taper(line, size) > k_most_tapered && free_length(line) > k_arm_with_hand * size);
}

bool has_foot(const Centreline& line, double size)
{
    return end_girth(line) < k_thin_foot * size || widening(line, k_instep * size, size) > k_wider_end
        || foot_angle(line, size) > k_least_foot_angle;
}

bool shows_hand(const Centreline& line, double size)
{
    return widening(line, k_palm * size, size) > k_wider_end && end_girth(line) < k_thin_hand * size;
}

bool shows_foot(const Centreline& line, double size)
{
    return widening(line, k_instep * size, size) > k_wider_end && end_girth(line) < k_thin_foot * size
        && foot_angle(line, size) > k_least_foot_angle;
}

}  // namespace garmentfit
