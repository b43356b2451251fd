// SPDX-License-Identifier: GPL-3.0-or-later
#include "crossing_tree.h"

#include <cmath>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

namespace garmentfit {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr int k_leaf_size = 4;  // unit: decides speed only
constexpr double k_slack = 1e-9;  // unit: m; far more than the few roundings of a box test, far less than a box

Kernel::Point_3 point(const Vec3& p) { return { p.x(), p.y(), p.z() }; }

// A segment against boxes by separating axes: those of the box, and their cross products with the segment.
class SegmentTest {
public:
    SegmentTest(const Vec3& from, const Vec3& to) :
        middle_(0.5 * (from + to)), half_(0.5 * (to - from)), extent_(half_.cwiseAbs())
    {
    }

    bool may_meet(const FloatBox& box) const
    {
        const Vec3 low = box.min().cast<double>(), high = box.max().cast<double>();
        const Vec3 size = 0.5 * (high - low) + Vec3::Constant(k_slack), apart = middle_ - 0.5 * (low + high);
        if ((apart.cwiseAbs().array() > (extent_ + size).array()).any())
            return false;
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            if (std::abs(apart[j] * half_[k] - apart[k] * half_[j]) > size[j] * extent_[k] + size[k] * extent_[j])
                return false;
        }
        return true;
    }

private:
    Vec3 middle_, half_, extent_;
};

}  // namespace

CrossingTree::CrossingTree(const TriangleMesh& surface)
{
    std::vector<FloatBox> boxes;
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
        const auto corner = [&](int k) { return Vec3(surface.positions.row(surface.triangles(f, k))); };
        const std::array<Vec3, 3> c { corner(0), corner(1), corner(2) };
        if (CGAL::collinear(point(c[0]), point(c[1]), point(c[2])))
            continue;
        triangles_.push_back(c);
        boxes.push_back(box_about(c[0].cwiseMin(c[1]).cwiseMin(c[2]), c[0].cwiseMax(c[1]).cwiseMax(c[2])));
    }
    boxes_ = box_hierarchy(boxes, k_leaf_size);
}

bool CrossingTree::is_met(const Vec3& from, const Vec3& to) const
{
    if (from == to)
        return false;
    const SegmentTest test(from, to);
    const Kernel::Segment_3 segment(point(from), point(to));
    bool is_met = false;
    boxes_.walk([&](const BoxNode& node) { return test.may_meet(node.box); },
                [&](const BoxNode& leaf) {
                    for (const BoxedPrimitive& item : boxes_.items(leaf)) {
                        const auto& [a, b, c] = triangles_[item.primitive];
                        is_met
                            = is_met || CGAL::do_intersect(segment, Kernel::Triangle_3(point(a), point(b), point(c)));
                    }
                    return !is_met;
                });
    return is_met;
}

}  // namespace garmentfit
