// SPDX-License-Identifier: GPL-3.0-or-later
#include "nearest.h"

#include <cmath>
#include <utility>
#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <flann/flann.hpp>

namespace fit {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::const_iterator>;
using Aabb = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(const Vec3& p) { return { p.x(), p.y(), p.z() }; }

std::vector<Kernel::Triangle_3> triangles_of(const TriangleMesh& surface)
{
    std::vector<Kernel::Triangle_3> result;
    result.reserve(surface.triangles.rows());
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
        const auto corner = [&](int k) { return point(surface.positions.row(surface.triangles(f, k))); };
        if (const Kernel::Triangle_3 triangle(corner(0), corner(1), corner(2)); !triangle.is_degenerate())
            result.push_back(triangle);
    }
    return result;
}

}  // namespace

struct NearestPoint::Tree {
    explicit Tree(const Positions& given)
        : points(given)
        , index(flann::Matrix<double>(points.data(), points.rows(), 3), flann::KDTreeSingleIndexParams(10, true))
    {
        index.buildIndex();
    }
    std::pair<int, double> nearest(const Vec3& query) const
    {
        flann::KNNSimpleResultSet<double> best(1);
        index.findNeighbors(best, query.data(), flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED, 0));
        std::size_t found = 0;
        double squared = 0;
        best.copy(&found, &squared, 1, false);
        return { int(found), std::sqrt(squared) };
    }
    Positions points;
    flann::KDTreeSingleIndex<flann::L2_3D<double>> index;
};

NearestPoint::NearestPoint(const Positions& points) : tree_(std::make_shared<const Tree>(points)) { }
double NearestPoint::distance(const Vec3& query) const { return tree_->nearest(query).second; }
int NearestPoint::index(const Vec3& query) const { return tree_->nearest(query).first; }

struct SurfaceCrossings::Tree {
    explicit Tree(const TriangleMesh& surface)
        : triangles(triangles_of(surface)), aabb(triangles.cbegin(), triangles.cend())
    {
        aabb.build();  // now, not at the first query: queries come from several threads
    }
    std::vector<Kernel::Triangle_3> triangles;
    Aabb aabb;
};

SurfaceCrossings::SurfaceCrossings(const TriangleMesh& surface) : tree_(std::make_shared<const Tree>(surface)) { }

bool SurfaceCrossings::crosses(const Vec3& from, const Vec3& to) const
{
    return from != to && tree_->aabb.do_intersect(Kernel::Segment_3(point(from), point(to)));
}

}  // namespace fit
