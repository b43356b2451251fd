// SPDX-License-Identifier: GPL-3.0-or-later
#include "limb_end.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace garmentfit {
namespace {

constexpr double k_girth_spread = 0.10;  // relative
constexpr double k_widening = 1.15;  // of girth: wrist to palm, shin to heel
constexpr int k_wider_in_a_row = 3;  // a single cut may go astray

// Fingers end 0.035 of stature round, toes 0.07 at most, stumps of arms 0.08, of legs 0.12 at least. What ends wide, a fist or a shoe, is
// wider than the wrist or shin behind it, by 1.15 of girth in nearly all bodies; a stump only tapers, to 1.02 at most.
constexpr double k_thin_hand = 0.045, k_thin_foot = 0.09, k_wider_end = 1.08;
// A mitten may hide the wrist, but does not taper: forearms to 0.73 to 0.83 of their girth between these places. With it an arm is
// longer, from where it leaves the trunk, than 0.33; without a hand, than 0.31 at most.
constexpr double k_taper_from = 0.12, k_taper_to = 0.04,
                 k_most_tapered = 0.9;  // shares of stature, from the end; of girth
constexpr double k_with_hand = 0.32;  // of stature
constexpr double k_end = 0.16, k_palm = 0.1, k_instep = 0.14;  // of stature, from the end of a limb's curve

/// Median of three cuts: one may go astray.
double girth_about(const Centreline& line, int row)
{
    const double before = line.girths[std::max(0, row - 1)], here = line.girths[row],
                 after = line.girths[std::min(row + 1, int(line.girths.size()) - 1)];
    return std::max(std::min(before, here), std::min(std::max(before, here), after));
}

/// How much wider a limb's last stretch is, m, than what is behind it: elbows bulge too, but further up.
double widening(const Centreline& line, double last_stretch, double size)
{
    double smallest = std::numeric_limits<double>::max(), widest = 0;
    for (int i = line.nearest_row(line.at(line.length() - k_end * size)); i + 1 < line.size(); ++i)
        if (const double girth = girth_about(line, i); girth > 0) {
            if (line.length() - line.arcs[i] < last_stretch)
                widest = std::max(widest, girth / smallest);
            smallest = std::min(smallest, girth);
        }
    return widest;
}

double end_girth(const Centreline& line) { return std::min(line.girths.back(), line.girths[line.size() - 2]); }

/// Of girth, towards the end of an arm.
double taper(const Centreline& line, double size)
{
    const auto girth
        = [&](double share) { return girth_about(line, line.nearest_row(line.at(line.length() - share * size))); };
    return girth(k_taper_to) / girth(k_taper_from);
}

double free_length(const Centreline& line) { return line.length() - line.arcs[line.first_free]; }

}  // namespace

Narrowest narrowest(const Centreline& line, const Vec3& tip, const ReachRange& reach)
{
    Narrowest best;
    int wider_in_a_row = 0;
    double least = std::numeric_limits<double>::max(), smallest = least;
    for (int i = line.first_free; i < line.size() && !best.widens; ++i) {
        const double off = (tip - line.points[i]).norm();
        if (!line.free[i] || off > reach.most || off < reach.least)
            continue;
        const double girth = girth_about(line, i);
        wider_in_a_row = girth > k_widening * smallest ? wider_in_a_row + 1 : 0;
        best.widens = wider_in_a_row == k_wider_in_a_row;
        if (wider_in_a_row > 0 || !line.across[i])
            continue;
        smallest = std::min(smallest, girth);
        const double score = std::log(girth) / k_girth_spread + 0.5 * std::pow((off - reach.usual) / reach.spread, 2);
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
        || (taper(line, size) > k_most_tapered && free_length(line) > k_with_hand * size);
}

bool has_foot(const Centreline& line, double size)
{
    return end_girth(line) < k_thin_foot * size || widening(line, k_instep * size, size) > k_wider_end;
}

}  // namespace garmentfit
