// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Point, segment and ray queries: the only place that knows FLANN and the CGAL AABB tree. All of them may be asked from several
// threads at a time.

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// Nearest of a set of points: FLANN, one KD-tree, exact. Of points equally near, the first.
class NearestPoint {
public:
    explicit NearestPoint(const Positions& points);

    double distance(const Vec3& query) const;
    /// @param known  one of the points is as near as that, which shortens the search
    int index(const Vec3& query, double known = INFINITY) const;

private:
    struct Tree;
    std::shared_ptr<const Tree> tree_;
};

/// The same by looking at every point.
class PointScan {
public:
    explicit PointScan(const Positions& points) : points_(points.array()) { }

    int index(const Vec3& query) const;

private:
    Eigen::Array<double, Eigen::Dynamic, 3> points_;  // column by column, for wide instructions
};

/// A surface in an AABB tree. Whether something meets it is decided by exact predicates. Triangles without area are left out: their
/// edges are edges of their neighbours.
class TriangleTree {
public:
    explicit TriangleTree(const TriangleMesh& surface);

    bool is_met(const Vec3& from, const Vec3& to) const;
    /// Triangles that the segment meets, ascending, but for those that `passed_over` tells to leave out: neighbours that meet it
    /// at a corner would each cost an exact computation.
    std::vector<int> met_by(const Vec3& from, const Vec3& to, const std::function<bool(int)>& passed_over = {}) const;
    double distance(const Vec3& query) const;  ///< infinite from an empty surface
    Vec3 nearest(const Vec3& query) const;  ///< point of the surface, which must not be empty

    struct Hit {
        double distance;
        bool from_behind;  ///< along the triangle's normal
        double cosine;  ///< of the angle between the ray and that normal
        int triangle;
    };
    /// First triangle met by a ray (of unit direction) and not parallel to it.
    std::optional<Hit> first_hit(const Vec3& from, const Vec3& direction) const;

private:
    struct Tree;
    std::shared_ptr<const Tree> tree_;
};

}  // namespace garmentfit
