// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve_loops.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

#include "tuning.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

constexpr std::size_t k_most_ways = 300;  // unit: limits the time for surfaces with many handles

using Edge = std::array<int, 2>;
using Neighbours = std::vector<std::vector<int>>;

Neighbours neighbours_of(const CurveSkeleton& skeleton)
{
    Neighbours neighbours(skeleton.nodes.size());
    for (const auto& [a, b] : skeleton.edges) {
        neighbours[a].push_back(b);
        neighbours[b].push_back(a);
    }
    return neighbours;
}

double length(const CurveSkeleton& skeleton, const std::vector<int>& loop)
{
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        sum += (skeleton.nodes[loop[i]] - skeleton.nodes[loop[(i + 1) % loop.size()]]).norm();
    return sum;
}

/// The nodes of the loop with the fewest edges through an edge; empty if the edge is on no loop.
std::vector<int> loop_through(const Neighbours& neighbours, const Edge& edge)
{
    std::vector<int> before(neighbours.size(), -1), front { edge[0] };
    before[edge[0]] = edge[0];
    for (std::size_t i = 0; i < front.size() && before[edge[1]] < 0; ++i)
        for (const int n : neighbours[front[i]])
            if (before[n] < 0 && !(front[i] == edge[0] && n == edge[1])) {
                before[n] = front[i];
                front.push_back(n);
            }
    std::vector<int> loop;
    if (before[edge[1]] >= 0)
        for (loop.push_back(edge[1]); loop.back() != edge[0];)
            loop.push_back(before[loop.back()]);
    return loop;
}

/// Without the branches that end: what is left lies on loops or between them.
Neighbours without_ends(Neighbours neighbours)
{
    std::vector<int> ends;
    const auto note_end = [&](int n) {
        if (neighbours[n].size() == 1)
            ends.push_back(n);
    };
    for (int n = 0; n < int(neighbours.size()); ++n)
        note_end(n);
    while (!ends.empty()) {
        const int end = ends.back();
        ends.pop_back();
        for (const int n : neighbours[end]) {
            neighbours[n].erase(std::find(neighbours[n].begin(), neighbours[n].end(), end));
            note_end(n);
        }
        neighbours[end].clear();
    }
    return neighbours;
}

std::vector<int> shortest_loop(const CurveSkeleton& skeleton, const Neighbours& neighbours)
{
    const Neighbours inner = without_ends(neighbours);
    std::vector<int> shortest;
    double least = std::numeric_limits<double>::max();
    for (const Edge& edge : skeleton.edges) {
        if (inner[edge[0]].empty() || inner[edge[1]].empty())
            continue;
        if (const std::vector<int> loop = loop_through(inner, edge); !loop.empty())
            if (const double l = length(skeleton, loop); l < least) {
                least = l;
                shortest = loop;
            }
    }
    return shortest;
}

Edge edge_at(const std::vector<int>& loop, std::size_t i)
{
    return { loop[i % loop.size()], loop[(i + 1) % loop.size()] };
}

/// The edges of a loop beside its forks, and halfway between forks.
std::vector<Edge> places_to_cut(const std::vector<int>& loop, const Neighbours& neighbours)
{
    std::vector<std::size_t> forks;
    for (std::size_t i = 0; i < loop.size(); ++i)
        if (neighbours[loop[i]].size() > 2)
            forks.push_back(i);
    if (forks.empty())
        forks.push_back(0);
    std::vector<Edge> places;
    for (std::size_t f = 0; f < forks.size(); ++f) {
        const std::size_t from = forks[f], to = f + 1 < forks.size() ? forks[f + 1] : forks[0] + loop.size();
        for (const std::size_t i : { from, (from + to - 1) / 2, to - 1 })
            if (places.empty() || places.back() != edge_at(loop, i))
                places.push_back(edge_at(loop, i));
    }
    return places;
}

/// The edge of a loop farthest from the middle of the body, so that the two remaining ends point outwards.
Edge outermost(const CurveSkeleton& skeleton, const std::vector<int>& loop, const Vec3& middle)
{
    const auto distance = [&](std::size_t i) {
        const Edge e = edge_at(loop, i);
        return (0.5 * (skeleton.nodes[e[0]] + skeleton.nodes[e[1]]) - middle).norm();
    };
    std::size_t best = 0;
    for (std::size_t i = 1; i < loop.size(); ++i)
        if (distance(i) > distance(best))
            best = i;
    return edge_at(loop, best);
}

CurveSkeleton remove_edge(CurveSkeleton skeleton, const Edge& edge)
{
    const Edge reversed { edge[1], edge[0] };
    auto& edges = skeleton.edges;
    edges.erase(std::find_if(edges.begin(), edges.end(), [&](const Edge& e) { return e == edge || e == reversed; }));
    return skeleton;
}

void cut_loops(CurveSkeleton skeleton, const Eigen::AlignedBox3d& box, std::vector<CurveSkeleton>& ways)
{
    for (;;) {
        const Neighbours neighbours = neighbours_of(skeleton);
        const std::vector<int> loop = shortest_loop(skeleton, neighbours);
        if (loop.empty()) {
            ways.push_back(std::move(skeleton));
            return;
        }
        if (length(skeleton, loop) > k_short_loop * box.diagonal().norm()) {
            for (const Edge& place : places_to_cut(loop, neighbours))
                if (ways.size() < k_most_ways)
                    cut_loops(remove_edge(skeleton, place), box, ways);
            return;
        }
        const Edge place = outermost(skeleton, loop, box.center());
        skeleton = remove_edge(std::move(skeleton), place);
    }
}

}  // namespace

std::vector<CurveSkeleton> open_loops(const CurveSkeleton& skeleton)
{
    Eigen::AlignedBox3d box;
    for (const Vec3& node : skeleton.nodes)
        box.extend(node);
    std::vector<CurveSkeleton> ways;
    cut_loops(skeleton, box, ways);
    return ways;
}

}  // namespace garmentfit
