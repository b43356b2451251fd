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

TriangleMesh block(const Vec3& low, const Vec3& high)
{
    const Vec3 middle = 0.5 * (low + high), half = 0.5 * (high - low), edge = Vec3::Constant(0.1);
    return polygonise([=](const Vec3& p) { return ((p - middle).cwiseAbs() - half).maxCoeff(); }, low - edge,
                      high + edge, 0.05);
}

Hips under(const TriangleMesh& cloth, double crotch = 0)
{
    return hips_under_cloth(person_skeleton({}), crotch, cloth.positions, cloth.triangles);
}

TEST(Hips, AreUnderTrousersThatReachTheirJoints)
{
    const double hip = person_skeleton({}).tail(lhipjoint).y();
    EXPECT_EQ(under(trousers_up_to(hip + 0.06, hip + 0.06)), (Hips { lhipjoint, rhipjoint }));
    EXPECT_EQ(under(trousers_up_to(hip - 0.06, hip - 0.06)), Hips {});
    EXPECT_EQ(under(trousers_up_to(hip - 0.06, hip + 0.06)), Hips { rhipjoint }) << "askew";
}

TEST(Hips, AreUnderLowTrousersOfABodyWhoseLegsPartFarBelow)
{
    const double hip = person_skeleton({}).tail(lhipjoint).y();
    EXPECT_EQ(under(trousers_up_to(hip - 0.06, hip - 0.06), 0.2), (Hips { lhipjoint, rhipjoint }));
    EXPECT_EQ(under(trousers_up_to(hip - 0.12, hip - 0.12), 0.2), Hips {});
}

TEST(Hips, AreAsFarAboveTheCrotchAsTheSurfaceShows)
{
    const Skeleton joints = person_skeleton({});
    const Vec3 hips = 0.5 * (joints.tail(lhipjoint) + joints.tail(rhipjoint));
    TriangleMesh body = block({ -0.2, hips.y() - 0.15, -0.15 }, { 0.2, hips.y() + 0.5, 0.15 });
    EXPECT_NEAR(crotch_depth(joints, body), 0.15, 1e-3);
    body = block({ -0.2, hips.y() - 0.8, -0.15 }, { 0.2, hips.y() + 0.5, 0.15 });
    EXPECT_EQ(crotch_depth(joints, body), 0) << "a gown";
    body = block({ 1, 0, 1 }, { 2, 2, 2 });
    EXPECT_EQ(crotch_depth(joints, body), 0) << "hips outside of the body";
}

TEST(Hips, AreUnderAShirtThatEndsAboveThem)
{
    const TriangleMesh shirt = garment_round(person_skeleton({}), 0.02, [](const Vec3& p) { return p.y() > 1.1; });
    EXPECT_EQ(under(shirt), (Hips { lhipjoint, rhipjoint })) << "it does not hang on the thighs";
}

}  // namespace
