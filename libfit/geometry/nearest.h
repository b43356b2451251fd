// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Point, segment and ray queries by FLANN and CGAL's AABB tree, which no other header shows. Queries are thread-safe.
// docs/decisions/0016-trees.md says when to take VertexTree or CrossingTree.

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// Nearest of a set of points by FLANN's KD-tree, exact. Of points equally near, the first.
class NearestPoint {
public:
    explicit NearestPoint(const Positions& points);

    double distance(const Vec3& query) const;
    /// @param known  m; one of the points is known to be this near, which shortens the search
    int index(const Vec3& query, double known = INFINITY) const;
    /// Of the points within a distance, m, the nearest, `most` at most; a point at the query is one of them.
    std::vector<int> within(const Vec3& query, double distance, int most) const;

private:
    struct Tree;
    std::shared_ptr<const Tree> tree_;
};

/// The same by a look at every point: five times as slow on 10^4 points. The paper's method is timed with it.
class PointScan {
public:
    explicit PointScan(const Positions& points) : points_(points.array()) { }

    int index(const Vec3& query) const;

private:
    Eigen::Array<double, Eigen::Dynamic, 3> points_;  // column by column, for wide instructions
};

/// A surface in CGAL's AABB tree. Exact predicates decide whether something meets it. Triangles without area are left
/// out: their edges are edges of their neighbours.
class TriangleTree {
public:
    explicit TriangleTree(const TriangleMesh& surface);

    bool is_met(const Vec3& from, const Vec3& to) const;
    /// Triangles that the segment meets, ascending, without those for which `is_skipped` is true. Neighbours that share
    /// a corner with the segment would each cost an exact computation.
    std::vector<int> met_by(const Vec3& from, const Vec3& to, const std::function<bool(int)>& is_skipped = {}) const;
    double distance(const Vec3& query) const;  ///< m; infinite for an empty surface
    Vec3 nearest(const Vec3& query) const;  ///< a point of the surface; @pre the surface is not empty

    struct Nearest {
        Vec3 point;
        int triangle;
    };
    std::optional<Nearest> nearest_triangle(const Vec3& query) const;  ///< none for an empty surface
    /// The same; none where it is further away than a distance, m.
    std::optional<Nearest> nearest_triangle_within(const Vec3& query, double distance) const;

    struct Hit {
        double distance;
        bool from_behind;  ///< the ray runs along the triangle's normal
        double cosine;  ///< of the angle between the ray and that normal
        int triangle;
    };
    /// The first triangle that a ray of unit direction meets. Triangles parallel to the ray are left out.
    std::optional<Hit> first_hit(const Vec3& from, const Vec3& direction) const;

private:
    struct Tree;
    std::shared_ptr<const Tree> tree_;
};

}  // namespace garmentfit
