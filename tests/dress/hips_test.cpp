// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/hips.h"

#include <vector>

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

using Hips = std::vector<Bone>;

TriangleMesh trousers_up_to(double left, double right)
{
    return garment_round(person_skeleton({}), 0.02,
                         [=](const Vec3& p) { return p.y() > 0.2 && p.y() < (p.x() > 0 ? left : right); });
}

Hips under(const TriangleMesh& cloth, const Skeleton& joints = person_skeleton({}))
{
    return hips_under_cloth(joints, cloth.positions, cloth.triangles);
}

TEST(Hips, AreUnderTrousersThatReachTheirJoints)
{
    const double hip = person_skeleton({}).tail(lhipjoint).y();
    EXPECT_EQ(under(trousers_up_to(hip + 0.06, hip + 0.06)), (Hips { lhipjoint, rhipjoint }));
    EXPECT_EQ(under(trousers_up_to(hip - 0.06, hip - 0.06)), Hips {});
    EXPECT_EQ(under(trousers_up_to(hip - 0.06, hip + 0.06)), Hips { rhipjoint }) << "askew";
}

TEST(Hips, AreUnderAShirtThatEndsAboveThem)
{
    const TriangleMesh shirt = garment_round(person_skeleton({}), 0.02, [](const Vec3& p) { return p.y() > 1.1; });
    EXPECT_EQ(under(shirt), (Hips { lhipjoint, rhipjoint })) << "it does not hang on the thighs";
}

}  // namespace
