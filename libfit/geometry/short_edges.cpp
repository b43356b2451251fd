// SPDX-License-Identifier: GPL-3.0-or-later
#include "short_edges.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "surface_measures.h"
#include "tuning.h"

namespace garmentfit {
namespace {

class Collapser {
public:
    explicit Collapser(const TriangleMesh& mesh) :
        positions_(mesh.positions), triangles_(mesh.triangles), faces_of_(mesh.positions.rows()),
        left_(int(mesh.positions.rows()))
    {
        for (int f = 0; f < int(triangles_.rows()); ++f)
            for (int k = 0; k < 3; ++k)
                faces_of_[triangles_(f, k)].push_back(f);
    }

    int left() const { return left_; }

    /// Merges every vertex once with its nearest neighbour, where that is nearer than `length`.
    void sweep(double length)
    {
        for (int v = 0; v < int(faces_of_.size()); ++v)
            if (const int u = nearest_neighbour(v); u >= 0)
                if ((at(u) - at(v)).squaredNorm() < length * length && may_join(v, u))
                    join(v, u);
    }

    TriangleMesh result() const
    {
        std::vector<int> row(faces_of_.size(), -1);
        TriangleMesh mesh { Positions(left_, 3), Triangles(triangles_.rows(), 3) };
        int n = 0, m = 0;
        for (std::size_t v = 0; v < faces_of_.size(); ++v)
            if (!faces_of_[v].empty()) {
                mesh.positions.row(n) = positions_.row(Eigen::Index(v));
                row[v] = n++;
            }
        for (Eigen::Index f = 0; f < triangles_.rows(); ++f)
            if (triangles_(f, 0) >= 0)
                mesh.triangles.row(m++) << row[triangles_(f, 0)], row[triangles_(f, 1)], row[triangles_(f, 2)];
        mesh.triangles.conservativeResize(m, 3);
        return mesh;
    }

private:
    Vec3 at(int v) const { return positions_.row(v); }
    bool has(int face, int v) const { return (triangles_.row(face).array() == v).any(); }

    int nearest_neighbour(int v) const
    {
        int nearest = -1;
        for (const int f : faces_of_[v])
            for (int k = 0; k < 3; ++k)
                if (const int u = triangles_(f, k); u != v)
                    if (nearest < 0 || (at(u) - at(v)).squaredNorm() < (at(nearest) - at(v)).squaredNorm())
                        nearest = u;
        return nearest;
    }

    void collect_neighbours(int v, std::vector<int>& neighbours) const
    {
        neighbours.clear();
        for (const int f : faces_of_[v])
            for (int k = 0; k < 3; ++k)
                if (triangles_(f, k) != v)
                    neighbours.push_back(triangles_(f, k));
        std::sort(neighbours.begin(), neighbours.end());
        neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    }

    /// Exactly two common neighbours keep the surface a manifold. More than four neighbours of the merged vertex keep
    /// it from collapsing to a flat pair of faces. No triangle may turn over.
    bool may_join(int v, int u)
    {
        collect_neighbours(v, of_v_);
        collect_neighbours(u, of_u_);
        common_.clear();
        std::set_intersection(of_v_.begin(), of_v_.end(), of_u_.begin(), of_u_.end(), std::back_inserter(common_));
        const Vec3 middle = 0.5 * (at(v) + at(u));
        return common_.size() == 2 && of_v_.size() + of_u_.size() > 8 && keeps_normals(v, u, middle)
            && keeps_normals(u, v, middle);
    }

    bool keeps_normals(int v, int other, const Vec3& to) const
    {
        return std::all_of(faces_of_[v].begin(), faces_of_[v].end(), [&](int f) {
            if (has(f, other))
                return true;
            Vec3 before[3], after[3];
            for (int k = 0; k < 3; ++k) {
                before[k] = at(triangles_(f, k));
                after[k] = triangles_(f, k) == v ? to : before[k];
            }
            return (before[1] - before[0])
                       .cross(before[2] - before[0])
                       .dot((after[1] - after[0]).cross(after[2] - after[0]))
                > 0;
        });
    }

    void join(int v, int u)
    {
        positions_.row(v) = 0.5 * (at(v) + at(u));
        for (const int f : faces_of_[u]) {
            if (has(f, v)) {
                for (int k = 0; k < 3; ++k)
                    if (const int w = triangles_(f, k); w != u)
                        faces_of_[w].erase(std::find(faces_of_[w].begin(), faces_of_[w].end(), f));
                triangles_.row(f).setConstant(-1);
                continue;
            }
            for (int k = 0; k < 3; ++k)
                if (triangles_(f, k) == u)
                    triangles_(f, k) = v;
            faces_of_[v].push_back(f);
        }
        faces_of_[u].clear();
        --left_;
    }

    Positions positions_;
    Triangles triangles_;  // rows of -1 are deleted
    std::vector<std::vector<int>> faces_of_;  // empty where deleted
    int left_;
    std::vector<int> of_v_, of_u_, common_;  // kept between calls for their memory
};

}  // namespace

TriangleMesh collapse_short_edges(const TriangleMesh& closed, int vertices)
{
    Collapser collapser(closed);
    double length = k_first_short_edge
        * std::sqrt(2 / std::sqrt(3.0) * area(closed)
                    / vertices);  // derived: a vertex has two triangles, equilateral ones
    for (int sweep = 0; sweep < k_most_sweeps && collapser.left() > vertices; ++sweep, length *= k_short_edge_growth)
        collapser.sweep(length);
    return collapser.result();
}

}  // namespace garmentfit
