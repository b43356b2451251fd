// SPDX-License-Identifier: GPL-3.0-or-later
#include "nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <flann/flann.hpp>

namespace garmentfit {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using TriangleIterator = std::vector<Kernel::Triangle_3>::const_iterator;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, TriangleIterator>;
using Aabb = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(const Vec3& p) { return { p.x(), p.y(), p.z() }; }

constexpr double k_anywhere = 1e150;  // unit: m; the largest distance whose square is still a number

// Of points equally near, the one with the lowest index, in whatever order the tree visits them.
class FirstNearest : public flann::ResultSet<double> {
public:
    explicit FirstNearest(double known) : squared_(known * known * k_rounding), above_(squared_) { }
    bool full() const override { return true; }
    void addPoint(double squared, std::size_t candidate) override
    {
        if (squared < squared_ || (squared == squared_ && candidate < index_)) {
            squared_ = squared;
            index_ = candidate;
            above_ = std::nextafter(squared, INFINITY);
        }
    }
    double worstDist() const override { return above_; }

    std::pair<int, double> found() const { return { int(index_), std::sqrt(squared_) }; }

private:
    static constexpr double k_rounding = 1 + 1e-12;  // unit: the known point has to be found again, whatever rounds

    std::size_t index_ = 0;
    double squared_;
    double above_;  // FLANN reports points below this bound; points equally near have to be among them
};

/// Lists the triangles that a segment meets, in a traversal of the tree.
struct Listing {
    const Aabb::AABB_traits& traits;
    const std::vector<Kernel::Triangle_3>& triangles;
    const std::vector<int>& index;
    const std::function<bool(int)>& is_skipped;
    std::vector<int> result;

    bool go_further() const { return true; }
    template <class Node>
    bool do_intersect(const Kernel::Segment_3& segment, const Node& node) const
    {
        return traits.do_intersect_object()(segment, node.bbox());
    }
    void intersection(const Kernel::Segment_3& segment, const Primitive& primitive)
    {
        const int triangle = index[primitive.id() - triangles.cbegin()];
        if (!(is_skipped && is_skipped(triangle)) && CGAL::do_intersect(segment, *primitive.id()))
            result.push_back(triangle);
    }
};

}  // namespace

struct NearestPoint::Tree {
    explicit Tree(const Positions& given) :
        points(given), index(flann::Matrix<double>(points.data(), points.rows(), 3),
                             flann::KDTreeSingleIndexParams(10, true))  // unit: 10 points a leaf, FLANN's own choice
    {
        index.buildIndex();
    }
    std::pair<int, double> nearest(const Vec3& query, double known = INFINITY) const
    {
        FirstNearest best(std::min(known, k_anywhere));
        index.findNeighbors(best, query.data(), flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED, 0));
        return best.found();
    }
    std::vector<int> within(const Vec3& query, double distance, int most) const
    {
        flann::KNNRadiusResultSet<double> found(distance * distance, std::size_t(most));
        index.findNeighbors(found, query.data(), flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED, 0));
        std::vector<std::size_t> indices(found.size());
        std::vector<double> squared(found.size());
        found.copy(indices.data(), squared.data(), found.size());
        return { indices.begin(), indices.end() };
    }
    Positions points;
    flann::KDTreeSingleIndex<flann::L2_3D<double>> index;
};

NearestPoint::NearestPoint(const Positions& points) : tree_(std::make_shared<const Tree>(points)) { }
double NearestPoint::distance(const Vec3& query) const { return tree_->nearest(query).second; }
int NearestPoint::index(const Vec3& query, double known) const { return tree_->nearest(query, known).first; }
std::vector<int> NearestPoint::within(const Vec3& query, double distance, int most) const
{
    return tree_->within(query, distance, most);
}

