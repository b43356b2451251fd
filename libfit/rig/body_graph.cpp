// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_graph.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include "curve_loops.h"
#include "garmentfit/error.h"

namespace garmentfit {
namespace {

constexpr int k_ends = 5;  // one less where the head is missing
constexpr int k_parts = 3;

enum Part : int { head_end, hand_end, foot_end };

// Lengths along the curves between the ends, as shares of stature, in the order of Part: segment lengths of
// [deleva_1996_segments], to the middle of the fingers and toes, where the curves end.
constexpr double k_between[k_parts][k_parts] = { { 0, 0.61, 1.05 }, { 0.61, 0.90, 1.31 }, { 1.05, 1.31, 1.215 } };

// The curves of real bodies leave some 0.1 of spread (a child's large head most of all); a shape with another plan leaves far more.
constexpr double k_largest_spread = 0.30;
constexpr double k_largest_headless_spread = 0.15;  // fewer lengths to agree: they must do so better

// A limb is at least this much longer than the longest finger, ear or toe that was pruned.
constexpr double k_limb_over_finger = 1.25;
constexpr double k_limb_over_stump = 2.5;  // without a head, what was pruned is a neck or a finger, nothing longer

std::string text(double value)
{
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.2f", value);
    return buffer;
}

/// A graph that loses its branches.
class Tree {
public:
    explicit Tree(const CurveSkeleton& skeleton) : nodes_(skeleton.nodes), neighbours_(skeleton.nodes.size())
    {
        for (const auto& [a, b] : skeleton.edges) {
            neighbours_[a].push_back(b);
            neighbours_[b].push_back(a);
        }
    }

    std::vector<int> leaves() const
    {
        std::vector<int> result;
        for (int n = 0; n < int(nodes_.size()); ++n)
            if (neighbours_[n].size() == 1)
                result.push_back(n);
        return result;
    }

    /// From a leaf to the next fork, the fork included; to the other leaf where there is no fork.
    std::vector<int> branch(int leaf) const
    {
        std::vector<int> nodes { leaf };
        for (int before = -1, n = leaf;;) {
            const auto next
                = std::find_if(neighbours_[n].begin(), neighbours_[n].end(), [&](int m) { return m != before; });
            if (next == neighbours_[n].end())
                return nodes;
            before = n;
            n = *next;
            nodes.push_back(n);
            if (neighbours_[n].size() != 2)
                return nodes;
        }
    }

    double length(const std::vector<int>& path) const
    {
        double sum = 0;
        for (std::size_t i = 1; i < path.size(); ++i)
            sum += (nodes_[path[i]] - nodes_[path[i - 1]]).norm();
        return sum;
    }

    void remove(const std::vector<int>& branch)
    {
        for (std::size_t i = 0; i + 1 < branch.size(); ++i)
            neighbours_[branch[i]].clear();
        auto& fork = neighbours_[branch.back()];
        fork.erase(std::find(fork.begin(), fork.end(), branch[branch.size() - 2]));
    }

    /// @pre both are still there
    std::vector<int> path(int from, int to) const
    {
        std::vector<int> before(nodes_.size(), -1), front { to };
        before[to] = to;
        for (std::size_t i = 0; i < front.size() && before[from] < 0; ++i)
            for (const int n : neighbours_[front[i]])
                if (before[n] < 0) {
                    before[n] = front[i];
                    front.push_back(n);
                }
        std::vector<int> result { from };
        while (result.back() != to)
            result.push_back(before[result.back()]);
        return result;
    }

private:
    std::vector<Vec3> nodes_;
    std::vector<std::vector<int>> neighbours_;
};

/// Fingers, toes, ears and nose are the shortest branches: they go until as many as wanted are left.
std::vector<int> prune_to_ends(Tree& tree, std::size_t ends)
{
    std::vector<int> leaves = tree.leaves();
    if (leaves.size() < ends)
        throw InvalidInput("body: " + std::to_string(leaves.size())
                           + " ends found, a human has 5 (head, hands, feet); give one whole human body");
    double longest_pruned = 0;
    const auto shorter = [&](int a, int b) { return tree.length(tree.branch(a)) < tree.length(tree.branch(b)); };
    for (; leaves.size() > ends; leaves = tree.leaves()) {
        const std::vector<int> branch = tree.branch(*std::min_element(leaves.begin(), leaves.end(), shorter));
        longest_pruned = std::max(longest_pruned, tree.length(branch));
        tree.remove(branch);
    }
    const double shortest = tree.length(tree.branch(*std::min_element(leaves.begin(), leaves.end(), shorter)));
    if (shortest < (ends == k_ends ? k_limb_over_finger : k_limb_over_stump) * longest_pruned)
        throw InvalidInput("body: more than 5 ends found, the sixth is " + text(longest_pruned)
                           + " m long and the fifth " + text(shortest)
                           + " m; give one human body without things attached to it");
    return leaves;
}

/// (head,) hand, hand, foot, foot, and how far the lengths between them are from a human's.
struct Labels {
    std::vector<int> ends;
    double spread = std::numeric_limits<double>::max();
    double size = 0;

