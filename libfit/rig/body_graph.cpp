// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include "curve_loops.h"
#include "curve_tree.h"
#include "garmentfit/error.h"
#include "garmentfit/number_text.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

constexpr int k_ends = 5;  // derived: head, hands and feet; one less without head
constexpr int k_parts = 3;  // derived: values of Part

enum Part : int { head_end, hand_end, foot_end };

// literature: [deleva_1996_segments], sums of segment lengths to the middle of fingers and toes, where the curves end.
// Lengths along the curves between the ends as shares of stature, rows and columns as Part.
constexpr double k_between[k_parts][k_parts] = { { 0, 0.61, 1.05 }, { 0.61, 0.90, 1.31 }, { 1.05, 1.31, 1.215 } };

/// Removes the shortest branches (fingers, toes, ears, nose) until `ends` leaves remain.
std::vector<int> prune_to_ends(CurveTree& tree, std::size_t ends)
{
    std::vector<int> leaves = tree.leaves();
    if (leaves.size() < ends)
        throw InvalidInput(
            ErrorCode::not_human,
            "body: " + std::to_string(leaves.size())
                + " ends found, a human has 5 (head, hands, feet); give one whole human body whose limbs do not"
                  " merge");
    double longest_pruned = 0;
    const auto shorter = [&](int a, int b) { return tree.length(tree.branch(a)) < tree.length(tree.branch(b)); };
    for (; leaves.size() > ends; leaves = tree.leaves()) {
        const std::vector<int> branch = tree.branch(*std::min_element(leaves.begin(), leaves.end(), shorter));
        longest_pruned = std::max(longest_pruned, tree.length(branch));
        tree.remove(branch);
    }
    const double shortest = tree.length(tree.branch(*std::min_element(leaves.begin(), leaves.end(), shorter)));
    if (shortest < (ends == k_ends ? k_limb_over_finger : k_limb_over_stump) * longest_pruned)
        throw InvalidInput(ErrorCode::not_human,
                           "body: more than " + std::to_string(ends) + " ends found, the next one is "
                               + fixed_text(longest_pruned, 2) + " m long and the shortest of the others "
                               + fixed_text(shortest, 2)
                               + " m; give one human body without tail, wings or things in its hands");
    return leaves;
}

/// (head,) hand, hand, foot, foot, and how well the lengths between them agree with a human's.
struct Labels {
    std::vector<int> ends;
    double spread = std::numeric_limits<double>::max();  ///< standard deviation of the logarithms of length ratios
    double size = 0;  ///< m, stature by the mean of the logarithms

    bool headless() const { return ends.size() < k_ends; }
};

Labels score_labels(const std::vector<int>& order, const Eigen::MatrixXd& lengths)
{
    constexpr std::array<Part, k_ends> parts { head_end, hand_end, hand_end, foot_end, foot_end };
    const std::size_t missing = k_ends - order.size();
    std::vector<double> logs;
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            logs.push_back(std::log(lengths(order[i], order[j]) / k_between[parts[i + missing]][parts[j + missing]]));
    double mean = 0, squares = 0;
    for (const double l : logs)
        mean += l / double(logs.size());
    for (const double l : logs)
        squares += (l - mean) * (l - mean) / double(logs.size());
    return { order, std::sqrt(squares), std::exp(mean) };
}

