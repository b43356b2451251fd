// SPDX-License-Identifier: GPL-3.0-or-later
#include "wrapped_surface.h"

#include <array>
#include <vector>

#include <CGAL/alpha_wrap_3.h>

#include "cgal_mesh.h"
#include "surface_measures.h"

namespace garmentfit {

TriangleMesh wrap_surface(const TriangleMesh& surface, double alpha, double offset)
{
    std::vector<CgalKernel::Point_3> points;
    for (Eigen::Index v = 0; v < surface.positions.rows(); ++v)
        points.emplace_back(surface.positions(v, 0), surface.positions(v, 1), surface.positions(v, 2));
    std::vector<std::array<std::size_t, 3>> triangles;
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f)
        triangles.push_back({ std::size_t(surface.triangles(f, 0)), std::size_t(surface.triangles(f, 1)),
                              std::size_t(surface.triangles(f, 2)) });
    const double size = diagonal(surface.positions);
    CgalMesh mesh;
    CGAL::alpha_wrap_3(points, triangles, alpha * size, offset * size, mesh);
    return from_cgal(mesh);
}

}  // namespace garmentfit
