// SPDX-License-Identifier: GPL-3.0-or-later
#include "topology.h"

#include <numeric>
#include <tuple>

#include "buckets.h"

namespace garmentfit {
namespace {

/// A side with its vertices in rising order.
struct SortedSide {
    int high, side;
    bool operator<(const SortedSide& other) const { return std::tie(high, side) < std::tie(other.high, other.side); }
};

}  // namespace

MeshTopology::MeshTopology(const Triangles& triangles, int vertices) : triangles_(triangles)
{
    collect_edges(vertices);
    collect_neighbours(vertices);
}

// Sides are put into buckets by their lower vertex, then sorted within each bucket, which holds a handful.
void MeshTopology::collect_edges(int vertices)
{
    const int sides = int(triangles_.size());
    std::vector<int> low(static_cast<std::size_t>(sides));
    for (int s = 0; s < sides; ++s)
        low[s] = std::min(from(s), to(s));
    const Buckets sides_at_low(vertices, low);

    edge_of_side_.assign(low.size(), -1);
    sides_.reserve(low.size());
    first_edge_.reserve(std::size_t(vertices) + 1);
    std::vector<int> ends;  // i, j, i, j, ...
    ends.reserve(low.size());
    std::vector<SortedSide> bucket;
    for (int v = 0; v < vertices; ++v) {
        first_edge_.push_back(int(first_side_.size()));
        bucket.clear();
        for (const int s : sides_at_low[v])
            if (const int high = std::max(from(s), to(s)); high != v)
                bucket.push_back({ high, s });
        std::sort(bucket.begin(), bucket.end());
        for (std::size_t i = 0; i < bucket.size(); ++i) {
            if (i == 0 || bucket[i].high != bucket[i - 1].high) {
                first_side_.push_back(int(sides_.size()));
                ends.insert(ends.end(), { v, bucket[i].high });
            }
            edge_of_side_[bucket[i].side] = int(first_side_.size()) - 1;
            sides_.push_back(bucket[i].side);
        }
    }
    first_edge_.push_back(int(first_side_.size()));
    first_side_.push_back(int(sides_.size()));
    edges_ = Eigen::Map<const Edges>(ends.data(), Eigen::Index(ends.size() / 2), 2);
}

// Edges are sorted, so the neighbours of a vertex come in rising order: those below it, then those above.
void MeshTopology::collect_neighbours(int vertices)
{
    first_neighbour_.assign(std::size_t(vertices) + 1, 0);
    for (const int v : edges_.reshaped())
        ++first_neighbour_[std::size_t(v) + 1];
    std::partial_sum(first_neighbour_.begin(), first_neighbour_.end(), first_neighbour_.begin());
    neighbours_.resize(std::size_t(edges_.size()));
    std::vector<int> next(first_neighbour_.begin(), first_neighbour_.end() - 1);
    for (const auto& edge : edges_.rowwise()) {
        neighbours_[next[edge[0]]++] = edge[1];
        neighbours_[next[edge[1]]++] = edge[0];
    }
}

int MeshTopology::edge_between(int a, int b) const
{
    const auto [low, high] = std::minmax(a, b);
    for (int e = first_edge_[low]; e < first_edge_[low + 1]; ++e)
        if (edges_(e, 1) == high)
            return e;
    return -1;
}

int MeshTopology::opposite(int side) const
{
    const int edge = edge_of_side_[side];
    if (edge < 0)
        return -1;
    const auto sides = sides_at(edge);
    return sides.size() != 2 ? -1 : sides[0] == side ? sides[1] : sides[0];
}

std::vector<int> MeshTopology::border_edges() const
{
    std::vector<int> result;
    for (int e = 0; e < int(edges_.rows()); ++e)
        if (is_border(e))
            result.push_back(e);
    return result;
}

std::vector<std::vector<int>> MeshTopology::border_loops() const
{
    const std::vector<int> border = border_edges();
    std::vector<int> start(border.size());
    for (std::size_t i = 0; i < border.size(); ++i)
        start[i] = from(sides_at(border[i])[0]);
    const Buckets leaving(int(first_neighbour_.size()) - 1, start);
    std::vector<char> is_passed(border.size(), 0);
    std::vector<std::vector<int>> loops;
    for (std::size_t first = 0; first < border.size(); ++first) {
        if (is_passed[first])
            continue;
        std::vector<int>& loop = loops.emplace_back();
        for (int at = int(first); at >= 0;) {
            is_passed[at] = 1;
            const int side = sides_at(border[at])[0];
            loop.push_back(from(side));
            const auto onwards = leaving[to(side)];
            const auto next = std::find_if(onwards.begin(), onwards.end(), [&](int i) { return !is_passed[i]; });
            at = next == onwards.end() ? -1 : *next;
        }
    }
    return loops;
}

double mean_edge_length(const Positions& positions, const Edges& edges)
{
    double sum = 0;
    for (const auto& edge : edges.rowwise())
        sum += (positions.row(edge[0]) - positions.row(edge[1])).norm();
    return sum / double(std::max<Eigen::Index>(1, edges.rows()));
}

Eigen::VectorXd edge_counts(const Edges& edges, Eigen::Index vertices)
{
    Eigen::VectorXd counts = Eigen::VectorXd::Zero(vertices);
    for (const int v : edges.reshaped())
        counts[v] += 1;
    return counts;
}

}  // namespace garmentfit
