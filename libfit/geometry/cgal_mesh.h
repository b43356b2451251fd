// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Between libfit's triangle mesh and CGAL's. Private: only sources that include CGAL include this.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "garmentfit/types.h"

namespace garmentfit {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<CgalKernel::Point_3>;

/// Same vertices and faces in the same order. @pre an oriented 2-manifold.
inline CgalMesh to_cgal(const TriangleMesh& mesh)
{
    CgalMesh result;
    result.reserve(mesh.positions.rows(), 3 * mesh.triangles.rows() / 2, mesh.triangles.rows());
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
        result.add_vertex({ mesh.positions(v, 0), mesh.positions(v, 1), mesh.positions(v, 2) });
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        result.add_face(CgalMesh::Vertex_index(mesh.triangles(f, 0)), CgalMesh::Vertex_index(mesh.triangles(f, 1)),
                        CgalMesh::Vertex_index(mesh.triangles(f, 2)));
    return result;
}

/// @pre all faces are triangles. Removed elements are skipped, the order is kept.
inline TriangleMesh from_cgal(const CgalMesh& mesh)
{
    TriangleMesh result;
    result.positions.resize(mesh.number_of_vertices(), 3);
    result.triangles.resize(mesh.number_of_faces(), 3);
    std::vector<int> row(mesh.num_vertices(), -1);
    int v = 0, f = 0;
    for (const auto vertex : mesh.vertices()) {
        const auto& p = mesh.point(vertex);
        result.positions.row(v) << p.x(), p.y(), p.z();
        row[vertex] = v++;
    }
    for (const auto face : mesh.faces()) {
        int k = 0;
        for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face)))
            result.triangles(f, k++) = row[vertex];
        ++f;
    }
    return result;
}

}  // namespace garmentfit
