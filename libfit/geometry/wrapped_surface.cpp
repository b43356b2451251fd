// SPDX-License-Identifier: GPL-3.0-or-later
#include "wrapped_surface.h"

#include <array>
#include <vector>

#include <CGAL/alpha_wrap_3.h>

#include "cgal_mesh.h"
#include "surface_measures.h"

namespace garmentfit {
namespace {

constexpr std::size_t k_between_calls = 256;  // unit: points; some ten milliseconds

/// Counts the points as CGAL inserts them.
class WatchedWrap : public CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
public:
    explicit WatchedWrap(const std::function<void(std::size_t)>& watch) : watch_(watch) { }

    template <class Wrapper, class Vertex>
    void after_Steiner_point_insertion(const Wrapper&, Vertex)
    {
        if (++points_ % k_between_calls == 0 && watch_)
            watch_(points_);
    }

private:
    const std::function<void(std::size_t)>& watch_;
    std::size_t points_ = 0;
};

}  // namespace

TriangleMesh wrap_surface(const TriangleMesh& surface, double alpha, double offset,
                          const std::function<void(std::size_t)>& watch)
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
    WatchedWrap visitor(watch);
    CGAL::alpha_wrap_3(points, triangles, alpha * size, offset * size, mesh, CGAL::parameters::default_values(),
                       CGAL::parameters::visitor(std::ref(visitor)));
    return from_cgal(mesh);
}

}  // namespace garmentfit
