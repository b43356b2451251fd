// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/reconstruct.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#define CGAL_EIGEN3_ENABLED
#include <CGAL/Scale_space_reconstruction_3/Advancing_front_mesher.h>
#include <CGAL/Scale_space_reconstruction_3/Weighted_PCA_smoother.h>
#include <CGAL/Scale_space_surface_reconstruction_3.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/grid_simplify_point_set.h>
#include <CGAL/property_map.h>
#include <CGAL/remove_outliers.h>

#include "cgal_mesh.h"
#include "garmentfit/error.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using IndexedPoint = std::pair<CgalKernel::Point_3, int>;
using PointMap = CGAL::First_of_pair_property_map<IndexedPoint>;

std::vector<IndexedPoint> number_points(const Positions& points)
{
    std::vector<IndexedPoint> result;
    for (Eigen::Index v = 0; v < points.rows(); ++v)
        if (points.row(v).allFinite())
            result.push_back({ { points(v, 0), points(v, 1), points(v, 2) }, int(v) });
    return result;
}

double spacing(const std::vector<IndexedPoint>& points)
{
    return CGAL::compute_average_spacing<CGAL::Sequential_tag>(points, k_spacing_neighbours,
                                                               CGAL::parameters::point_map(PointMap()));
}

void remove_outliers(std::vector<IndexedPoint>& points)
{
    const auto first = CGAL::remove_outliers<CGAL::Sequential_tag>(
        points, k_spacing_neighbours,
        CGAL::parameters::point_map(PointMap()).threshold_percent(100).threshold_distance(k_outlier * spacing(points)));
    points.erase(first, points.end());
}

void thin_out(std::vector<IndexedPoint>& points)
{
    if (double(points.size()) <= k_most_points)
        return;
    // derived: on a plane with one point a cell, k neighbours fill a disc of radius sqrt(k / pi) cells, and their mean
    // distance is 2 / 3 of it
    const double cell = spacing(points) * 1.5 / std::sqrt(k_spacing_neighbours / 3.14)
        * std::sqrt(double(points.size()) / k_most_points);
    points.erase(CGAL::grid_simplify_point_set(points, cell, CGAL::parameters::point_map(PointMap())), points.end());
}

}  // namespace

Triangles reconstruct_surface(const Positions& points, const Progress& progress)
{
    std::vector<IndexedPoint> kept = number_points(points);
    if (kept.size() >= std::size_t(k_fewest_points)) {
        remove_outliers(kept);
        progress.at(0.2);
        thin_out(kept);
    }
    if (kept.size() < std::size_t(k_fewest_points))
        throw InvalidInput(ErrorCode::no_faces,
                           "body: " + std::to_string(kept.size()) + " points are too few for a surface (at least "
                               + std::to_string(k_fewest_points) + "); give a denser scan");
    progress.at(0.3);

    CGAL::Scale_space_surface_reconstruction_3<CgalKernel> scales;
    for (const IndexedPoint& point : kept)
        scales.insert(point.first);
    scales.increase_scale(k_scale_steps, CGAL::Scale_space_reconstruction_3::Weighted_PCA_smoother<CgalKernel>());
    progress.at(0.7);
    scales.reconstruct_surface(
        CGAL::Scale_space_reconstruction_3::Advancing_front_mesher<CgalKernel>(k_longest_bridge * spacing(kept)));

    Triangles triangles(Eigen::Index(scales.number_of_facets()), 3);
    Eigen::Index f = 0;
    for (auto facet = scales.facets_begin(); facet != scales.facets_end(); ++facet)
        triangles.row(f++) << kept[(*facet)[0]].second, kept[(*facet)[1]].second, kept[(*facet)[2]].second;
    progress.at(1);
    return triangles;
}

}  // namespace garmentfit
