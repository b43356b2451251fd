// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_graph.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "fit/error.h"

namespace fit {
namespace {

constexpr int k_ends = 5;
constexpr int k_parts = 3;

enum Part : int { head_end, hand_end, foot_end };

// Lengths along the curves between the ends, as shares of stature, in the order of Part: segment lengths of
// [deleva_1996_segments], to the middle of the fingers and toes, where the curves end.
constexpr double k_between[k_parts][k_parts] = { { 0, 0.62, 1.07 }, { 0.62, 0.92, 1.34 }, { 1.07, 1.34, 1.24 } };

// The curves of real bodies leave some 0.1 of spread (a child's large head most of all); a shape with another plan leaves far more.
constexpr double k_largest_spread = 0.30;

// A limb is at least this much longer than the longest finger, ear or toe that was pruned.
constexpr double k_limb_over_finger = 1.25;

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
            const auto next = std::find_if(neighbours_[n].begin(), neighbours_[n].end(), [&](int m) { return m != before; });
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
    const std::vector<Vec3>& nodes_;
    std::vector<std::vector<int>> neighbours_;
};

/// Fingers, toes, ears and nose are the shortest branches: they go until five are left.
std::vector<int> prune_to_ends(Tree& tree)
{
    std::vector<int> leaves = tree.leaves();
    if (leaves.size() < k_ends)
        throw InvalidInput("body: " + std::to_string(leaves.size())
                           + " ends found, a human has 5 (head, hands, feet); give one whole human body");
    double longest_pruned = 0;
    const auto shorter = [&](int a, int b) { return tree.length(tree.branch(a)) < tree.length(tree.branch(b)); };
    for (; leaves.size() > k_ends; leaves = tree.leaves()) {
        const std::vector<int> branch = tree.branch(*std::min_element(leaves.begin(), leaves.end(), shorter));
        longest_pruned = std::max(longest_pruned, tree.length(branch));
        tree.remove(branch);
    }
    const double shortest = tree.length(tree.branch(*std::min_element(leaves.begin(), leaves.end(), shorter)));
    if (shortest < k_limb_over_finger * longest_pruned)
        throw InvalidInput("body: more than 5 ends found, the sixth is " + text(longest_pruned) + " m long and the fifth "
                           + text(shortest) + " m; give one human body without things attached to it");
    return leaves;
}

/// head, hand, hand, foot, foot, and how far the lengths between them are from a human's.
struct Labels {
    std::array<int, k_ends> ends;
    double spread = std::numeric_limits<double>::max();
    double size = 0;
};

Labels judged(const std::array<int, k_ends>& order, const Eigen::Matrix<double, k_ends, k_ends>& lengths)
{
    constexpr std::array<Part, k_ends> parts { head_end, hand_end, hand_end, foot_end, foot_end };
    std::vector<double> logs;
    for (int i = 0; i < k_ends; ++i)
        for (int j = 0; j < i; ++j)
            logs.push_back(std::log(lengths(order[i], order[j]) / k_between[parts[i]][parts[j]]));
    double mean = 0, squares = 0;
    for (const double l : logs)
        mean += l / double(logs.size());
    for (const double l : logs)
        squares += (l - mean) * (l - mean) / double(logs.size());
    return { order, std::sqrt(squares), std::exp(mean) };
}

Labels best_labels(const Tree& tree, const std::vector<int>& leaves)
{
    Eigen::Matrix<double, k_ends, k_ends> lengths;
    for (int i = 0; i < k_ends; ++i)
        for (int j = 0; j < k_ends; ++j)
            lengths(i, j) = i == j ? 0 : tree.length(tree.path(leaves[i], leaves[j]));
    Labels best;
    std::array<int, k_ends> order { 0, 1, 2, 3, 4 };
    do {
        if (order[1] > order[2] || order[3] > order[4])
            continue;  // sides come later
        const Labels labels = judged(order, lengths);
        if (labels.spread < best.spread)
            best = labels;
    } while (std::next_permutation(order.begin(), order.end()));
    if (best.spread > k_largest_spread)
        throw InvalidInput("body: the lengths between its five ends differ from a human's by a spread of " + text(best.spread)
                           + " (at most " + text(k_largest_spread) + "); give a human body, or check that limbs are not fused");
    for (int& end : best.ends)
        end = leaves[end];
    return best;
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
    Tree tree(skeleton);
    const Labels labels = best_labels(tree, prune_to_ends(tree));
    const auto [head, hand0, hand1, foot0, foot1] = labels.ends;

    BodyGraph graph;
    graph.size = labels.size;
    graph.legs[0] = beyond(tree.path(head, foot1), tree.path(head, foot0));
    graph.legs[1] = beyond(tree.path(head, foot0), tree.path(head, foot1));
    const std::vector<int> spine = tree.path(graph.legs[0].front(), head);
    graph.arms[0] = beyond(spine, tree.path(foot0, hand0));
    graph.arms[1] = beyond(spine, tree.path(foot0, hand1));
    const auto leaves_at = [&](int i) { return std::find(spine.begin(), spine.end(), graph.arms[i].front()); };
    const auto fork = std::max(leaves_at(0), leaves_at(1));
    graph.trunk.assign(spine.begin(), fork + 1);
    graph.head.assign(fork, spine.end());
    graph.place_of_node = places(graph, skeleton);
    return graph;
}

}  // namespace fit
