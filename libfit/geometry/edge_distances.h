// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Distances along the edges of a mesh from some of its vertices, by Dijkstra's algorithm.

#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "topology.h"

namespace garmentfit {

class EdgeDistances {
public:
    /// Positions and topology have to live as long. @param reach  m; farther vertices are at this distance
    EdgeDistances(const Positions& positions, const MeshTopology& topology, double reach) :
        positions_(positions), topology_(topology), distances_(std::size_t(positions.rows()), reach),
        sources_(std::size_t(positions.rows()), -1)
    {
    }

    /// m
    double operator[](int vertex) const { return distances_[std::size_t(vertex)]; }
    /// The source at this distance; -1 beyond the reach.
    int source_of(int vertex) const { return sources_[std::size_t(vertex)]; }

    /// Takes more vertices as sources. O(n log n) for the n vertices that come nearer.
    void add(const std::vector<int>& sources)
    {
        for (const int vertex : sources)
            reach(0, vertex, vertex);
        while (!next_.empty()) {
            const auto [distance, vertex] = next_.top();
            next_.pop();
            if (distance == distances_[std::size_t(vertex)])
                for (const int other : topology_.neighbours(vertex))
                    reach(distance + (positions_.row(vertex) - positions_.row(other)).norm(), other, source_of(vertex));
        }
    }

private:
    void reach(double distance, int vertex, int source)
    {
        if (distance < distances_[std::size_t(vertex)]) {
            distances_[std::size_t(vertex)] = distance;
            sources_[std::size_t(vertex)] = source;
            next_.push({ distance, vertex });
        }
    }

    using Step = std::pair<double, int>;
    const Positions& positions_;
    const MeshTopology& topology_;
    std::vector<double> distances_;
    std::vector<int> sources_;
    std::priority_queue<Step, std::vector<Step>, std::greater<>> next_;
};

}  // namespace garmentfit
