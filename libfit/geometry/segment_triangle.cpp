// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment_triangle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

namespace garmentfit {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(const Vec3& p) { return { p.x(), p.y(), p.z() }; }

}  // namespace

bool meets(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c)
{
    const Kernel::Point_3 p = point(a), q = point(b), r = point(c);
    return from != to && CGAL::do_intersect(Kernel::Segment_3(point(from), point(to)), Kernel::Triangle_3(p, q, r))
        && !CGAL::collinear(p, q, r);
}

}  // namespace garmentfit
