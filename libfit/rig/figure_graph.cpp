// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_graph.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <string>

#include "curve_loops.h"
#include "garmentfit/error.h"
#include "surface_measures.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

constexpr std::size_t k_fewest_ends = 4;  // derived: hands and feet

// literature: [deleva_1996_segments], as between the ends in body_graph.cpp: along the curves from the spine to the
// fingers and from the pelvis to the toes, shares of stature.
constexpr double k_arm_curve = 0.45, k_leg_curve = 0.61, k_trunk_curve_length = 0.28, k_head_curve_length = 0.16;

constexpr double k_no_length = 1e-9;  // unit: m, avoids the logarithm of 0

double squared(double x) { return x * x; }

/// The ends of one tree, with all that the choice among them needs.
struct Candidates {
    std::vector<int> nodes;  ///< leaves
    Eigen::MatrixXd distance;  ///< m along the curves
    std::vector<double> thickness;  ///< m
    std::vector<Vec3> places;
    std::vector<Vec3> forks;  ///< of each three, in the order of fork()

    int count() const { return int(nodes.size()); }
    /// Where the paths between three ends meet.
    const Vec3& fork(int a, int b, int c) const { return forks[std::size_t((a * count() + b) * count() + c)]; }
    /// From `a` to where its path leaves the one from `b` to `c`, m.
    double beyond(int a, int b, int c) const { return 0.5 * (distance(a, b) + distance(a, c) - distance(b, c)); }
};

/// Mean distance of the skin from each node, m; 0 for a node without skin.
std::vector<double> radii_of_nodes(const CurveSkeleton& skeleton, const TriangleMesh& proxy)
{
    std::vector<double> sums(skeleton.nodes.size(), 0), counts(skeleton.nodes.size(), 0);
    for (std::size_t v = 0; v < skeleton.node_of_vertex.size(); ++v)
        if (const int node = skeleton.node_of_vertex[v]; node >= 0) {
            sums[node] += (Vec3(proxy.positions.row(Eigen::Index(v))) - skeleton.nodes[node]).norm();
            ++counts[node];
        }
    for (std::size_t n = 0; n < sums.size(); ++n)
        sums[n] = counts[n] > 0 ? sums[n] / counts[n] : 0;
    return sums;
}

