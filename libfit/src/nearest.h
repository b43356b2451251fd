// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Point and segment queries: the only place that knows FLANN and the CGAL tree of the fit.

#include <memory>

#include "fit/types.h"

namespace fit {

/// Nearest of a set of points: FLANN, one KD-tree, exact.
class NearestPoint {
public:
    explicit NearestPoint(const Positions& points);

    double distance(const Vec3& query) const;
    int index(const Vec3& query) const;

private:
    struct Tree;
    std::shared_ptr<const Tree> tree_;
};

/// Does a segment pass through a surface? Decided by exact predicates on an AABB tree; triangles without area are left out.
class SurfaceCrossings {
public:
    explicit SurfaceCrossings(const TriangleMesh& surface);

    bool crosses(const Vec3& from, const Vec3& to) const;

private:
    struct Tree;
    std::shared_ptr<const Tree> tree_;
};

}  // namespace fit