    bool headless() const { return ends.size() < k_ends; }
};

Labels judged(const std::vector<int>& order, const Eigen::MatrixXd& lengths)
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

Labels best_labels(const Tree& tree, const std::vector<int>& leaves)
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
            continue;  // sides come later
        const Labels labels = judged(order, lengths);
        if (labels.spread < best.spread)
            best = labels;
    } while (std::next_permutation(order.begin(), order.end()));
    const double most = best.headless() ? k_largest_headless_spread : k_largest_spread;
    if (best.spread > most)
        throw InvalidInput("body: the lengths between its ends differ from a human's by a spread of "
                           + text(best.spread) + " (at most " + text(most)
                           + "); give a human body, or check that limbs are not fused");
    for (int& end : best.ends)
        end = leaves[end];
    return best;
}

/// A curve skeleton without loops, as much of it as leads to an end with a name.
struct NamedTree {
    Tree tree;
    Labels labels;
};

/// Of all ways to open the loops, the one that leaves a tree most like a human. @throws InvalidInput of the first way.
NamedTree most_human(const std::vector<CurveSkeleton>& ways, std::size_t ends)
{
    std::optional<NamedTree> best;
    std::optional<InvalidInput> refusal;
    for (const CurveSkeleton& way : ways)
        try {
            Tree tree(way);
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

/// With its head or, where that finds none, without: a neck is no longer than a finger.
NamedTree named_tree(const std::vector<CurveSkeleton>& ways)
{
    try {
        return most_human(ways, k_ends);
    } catch (const InvalidInput&) {
        try {
            return most_human(ways, k_ends - 1);
        } catch (const InvalidInput&) {
            // the reason with a head is the one to tell
        }
        throw;
    }
}

/// The part of `path` after its last node on `trunk`, that node included.
std::vector<int> beyond(const std::vector<int>& trunk, const std::vector<int>& path)
{
    std::size_t first = 0;
    for (std::size_t i = 0; i < path.size(); ++i)
        if (std::find(trunk.begin(), trunk.end(), path[i]) != trunk.end())
            first = i;
    return { path.begin() + first, path.end() };
}

/// Stature by the distances between head and feet alone: an arm cut off the hip that it was fused to is bent out of length.
double size_by_legs(const Tree& tree, int head, int foot0, int foot1)
{
    const auto distance = [&](int a, int b) { return tree.length(tree.path(a, b)); };
    return std::cbrt(distance(head, foot0) * distance(head, foot1) * distance(foot0, foot1)
                     / (k_between[head_end][foot_end] * k_between[head_end][foot_end] * k_between[foot_end][foot_end]));
}

/// Every node takes the place of the nearest node, along the whole graph, that lies on a curve.
std::vector<BodyGraph::Place> places(const BodyGraph& graph, const CurveSkeleton& skeleton)
{
    std::vector<BodyGraph::Place> places(skeleton.nodes.size());
    std::vector<int> front;
    for (const int c : { 5, 4, 0, 1, 2, 3 })  // where curves meet, the trunk's place counts
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

BodyGraph body_graph(const CurveSkeleton& skeleton)
{
    const auto [tree, labels] = named_tree(open_loops(skeleton));
    const int* end = labels.ends.data() + labels.ends.size() - 4;
    const int hand0 = end[0], hand1 = end[1], foot0 = end[2], foot1 = end[3];

    BodyGraph graph;
    graph.size = labels.size;
    graph.headless = labels.headless();
    graph.size_by_legs = graph.headless ? graph.size : size_by_legs(tree, labels.ends[0], foot0, foot1);
    const int top = graph.headless ? beyond(tree.path(foot0, hand0), tree.path(foot0, hand1)).front() : labels.ends[0];
    graph.legs[0] = beyond(tree.path(top, foot1), tree.path(top, foot0));
    graph.legs[1] = beyond(tree.path(top, foot0), tree.path(top, foot1));
    const std::vector<int> spine = tree.path(graph.legs[0].front(), top);
    graph.arms[0] = beyond(spine, tree.path(foot0, hand0));
    graph.arms[1] = beyond(spine, tree.path(foot0, hand1));
    const auto leaves_at = [&](int i) { return std::find(spine.begin(), spine.end(), graph.arms[i].front()); };
    const auto fork = std::max(leaves_at(0), leaves_at(1));
    if (fork == spine.end())
        throw InvalidInput(
            "body: its arms do not leave the line from hips to head; give a human body whose limbs are not fused");
    graph.trunk.assign(spine.begin(), fork + 1);
    graph.head.assign(fork, spine.end());
    graph.place_of_node = places(graph, skeleton);
    return graph;
}

}  // namespace garmentfit
