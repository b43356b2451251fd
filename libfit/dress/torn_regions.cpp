// SPDX-License-Identifier: GPL-3.0-or-later
#include "torn_regions.h"

#include "edge_distances.h"
#include "parallel.h"
#include "tuning.h"

namespace garmentfit {
namespace {

Vec3 way_between(const Positions& positions, int from, int to)
{
    return (positions.row(to) - positions.row(from)).transpose();
}

/// Cloth in patches round some of its vertices, as a mesh of these.
class PatchedCloth {
public:
    PatchedCloth(const TriangleMesh& cloth, const LedPlaces& led, const MeshTopology& topology) :
        cloth_(cloth), led_(led), patch_of_(cloth.positions.rows())
    {
        EdgeDistances distances(cloth.positions, topology, k_patch);
        std::vector<int> number(patch_of_.size(), -1);
        for (int v = 0; v < int(patch_of_.size()); ++v)
            if (distances.source_of(v) < 0) {
                distances.add({ v });
                number[v] = int(centres_.size());
                centres_.push_back(v);
            }
        for (int v = 0; v < int(patch_of_.size()); ++v)
            patch_of_[v] = number[distances.source_of(v)];
        rest_ = cloth.positions(centres_, Eigen::all);
        topology_ = MeshTopology(cloth.triangles.unaryExpr([&](int v) { return patch_of_[v]; }), int(centres_.size()));
    }

    /// Of each vertex whether it is in a patch that is led apart, of those near some vertices, or led apart from its
    /// patch.
    std::vector<char> find_led_apart(const std::vector<int>& vertices) const
    {
        EdgeDistances distances(rest_, topology_, k_cloth_around);
        distances.add(patches_of(vertices));
        std::vector<char> is_apart(centres_.size()), result(patch_of_.size());
        parallel_for(is_apart.size(), [&](std::size_t patch) {
            is_apart[patch] = distances[int(patch)] < k_cloth_around && is_led_apart(int(patch));
        });
        for (int v = 0; v < int(result.size()); ++v) {
            const int centre = centres_[patch_of_[v]];
            const double distance = way_between(cloth_.positions, centre, v).norm();
            result[v] = is_apart[patch_of_[v]] || goes_elsewhere(v, centre, distance);
        }
        return result;
    }

private:
    std::vector<int> patches_of(std::vector<int> vertices) const
    {
        for (int& v : vertices)
            v = patch_of_[v];
        return vertices;
    }

    /// Whether most of the cloth round a patch would take it elsewhere.
    bool is_led_apart(int patch) const
    {
        EdgeDistances distances(rest_, topology_, k_cloth_around);
        distances.add({ patch });
        int around = 0, elsewhere = 0;
        for (int other = 0; other < int(centres_.size()); ++other)
            if (distances[other] < k_cloth_around) {
                ++around;
                elsewhere += goes_elsewhere(centres_[patch], centres_[other], distances[other]);
            }
        return 2 * elsewhere > around;
    }

    /// Whether a vertex goes far from where another would take it. @param distance  m, between them
    bool goes_elsewhere(int vertex, int other, double distance) const
    {
        const Vec3 at_rest = way_between(cloth_.positions, other, vertex);
        const Vec3 way = way_between(led_.positions, other, vertex);
        return (led_.turns[other] * at_rest - way).norm() > k_led_elsewhere * distance + k_torn_gap;
    }

    const TriangleMesh& cloth_;
    const LedPlaces& led_;
    std::vector<int> centres_, patch_of_;  // vertices; by vertex
    Positions rest_;  // of the centres
    MeshTopology topology_;
};

}  // namespace

bool is_torn(const Positions& rest, const Positions& worn, int a, int b)
{
    return (worn.row(a) - worn.row(b)).norm() > k_torn * (rest.row(a) - rest.row(b)).norm() + k_torn_gap;
}

std::vector<char> find_torn_off(const TriangleMesh& rest, const LedPlaces& led, const MeshTopology& topology)
{
    std::vector<int> torn;
    for (const auto& edge : topology.edges().rowwise())
        if (is_torn(rest.positions, led.positions, edge[0], edge[1]))
            torn.insert(torn.end(), { edge[0], edge[1] });
    if (torn.empty())
        return std::vector<char>(rest.positions.rows(), 0);
    return PatchedCloth(rest, led, topology).find_led_apart(torn);
}

}  // namespace garmentfit