/// The permutation of leaves with the smallest spread.
Labels best_labels(const CurveTree& tree, const std::vector<int>& leaves)
{
    const int n = int(leaves.size());
    Eigen::MatrixXd lengths(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            lengths(i, j) = i == j ? 0 : tree.length(tree.path(leaves[i], leaves[j]));
    Labels best;
    std::vector<int> order(leaves.size());
    std::iota(order.begin(), order.end(), 0);
    do {
        if (order[n - 4] > order[n - 3] || order[n - 2] > order[n - 1])
            continue;  // left and right are classified later
        const Labels labels = score_labels(order, lengths);
        if (labels.spread < best.spread)
            best = labels;
    } while (std::next_permutation(order.begin(), order.end()));
    const double most = best.headless() ? k_largest_headless_spread : k_largest_spread;
    if (best.spread > most)
        throw InvalidInput(ErrorCode::not_human,
                           "body: the lengths between head, hands and feet differ from a human's by a spread of "
                               + fixed_text(best.spread, 2) + " (at most " + fixed_text(most, 2)
                               + "); give a human body whose limbs do not merge, or give joints");
    for (int& end : best.ends)
        end = leaves[end];
    return best;
}

/// A curve skeleton without loops, pruned to the branches whose ends have names.
struct NamedTree {
    CurveTree tree;
    Labels labels;
};

/// Of all ways to open the loops, the one whose tree agrees best with a human's lengths. @throws InvalidInput of the
/// first way.
NamedTree best_tree(const std::vector<CurveSkeleton>& ways, std::size_t ends)
{
    std::optional<NamedTree> best;
    std::optional<InvalidInput> refusal;
    for (const CurveSkeleton& way : ways)
        try {
            CurveTree tree(way);
            const std::vector<int> leaves = prune_to_ends(tree, ends);
            const Labels labels = best_labels(tree, leaves);
            if (!best || labels.spread < best->labels.spread)
                best = { std::move(tree), labels };
        } catch (const InvalidInput& reason) {
            if (!refusal)
                refusal = reason;
        }
    if (!best)
        throw *refusal;
    return *std::move(best);
}

/// Names a tree with a head or, if that fails, without. A neck without head is not longer than a finger.
NamedTree name_tree(const std::vector<CurveSkeleton>& ways)
{
    try {
        return best_tree(ways, k_ends);
    } catch (const InvalidInput&) {
        try {
            return best_tree(ways, k_ends - 1);
        } catch (const InvalidInput&) {
            // the error of the attempt with a head is reported
        }
        throw;
    }
}

/// The part of `path` from its last node on `trunk`, that node included.
std::vector<int> beyond(const std::vector<int>& trunk, const std::vector<int>& path)
{
    std::size_t first = 0;
    for (std::size_t i = 0; i < path.size(); ++i)
        if (std::find(trunk.begin(), trunk.end(), path[i]) != trunk.end())
            first = i;
    return { path.begin() + first, path.end() };
}

/// Stature from the distances between head and feet only: an arm that was cut off a hip has a wrong length.
double size_by_legs(const CurveTree& tree, int head, int foot0, int foot1)
{
    const auto distance = [&](int a, int b) { return tree.length(tree.path(a, b)); };
    return std::cbrt(distance(head, foot0) * distance(head, foot1) * distance(foot0, foot1)
                     / (k_between[head_end][foot_end] * k_between[head_end][foot_end] * k_between[foot_end][foot_end]));
}

/// Each node gets the place of the nearest node on a curve, by the number of edges of the whole graph.
std::vector<BodyGraph::Place> assign_places(const BodyGraph& graph, const CurveSkeleton& skeleton)
{
    std::vector<BodyGraph::Place> places(skeleton.nodes.size());
    std::vector<int> front;
    for (const int c : { k_trunk_curve, k_head_curve, 0, 1, 2, 3 })  // where curves meet, the trunk has priority
        for (int row = 0; row < int(graph.curve(c).size()); ++row)
            if (const int node = graph.curve(c)[row]; places[node].curve < 0) {
                places[node] = { c, row };
                front.push_back(node);
            }
    std::vector<std::vector<int>> neighbours(skeleton.nodes.size());
    for (const auto& [a, b] : skeleton.edges) {
        neighbours[a].push_back(b);
        neighbours[b].push_back(a);
    }
    for (std::size_t i = 0; i < front.size(); ++i)
        for (const int n : neighbours[front[i]])
            if (places[n].curve < 0) {
                places[n] = places[front[i]];
                front.push_back(n);
            }
    return places;
}

}  // namespace

BodyGraph graph_of(const CurveTree& tree, const Ends& ends, const CurveSkeleton& skeleton)
{
    const auto [head, hand0, hand1, foot0, foot1] = ends;
    BodyGraph graph;
    graph.headless = head < 0;
    const int top = graph.headless ? beyond(tree.path(foot0, hand0), tree.path(foot0, hand1)).front() : head;
    graph.legs[0] = beyond(tree.path(top, foot1), tree.path(top, foot0));
    graph.legs[1] = beyond(tree.path(top, foot0), tree.path(top, foot1));
    const std::vector<int> spine = tree.path(graph.legs[0].front(), top);
    graph.arms[0] = beyond(spine, tree.path(foot0, hand0));
    graph.arms[1] = beyond(spine, tree.path(foot0, hand1));
    const auto leaves_at = [&](int i) { return std::find(spine.begin(), spine.end(), graph.arms[i].front()); };
    const auto fork = std::max(leaves_at(0), leaves_at(1));
    if (fork == spine.end())
        throw InvalidInput(
            ErrorCode::not_human,
            "body: the arms do not branch off between hips and head; give a human body whose limbs do not merge");
    graph.trunk.assign(spine.begin(), fork + 1);
    graph.head.assign(fork, spine.end());
    graph.place_of_node = assign_places(graph, skeleton);
    return graph;
}

BodyGraph body_graph(const CurveSkeleton& skeleton)
{
    const auto [tree, labels] = name_tree(open_loops(skeleton));
    const int* end = labels.ends.data() + labels.ends.size() - 4;
    const Ends ends { labels.headless() ? -1 : labels.ends[0], end[0], end[1], end[2], end[3] };
    BodyGraph graph = graph_of(tree, ends, skeleton);
    graph.size = labels.size;
    graph.spread = labels.spread;
    graph.size_by_legs = graph.headless ? graph.size : size_by_legs(tree, ends.head, ends.foot0, ends.foot1);
    return graph;
}

}  // namespace garmentfit
