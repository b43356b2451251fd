// SPDX-License-Identifier: GPL-3.0-or-later
#include "remeshed_cloth.h"

#include <array>
#include <cmath>
#include <vector>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>

#include "cgal_mesh.h"
#include "disjoint_sets.h"
#include "surface_measures.h"
#include "tuning.h"

namespace garmentfit {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

bool is_oriented_manifold(const Triangles& triangles)
{
    std::vector<std::array<int, 3>> faces;
    for (const auto& corners : triangles.rowwise())
        faces.push_back({ corners[0], corners[1], corners[2] });
    return pmp::is_polygon_soup_a_polygon_mesh(faces);
}

/// @param least  m^2
TriangleMesh without_small_pieces(const TriangleMesh& cloth, double least)
{
    DisjointSets pieces(int(cloth.positions.rows()));
    for (const auto& corners : cloth.triangles.rowwise())
        for (int k = 0; k < 2; ++k)
            pieces.join(corners[k], corners[k + 1]);
    std::vector<double> area_of(cloth.positions.rows(), 0);  // by the root
    for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f)
        area_of[pieces.root(cloth.triangles(f, 0))] += area_vector(cloth.positions, cloth.triangles, f).norm();
    std::vector<Eigen::Index> kept;
    for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f)
        if (area_of[pieces.root(cloth.triangles(f, 0))] >= least)
            kept.push_back(f);
    return { cloth.positions, cloth.triangles(kept, Eigen::all) };
}

}  // namespace

std::optional<TriangleMesh> remeshed_cloth(const TriangleMesh& cloth, int vertices)
{
    // derived: there are half as many vertices as equilateral triangles
    const double side = std::sqrt(2 / std::sqrt(3.0) * area(cloth) / vertices);
    const TriangleMesh large = without_small_pieces(cloth, k_least_piece * side * side);
    if (large.triangles.rows() == 0 || !is_oriented_manifold(large.triangles))
        return {};
    CgalMesh mesh = to_cgal(large);
    pmp::isotropic_remeshing(faces(mesh), side, mesh,
                             pmp::parameters::number_of_iterations(k_remeshing_rounds).protect_constraints(false));
    for (const auto vertex : mesh.vertices())
        if (mesh.is_isolated(vertex))  // of small pieces
            mesh.remove_vertex(vertex);
    mesh.collect_garbage();
    return from_cgal(mesh);
}

}  // namespace garmentfit
