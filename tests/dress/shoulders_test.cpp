// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/shoulders.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

using Shoulders = std::vector<Bone>;

// A band of two triangles from front to back at this x and height.
TriangleMesh strap(double x, double y)
{
    TriangleMesh band { Positions(4, 3), Triangles(2, 3) };
    band.positions << x - 0.01, y, -0.1, x + 0.01, y, -0.1, x - 0.01, y, 0.1, x + 0.01, y, 0.1;
    band.triangles << 0, 2, 1, 1, 2, 3;
    return band;
}

Shoulders under(const TriangleMesh& cloth)
{
    return shoulders_under_cloth(person_skeleton({}), cloth.positions, cloth.triangles);
}

TEST(Shoulders, AreUnderWhatPassesOverTheCollarbone)
{
    const Skeleton joints = person_skeleton({});
    const Vec3 middle = 0.5 * (joints.head(lclavicle) + joints.tail(lclavicle)), end = joints.tail(lclavicle);
    const double length = joints.length(lclavicle);
    EXPECT_EQ(under(strap(middle.x(), middle.y() + 0.05)), Shoulders { lclavicle });
    EXPECT_EQ(under(joined(strap(middle.x(), middle.y() + 0.05), strap(-middle.x(), middle.y() + 0.05))),
              (Shoulders { lclavicle, rclavicle }));
    EXPECT_EQ(under(strap(middle.x(), middle.y() - 0.1)), Shoulders {}) << "below";
    EXPECT_EQ(under(strap(middle.x(), middle.y() + 2 * length)), Shoulders {}) << "a hat";
    EXPECT_EQ(under(strap(end.x() + 0.5 * length, end.y() + 0.02)), Shoulders {}) << "on the arm";
}

TEST(Shoulders, OfAShirtAreUnderIt)
{
    const Skeleton joints = person_skeleton({});
    const auto shirt = [&](double neck) {
        return garment_round(joints, 0.02, [neck](const Vec3& p) {
            return p.y() > 0.85 && p.y() < 1.55 && (p.y() < 1.3 || std::abs(p.x()) > neck);
        });
    };
    EXPECT_EQ(under(shirt(0.1)), (Shoulders { lclavicle, rclavicle }));
    EXPECT_EQ(under(shirt(0.25)), Shoulders {}) << "its neck is as wide as the shoulders";
}

}  // namespace
