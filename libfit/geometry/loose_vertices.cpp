// SPDX-License-Identifier: GPL-3.0-or-later
#include "loose_vertices.h"

#include <vector>

#include "nearest.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {
namespace {

// derived: of the diagonal; twice the largest weld of close_surface(), so a vertex and its copy on the closed surface
// are nearer.
constexpr double k_same_place = 1e-3;

/// The user's vertices by how many of their edges have faces on both sides.
struct Surroundings {
    std::vector<int> none, some, all;
};

/// Vertices of edges that have a single face.
std::vector<bool> on_border(const TriangleMesh& surface)
{
    const MeshTopology topology(surface.triangles, int(surface.positions.rows()));
    std::vector<bool> result(surface.positions.rows(), false);
    for (const int e : topology.border_edges())
        result[topology.edges()(e, 0)] = result[topology.edges()(e, 1)] = true;
    return result;
}

Surroundings surroundings(const TriangleMesh& surface)
{
    std::vector<bool> has_faces(surface.positions.rows(), false);
    for (Eigen::Index i = 0; i < surface.triangles.size(); ++i)
        has_faces[surface.triangles.data()[i]] = true;
    const std::vector<bool> border = on_border(surface);
    Surroundings result;
    for (int v = 0; v < int(has_faces.size()); ++v)
        (border[v] ? result.some : has_faces[v] ? result.all : result.none).push_back(v);
    return result;
}

/// Vertices of the closed surface along the borders of the user's, and of the patches over its holes.
Positions vertices_at_holes(const TriangleMesh& closed, const NearestPoint& whole, double same_place)
{
    std::vector<int> rows;
    for (int v = 0; v < int(closed.positions.rows()); ++v)
        if (whole.distance(closed.positions.row(v)) > same_place)
            rows.push_back(v);
    return closed.positions(rows, Eigen::all);
}

}  // namespace

Positions move_to_stumps(const BodyMesh& body)
{
    Positions result = body.surface.positions;
    const Surroundings vertices = surroundings(body.surface);
    if (vertices.none.empty() || vertices.some.empty() || vertices.all.empty())
        return result;
    const Positions& closed = body.closed.positions;
    const double size = diagonal(closed);
    const NearestPoint whole(result(vertices.all, Eigen::all));
    const Positions stumps = vertices_at_holes(body.closed, whole, k_same_place * size);
    if (stumps.rows() == 0)
        return result;
    const NearestPoint stump(stumps);
    for (const int v : vertices.none)
        if (const Vec3 p = result.row(v);
            whole.distance(p) > k_same_place * size && stump.distance(p) < k_reach_of_stump * size)
            result.row(v) = stumps.row(stump.index(p));
    return result;
}

}  // namespace garmentfit
