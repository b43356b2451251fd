// SPDX-License-Identifier: GPL-3.0-or-later
#include "collision_free_step.h"

#include <algorithm>
#include <atomic>

#include "disjoint_sets.h"
#include "parallel.h"
#include "tuning.h"

namespace garmentfit {
namespace {

// unit: pairs worth handing to another thread.
constexpr std::size_t k_grain = 1024;

void lower(std::atomic<double>& value, double to)
{
    double now = value.load(std::memory_order_relaxed);
    while (to < now && !value.compare_exchange_weak(now, to, std::memory_order_relaxed)) { }
}

/// Lowers fractions round by round. A lower fraction changes the paths of other pairs, so each pair with a vertex that
/// changed is tested again.
class FractionSearch {
public:
    FractionSearch(const std::vector<ContactPair>& pairs, const Positions& x, const Positions& displacements,
                   double min_distance) :
        pairs_(pairs),
        x_(x), displacements_(displacements), min_distance_(min_distance), fractions_(x.rows(), 1.0),
        is_changed_(x.rows()), next_(x.rows())
    {
        for (Eigen::Index v = 0; v < x.rows(); ++v)
            is_changed_[v] = !displacements.row(v).isZero(0);
    }

    std::vector<double> run() &&
    {
        for (int round = 0; lower_all(round); ++round) { }
        return std::move(fractions_);
    }

private:
    /// @return whether any fraction fell
    bool lower_all(int round)
    {
        for (std::size_t v = 0; v < fractions_.size(); ++v)
            next_[v].store(fractions_[v], std::memory_order_relaxed);
        parallel_for(
            pairs_.size(), [&](std::size_t p) { lower_pair(pairs_[p], round); }, k_grain);
        bool any = false;
        for (std::size_t v = 0; v < fractions_.size(); ++v) {
            const double fraction = next_[v].load(std::memory_order_relaxed);
            is_changed_[v] = fraction != fractions_[v];
            any |= is_changed_[v];
            fractions_[v] = fraction;
        }
        return any;
    }

    // After the last round, vertices of a pair that still collides stand still. That always ends: positions now are
    // free.
    void lower_pair(const ContactPair& pair, int round)
    {
        const auto& v = pair.vertices;
        if (!(is_changed_[v[0]] || is_changed_[v[1]] || is_changed_[v[2]] || is_changed_[v[3]]))
            return;
        Corners d = corners_of(displacements_, v);
        for (int k = 0; k < 4; ++k)
            d[k] *= fractions_[v[k]];
        if (relative_travel(pair.kind, d) <= pair.at.distance - required_distance(pair.at.distance, min_distance_))
            return;
        const double fraction = collision_free_fraction(pair.kind, corners_of(x_, v), d, min_distance_);
        if (fraction < 1)
            for (int k = 0; k < 4; ++k)
                lower(next_[v[k]],
                      round < k_most_fraction_rounds ? fractions_[v[k]] * std::min(fraction, k_least_cut) : 0.0);
    }

    const std::vector<ContactPair>& pairs_;
    const Positions &x_, &displacements_;
    double min_distance_;
    std::vector<double> fractions_;
    std::vector<char> is_changed_;
    std::vector<std::atomic<double>> next_;
};

/// The mean of the values of each set, at all of its vertices; 0 for a set with a vertex from `first_fixed` on.
Positions mean_of_sets(DisjointSets& sets, const Positions& values, int first_fixed)
{
    Positions sum = Positions::Zero(values.rows(), 3);
    std::vector<int> size(values.rows(), 0);
    for (int v = 0; v < int(values.rows()); ++v) {
        sum.row(sets.root(v)) += values.row(v);
        ++size[sets.root(v)];
    }
    for (int v = first_fixed; v < int(values.rows()); ++v)
        sum.row(sets.root(v)).setZero();
    Positions result(values.rows(), 3);
    for (int v = 0; v < int(values.rows()); ++v)
        result.row(v) = sum.row(sets.root(v)) / size[sets.root(v)];
    return result;
}

}  // namespace

std::vector<double> collision_free_fractions(const std::vector<ContactPair>& pairs, const Positions& x,
                                             const Positions& displacements, double min_distance)
{
    return FractionSearch(pairs, x, displacements, min_distance).run();
}

// A zone may collide with further pairs, so zones grow until no pair collides that is not within one.
Positions merge_impact_zones(const std::vector<ContactPair>& pairs, int cloth_vertices, const Positions& x,
                             const Positions& displacements, double min_distance)
{
    DisjointSets zones(int(x.rows()));
    const int first_fixed
        = displacements.bottomRows(x.rows() - cloth_vertices).isZero(0) ? cloth_vertices : int(x.rows());
    Positions common = displacements;
    std::vector<char> collides(pairs.size());
    for (bool grown = true; grown;) {
        const auto test = [&](std::size_t p) {
            const auto& v = pairs[p].vertices;
            collides[p] = collision_free_fraction(pairs[p].kind, corners_of(x, v), corners_of(common, v), min_distance)
                < k_zone_free_fraction;
        };
        parallel_for(pairs.size(), test, k_grain);
        grown = false;
        for (std::size_t p = 0; p < pairs.size(); ++p)
            if (collides[p])
                for (int k = 1; k < 4; ++k)
                    grown |= zones.join(pairs[p].vertices[0], pairs[p].vertices[k]);
        common = mean_of_sets(zones, displacements, first_fixed);
    }
    return common;
}

}  // namespace garmentfit
