// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Meshes of one shape with more or fewer vertices, to time how cost grows.

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "cgal_mesh.h"
#include "garmentfit/mesh.h"

namespace garmentfit {

/// Cuts triangles at the middles of their longest edges until there are so many vertices; no edge twice in a round.
class Refinement {
public:
    explicit Refinement(const TriangleMesh& mesh) : points_(mesh.positions.rows())
    {
        for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
            points_[v] = mesh.positions.row(v);
        for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
            faces_.push_back({ mesh.triangles(f, 0), mesh.triangles(f, 1), mesh.triangles(f, 2) });
    }

    std::size_t vertices() const { return points_.size(); }

    /// @return the mesh with at most so many vertices: fewer, where each edge is already cut
    TriangleMesh round(std::size_t most)
    {
        cut_longest_edges(most - points_.size());
        std::vector<Face> faces;
        std::swap(faces, faces_);
        for (const Face& face : faces)
            split(face);
        TriangleMesh mesh { Positions(points_.size(), 3), Triangles(faces_.size(), 3) };
        for (std::size_t v = 0; v < points_.size(); ++v)
            mesh.positions.row(Eigen::Index(v)) = points_[v];
        for (std::size_t f = 0; f < faces_.size(); ++f)
            mesh.triangles.row(Eigen::Index(f)) << faces_[f][0], faces_[f][1], faces_[f][2];
        return mesh;
    }

private:
    using Face = std::array<int, 3>;

    void cut_longest_edges(std::size_t count)
    {
        std::set<std::pair<int, int>> edges;
        for (const Face& f : faces_)
            for (int k = 0; k < 3; ++k)
                edges.insert(std::minmax({ f[k], f[(k + 1) % 3] }));
        std::vector<std::pair<int, int>> longest(edges.begin(), edges.end());
        const auto length = [&](const auto& e) { return (points_[e.first] - points_[e.second]).norm(); };
        std::stable_sort(longest.begin(), longest.end(),
                         [&](const auto& a, const auto& b) { return length(a) > length(b); });
        longest.resize(std::min(count, longest.size()));
        middles_.clear();
        for (const auto& e : longest) {
            middles_[e] = int(points_.size());
            points_.push_back(0.5 * (points_[e.first] + points_[e.second]));
        }
    }

    void split(const Face& f)
    {
        for (int k = 0; k < 3; ++k) {
            const int a = f[k], b = f[(k + 1) % 3], c = f[(k + 2) % 3];
            if (const auto middle = middles_.find(std::minmax({ a, b })); middle != middles_.end()) {
                split({ c, a, middle->second });
                split({ c, middle->second, b });
                return;
            }
        }
        faces_.push_back(f);
    }

    std::vector<Vec3> points_;
    std::vector<Face> faces_;
    std::map<std::pair<int, int>, int> middles_;
};

inline TriangleMesh refined(const TriangleMesh& mesh, std::size_t vertices)
{
    TriangleMesh result = mesh;
    for (Refinement refinement(mesh); refinement.vertices() < vertices;)
        result = refinement.round(vertices);
    return result;
}

/// Edges collapsed by what that costs the shape (Lindstrom and Turk), until there are so many vertices.
/// @pre as to_cgal()
inline TriangleMesh coarsened(const TriangleMesh& mesh, std::size_t vertices)
{
    namespace simplification = CGAL::Surface_mesh_simplification;
    CgalMesh cgal = to_cgal(mesh);
    const std::size_t edges = 3 * vertices;  // about, on any triangulated surface
    simplification::edge_collapse(cgal, simplification::Count_stop_predicate<CgalMesh>(edges));
    cgal.collect_garbage();
    return from_cgal(cgal);
}

inline TriangleMesh resampled(const TriangleMesh& mesh, std::size_t vertices)
{
    return vertices < std::size_t(mesh.positions.rows()) ? coarsened(mesh, vertices) : refined(mesh, vertices);
}

}  // namespace garmentfit