int PointScan::index(const Vec3& query) const
{
    constexpr Eigen::Index block
        = 256;  // unit: fits the first cache; the index is looked up in blocks that improve only
    double nearest = INFINITY;
    Eigen::Index index = 0;
    for (Eigen::Index begin = 0; begin < points_.rows(); begin += block) {
        const auto points = points_.middleRows(begin, std::min(block, points_.rows() - begin));
        const Eigen::Array<double, Eigen::Dynamic, 1, 0, block, 1> squared = (points.col(0) - query.x()).square()
            + (points.col(1) - query.y()).square() + (points.col(2) - query.z()).square();
        if (const double least = squared.minCoeff(); least < nearest) {
            nearest = least;
            squared.minCoeff(&index);
            index += begin;
        }
    }
    return int(index);
}

struct TriangleTree::Tree {
    explicit Tree(const TriangleMesh& surface)
    {
        for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
            const auto corner = [&](int k) { return point(surface.positions.row(surface.triangles(f, k))); };
            if (const Kernel::Triangle_3 triangle(corner(0), corner(1), corner(2)); !triangle.is_degenerate()) {
                triangles.push_back(triangle);
                index.push_back(int(f));
            }
        }
        aabb.rebuild(triangles.cbegin(), triangles.cend());
        aabb.build();  // now, not at the first query: queries come from several threads
    }
    std::vector<Kernel::Triangle_3> triangles;
    std::vector<int> index;  // of each of them in the surface
    Aabb aabb;
};

TriangleTree::TriangleTree(const TriangleMesh& surface) : tree_(std::make_shared<const Tree>(surface)) { }

bool TriangleTree::is_met(const Vec3& from, const Vec3& to) const
{
    return from != to && tree_->aabb.do_intersect(Kernel::Segment_3(point(from), point(to)));
}

std::vector<int> TriangleTree::met_by(const Vec3& from, const Vec3& to,
                                      const std::function<bool(int)>& is_skipped) const
{
    Listing listing { tree_->aabb.traits(), tree_->triangles, tree_->index, is_skipped, {} };
    if (from != to && !tree_->triangles.empty())
        tree_->aabb.traversal(Kernel::Segment_3(point(from), point(to)), listing);
    std::sort(listing.result.begin(), listing.result.end());
    return listing.result;
}

double TriangleTree::distance(const Vec3& query) const
{
    return tree_->triangles.empty() ? INFINITY : std::sqrt(tree_->aabb.squared_distance(point(query)));
}

Vec3 TriangleTree::nearest(const Vec3& query) const
{
    const Kernel::Point_3 there = tree_->aabb.closest_point(point(query));
    return { there.x(), there.y(), there.z() };
}

std::optional<TriangleTree::Nearest> TriangleTree::nearest_triangle(const Vec3& query) const
{
    if (tree_->triangles.empty())
        return {};
    const auto [there, triangle] = tree_->aabb.closest_point_and_primitive(point(query));
    return Nearest { { there.x(), there.y(), there.z() }, tree_->index[triangle - tree_->triangles.cbegin()] };
}

std::optional<TriangleTree::Nearest> TriangleTree::nearest_triangle_within(const Vec3& query, double distance) const
{
    const auto nearest = nearest_triangle(query);
    return nearest && (nearest->point - query).norm() <= distance ? nearest : std::nullopt;
}

std::optional<TriangleTree::Hit> TriangleTree::first_hit(const Vec3& from, const Vec3& direction) const
{
    const Kernel::Vector_3 along(direction.x(), direction.y(), direction.z());
    const auto hit = tree_->aabb.first_intersection(Kernel::Ray_3(point(from), along));
    const Kernel::Point_3* where = hit ? boost::get<Kernel::Point_3>(&hit->first) : nullptr;
    if (!where)
        return {};
    const auto normal = hit->second->supporting_plane().orthogonal_vector();
    const double towards = normal * along;
    return Hit { std::sqrt(CGAL::squared_distance(*where, point(from))), towards > 0,
                 towards / std::sqrt(std::max(normal.squared_length(), 1e-300)),  // unit: avoids 0 / 0
                 tree_->index[hit->second - tree_->triangles.cbegin()] };
}

}  // namespace garmentfit