/// Median radius along a branch, without the part within the trunk and the end.
double thickness_of(const std::vector<int>& branch, const std::vector<double>& radii)
{
    std::vector<double> values;
    for (std::size_t i = branch.size() / 6; i < branch.size() * 2 / 3 + 1 && i < branch.size(); ++i)
        if (radii[branch[i]] > 0)
            values.push_back(radii[branch[i]]);
    if (values.empty())
        return radii[branch.front()];
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

/// Removes the shortest branches until few enough ends remain to try all choices, and fingers and toes after them.
void prune_to_few(CurveTree& tree, double size)
{
    const auto length = [&](int leaf) { return tree.length(tree.branch(leaf)); };
    for (std::vector<int> leaves = tree.leaves(); leaves.size() > k_fewest_ends + 1; leaves = tree.leaves()) {
        const int shortest
            = *std::min_element(leaves.begin(), leaves.end(), [&](int a, int b) { return length(a) < length(b); });
        if (leaves.size() <= k_most_ends && length(shortest) > k_longest_finger * size)
            return;
        tree.remove(tree.branch(shortest));
    }
}

/// Nodes from each end to each other one, row by row.
std::vector<std::vector<int>> paths_between(const CurveTree& tree, const std::vector<int>& ends)
{
    const std::size_t n = ends.size();
    std::vector<std::vector<int>> paths(n * n);
    for (std::size_t i = 0; i < n; ++i) {
        paths[i * n + i] = { ends[i] };
        for (std::size_t j = 0; j < i; ++j) {
            paths[i * n + j] = tree.path(ends[i], ends[j]);
            paths[j * n + i].assign(paths[i * n + j].rbegin(), paths[i * n + j].rend());
        }
    }
    return paths;
}

/// The last node that two paths from one end share.
int last_shared(const std::vector<int>& one, const std::vector<int>& other)
{
    return *std::prev(std::mismatch(one.begin(), one.end(), other.begin(), other.end()).first);
}

Candidates candidates_of(const CurveTree& tree, const CurveSkeleton& skeleton, const std::vector<double>& radii)
{
    Candidates c;
    c.nodes = tree.leaves();
    const int n = c.count();
    const std::vector<std::vector<int>> paths = paths_between(tree, c.nodes);
    const auto path = [&](int a, int b) -> const std::vector<int>& { return paths[std::size_t(a * n + b)]; };
    c.distance.setZero(n, n);
    for (int a = 0; a < n; ++a) {
        for (int b = 0; b < a; ++b)
            c.distance(a, b) = c.distance(b, a) = tree.length(path(a, b));
        for (int b = 0; b < n; ++b)
            for (int e = 0; e < n; ++e)
                c.forks.push_back(skeleton.nodes[std::size_t(last_shared(path(a, b), path(a, e)))]);
        const int node = c.nodes[std::size_t(a)];
        c.thickness.push_back(thickness_of(tree.branch(node), radii));
        c.places.push_back(skeleton.nodes[std::size_t(node)]);
    }
    return c;
}

/// Rows of Candidates; head is -1 where there is none.
struct Choice {
    int head = -1, hand[2] {}, foot[2] {};
    bool covered = false;  ///< the legs do not show; both feet may be one end then, the hem
    double arm = 0, leg = 0;  ///< m, means of the pairs
    double size = 0;  ///< m, along the curves from the feet to the top
    double cost = std::numeric_limits<double>::max();
};

/// From the plane that mirrors a pair's ends, a share of the figure's length; 0 where the pair is one end.
double off_middle(const Candidates& c, const Choice& choice, const int (&pair)[2], int end)
{
    const Vec3 apart = c.places[pair[0]] - c.places[pair[1]], middle = 0.5 * (c.places[pair[0]] + c.places[pair[1]]);
    return (c.places[end] - middle).dot(apart) / std::max(apart.norm(), k_no_length) / choice.size;
}

/// 1 for an end in the planes that mirror hands and feet, such as a tail's, to 0 for one at a side.
double share_in_middle(const Candidates& c, const Choice& choice, int end)
{
    return std::exp(-squared(off_middle(c, choice, choice.hand, end) / k_middle_spread)
                    - squared(off_middle(c, choice, choice.foot, end) / k_middle_spread));
}

/// Of what the choice leaves over: tails, wings, hair. Short ends such as fingers cost little.
double cost_of_rest(const Candidates& c, const Choice& choice)
{
    const int chosen[] { choice.hand[0], choice.hand[1], choice.foot[0], choice.foot[1], choice.head };
    double cost = 0;
    for (int u = 0; u < c.count(); ++u) {
        double off = std::numeric_limits<double>::max();
        for (const int a : chosen)
            for (const int b : chosen)
                if (a >= 0 && b >= 0 && a != b)
                    off = std::min(off, u == a || u == b ? 0 : c.beyond(u, a, b));
        cost += std::min(squared(off / choice.size / k_rest_spread), k_most_rest_cost)
            * (1 - k_tail_discount * share_in_middle(c, choice, u));
    }
    return cost;
}

double cost_of_pair(const Candidates& c, const int (&pair)[2], double length0, double length1)
{
    const auto deviation = [](double one, double other, double spread) {
        return squared(std::log((one + k_no_length) / (other + k_no_length)) / spread);
    };
    return deviation(length0, length1, k_pair_length_spread)
        + deviation(c.thickness[pair[0]], c.thickness[pair[1]], k_pair_thickness_spread);
}

/// A pair's ends are about as far from a place in the middle as each other. Limits what a pose may cost.
double cost_of_places(const Candidates& c, const int (&pair)[2], const Vec3& middle, double size)
{
    const double difference = (c.places[pair[0]] - middle).norm() - (c.places[pair[1]] - middle).norm();
    return std::min(squared(difference / size / k_place_spread), k_most_place_cost);
}

/// A neck may bend, but a head does not hang down from the shoulders.
double cost_of_neck(const Candidates& c, const Choice& choice)
{
    const auto [h0, h1] = choice.hand;
    const auto [f0, f1] = choice.foot;
    const Vec3 shoulders = 0.5 * (c.fork(h0, choice.head, f0) + c.fork(h1, choice.head, f0));
    const Vec3 neck = c.places[std::size_t(choice.head)] - shoulders, trunk = shoulders - c.fork(f0, f1, choice.head);
    const Vec3 up = trunk.norm() > k_short_trunk * choice.size
        ? trunk
        : Vec3(shoulders - 0.5 * (c.places[std::size_t(f0)] + c.places[std::size_t(f1)]));
    const double cosine = up.dot(neck) / std::max(up.norm() * neck.norm(), k_no_length);
    return squared(std::max(k_bent_neck - cosine, 0.0) / k_neck_spread);
}

/// Fills sizes and cost; a cost of more than `most` may be left out.
void rate(const Candidates& c, double most, Choice& choice)
{
    const int h0 = choice.hand[0], h1 = choice.hand[1], f0 = choice.foot[0], f1 = choice.foot[1];
    const int top = choice.head >= 0 ? choice.head : h0;
    const double leg0 = c.beyond(f0, f1, top), leg1 = c.beyond(f1, f0, top);
    const double arm0 = choice.head >= 0 ? c.beyond(h0, f0, top) : c.beyond(h0, h1, f0),
                 arm1 = choice.head >= 0 ? c.beyond(h1, f0, top) : c.beyond(h1, h0, f0);
    const double head0 = choice.head >= 0 ? c.distance(h0, top) - arm0 : 0,
                 head1 = choice.head >= 0 ? c.distance(h1, top) - arm1 : 0;
    const double head = 0.5 * (head0 + head1);
    choice.leg = 0.5 * (leg0 + leg1);
    choice.arm = 0.5 * (arm0 + arm1);
    double trunk = (choice.head >= 0 ? c.distance(f0, top) - leg0 - head : c.distance(f0, h0) - leg0 - arm0);
    const Vec3 feet = 0.5 * (c.places[f0] + c.places[f1]),
               above = choice.head >= 0 ? c.places[choice.head] : Vec3(0.5 * (c.places[h0] + c.places[h1]));
    const double upright = (above - feet).normalized().y();
    if (choice.covered) {
        const double whole = trunk + choice.leg;
        if (choice.head < 0 || trunk < k_covered_trunk * whole || upright < k_covered_upright)
            return;
        trunk = k_trunk_curve_length / (k_trunk_curve_length + k_leg_curve) * whole;
        choice.leg = whole - trunk;
    }
    choice.size = choice.leg + std::max(trunk, 0.0) + head;
    if (std::min({ choice.covered ? choice.leg : std::min(leg0, leg1), arm0, arm1 }) < k_shortest_limb * choice.size
        || trunk < -k_pair_fork_spread * choice.size)
        return;  // no limb, or arms below the legs
    if (c.beyond(h0, h1, f0) < k_own_share * arm0 || c.beyond(h1, h0, f0) < k_own_share * arm1)
        return;  // two fingers of one hand
    const auto ratio = [&](double length, double to, double usual, double spread) {
        return squared(std::log(std::max(length, 0.02 * choice.size) / to / usual) / spread);
    };
    double cost = cost_of_pair(c, choice.hand, arm0, arm1);
    cost += cost_of_places(c, choice.hand, above, choice.size) + cost_of_places(c, choice.hand, feet, choice.size);
    if (f0 != f1)
        cost += cost_of_pair(c, choice.foot, leg0, leg1) + cost_of_places(c, choice.foot, above, choice.size);
    else
        cost += 2 * k_no_feet_cost;
    cost += squared((head0 - head1) / choice.size / k_pair_fork_spread);
    cost += ratio(choice.arm, choice.leg, k_arm_curve / k_leg_curve, k_arm_ratio_spread);
    cost += ratio(trunk, choice.leg, k_trunk_curve_length / k_leg_curve, k_trunk_ratio_spread);
    const double usual_head = k_head_curve_length / k_leg_curve;
    cost += choice.head < 0 ? k_no_head_cost
                            : ratio(head, choice.leg, usual_head,
                                    head < usual_head * choice.leg ? k_small_head_spread : k_head_ratio_spread)
            + cost_of_neck(c, choice);
    const double arms_thick = c.thickness[h0] + c.thickness[h1], legs_thick = c.thickness[f0] + c.thickness[f1];
    cost += choice.covered
        ? 2 * k_covered_cost
        : squared(std::log(std::max(arms_thick, k_no_length) / std::max(legs_thick, k_no_length) / k_arm_thickness)
                  / k_thickness_spread);
    double lowest = feet.y();
    for (const Vec3& place : c.places)
        lowest = std::min(lowest, place.y());
    cost += std::min(squared((feet.y() - lowest) / choice.size / k_lowest_spread), k_most_lowest_cost);
    cost += k_lying_cost * (1 - upright);
    if (0.5 * cost < most)  // the rest takes most of the time
        choice.cost = 0.5 * (cost + cost_of_rest(c, choice));
}

Choice best_choice(const Candidates& c)
{
    Choice best;
    const int n = c.count();
    for (int h0 = 0; h0 < n; ++h0)
        for (int h1 = 0; h1 < h0; ++h1)
            for (int f0 = 0; f0 < n; ++f0)
                for (int f1 = 0; f1 <= f0; ++f1) {
                    if (f0 == h0 || f0 == h1 || f1 == h0 || f1 == h1)
                        continue;
                    for (int head = -1; head < n; ++head) {
                        if (head == h0 || head == h1 || head == f0 || head == f1)
                            continue;
                        for (const bool covered : { false, true }) {
                            if (f0 == f1 && !covered)
                                continue;
                            Choice choice { head, { h0, h1 }, { f0, f1 }, covered };
                            rate(c, best.cost, choice);
                            if (choice.cost < best.cost)
                                best = choice;
                        }
                    }
                }
    return best;
}

Figure figure_of(const CurveTree& tree, const Candidates& c, const Choice& choice, const CurveSkeleton& skeleton)
{
    const auto node = [&](int row) { return row < 0 ? -1 : c.nodes[row]; };
    Figure figure;
    figure.graph = graph_of(
        tree,
        { node(choice.head), node(choice.hand[0]), node(choice.hand[1]), node(choice.foot[0]), node(choice.foot[1]) },
        skeleton);
    figure.graph.has_covered_legs = choice.covered;
    figure.arm_size = choice.arm / k_arm_curve;
    figure.leg_size = choice.leg / k_leg_curve;
    figure.graph.size = figure.graph.size_by_legs
        = choice.size / (k_leg_curve + k_trunk_curve_length + k_head_curve_length);
    figure.cost = choice.cost;
    return figure;
}

}  // namespace

Figure figure_graph(const CurveSkeleton& skeleton, const TriangleMesh& proxy)
{
    const std::vector<double> radii = radii_of_nodes(skeleton, proxy);
    std::optional<Figure> best;
    std::size_t most_ends = 0;
    for (const CurveSkeleton& way : open_loops(skeleton)) {
        CurveTree tree(way);
        prune_to_few(tree, diagonal(proxy.positions));
        const Candidates c = candidates_of(tree, way, radii);
        most_ends = std::max(most_ends, c.nodes.size());
        if (c.nodes.size() < k_fewest_ends)
            continue;
        const Choice choice = best_choice(c);
        if (choice.cost < k_most_figure_cost && (!best || choice.cost < best->cost))
            try {
                best = figure_of(tree, c, choice, skeleton);
            } catch (const InvalidInput&) {
                // arms that do not leave the spine: another way of opening the loops may be right
            }
    }
    if (!best)
        throw InvalidInput(ErrorCode::not_human,
                           "body: " + std::to_string(most_ends)
                               + " ends found, among them no two arms and two legs; give one figure whose limbs do not"
                                 " merge, or give joints");
    return *std::move(best);
}

}  // namespace garmentfit
