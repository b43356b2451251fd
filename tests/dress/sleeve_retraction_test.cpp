// SPDX-License-Identifier: GPL-3.0-or-later
#include "sleeve_retraction.h"

#include <gtest/gtest.h>

#include "fixtures.h"
#include "nearest.h"
#include "sewn_pieces.h"
#include "topology.h"
#include "weld.h"

namespace garmentfit {
namespace {

using namespace fixtures;

struct Sleeve : testing::Test {
    const Person person = capsule_person();
    const Skeleton& joints = person.skeleton;
    const double wrist = joints.length(lradius);

    double along(const Positions& positions, Eigen::Index v) const
    {
        return (positions.row(v).transpose() - joints.head(lradius)).dot(joints.direction(lradius));
    }
    double furthest(const Positions& positions) const
    {
        double result = 0;
        for (Eigen::Index v = 0; v < positions.rows(); ++v)
            result = std::max(result, along(positions, v));
        return result;
    }
    TriangleMesh sleeve(double to, double radius = 0.06) const
    {
        const GarmentMesh garment = sleeve_round(joints, lradius, radius, 0.05, to);
        return { garment.positions, garment.triangles };
    }
};

// A square of 1 cm, so far from the forearm's line.
TriangleMesh with_button(const TriangleMesh& sleeve, const Vec3& middle, const Vec3& u, const Vec3& v)
{
    TriangleMesh result = sleeve;
    const Eigen::Index first = sleeve.positions.rows(), faces = sleeve.triangles.rows();
    result.positions.conservativeResize(first + 4, 3);
    for (int corner = 0; corner < 4; ++corner)
        result.positions.row(first + corner) = middle + 0.005 * ((corner % 2 ? 1 : -1) * u + (corner / 2 ? 1 : -1) * v);
    result.triangles.conservativeResize(faces + 2, 3);
    result.triangles.bottomRows(2) << first, first + 1, first + 2, first + 1, first + 3, first + 2;
    return result;
}

TEST_F(Sleeve, ThatReachesBeyondTheWristIsRetractedBehindIt)
{
    const TriangleMesh given = sleeve(wrist + 0.1);
    const SleeveRetraction retraction(joints, given);
    ASSERT_TRUE(retraction.is_any());
    EXPECT_LT(furthest(retraction.positions()), 0.8 * wrist);
    for (Eigen::Index v = 0; v < given.positions.rows(); ++v) {
        const Vec3 moved = (retraction.positions().row(v) - given.positions.row(v)).transpose();
        EXPECT_LT(moved.cross(joints.direction(lradius)).norm(), 1e-12) << "it goes along the bone";
        EXPECT_GT(along(retraction.positions(), v), 0) << "it does not pass the elbow";
    }
}

TEST_F(Sleeve, ThatLeadsOffTheBonesLineComesBackToIt)
{
    TriangleMesh given = sleeve(wrist + 0.15);
    const Vec3 side = joints.direction(lradius).unitOrthogonal();
    for (Eigen::Index v = 0; v < given.positions.rows(); ++v)
        if (const double beyond = along(given.positions, v) - wrist; beyond > 0)
            given.positions.row(v) += beyond * side;
    const SleeveRetraction retraction(joints, given);
    ASSERT_TRUE(retraction.is_any());
    const TriangleTree cloth({ retraction.positions(), given.triangles });
    EXPECT_FALSE(cloth.is_met(joints.head(lradius), joints.tail(lradius)));
}

TEST_F(Sleeve, ThatEndsBeforeTheWristStays)
{
    const TriangleMesh given = sleeve(wrist - 0.02);
    const SleeveRetraction retraction(joints, given);
    EXPECT_FALSE(retraction.is_any());
    EXPECT_EQ(retraction.positions(), given.positions);
}

TEST_F(Sleeve, IsNotWhatHangsBesideAHand)
{
    TriangleMesh panel = sleeve(wrist + 0.1);
    panel.triangles.conservativeResize(panel.triangles.rows() / 2, 3);
    std::vector<int> kept;  // half of each ring
    for (Eigen::Index f = 0; f < panel.triangles.rows(); ++f)
        if (panel.triangles(f, 0) % 24 < 12)
            kept.push_back(int(f));
    // vertices without a face are no cloth, but lie all round the arm
    std::vector<int> half;
    for (int v = 0; v < int(panel.positions.rows()); ++v)
        if (v % 24 <= 12)
            half.push_back(v);
    TriangleMesh given { panel.positions(half, Eigen::all), Triangles(Eigen::Index(kept.size()), 3) };
    for (std::size_t f = 0; f < kept.size(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int v = panel.triangles(kept[f], k);
            given.triangles(Eigen::Index(f), k) = v / 24 * 13 + v % 24;
        }
    EXPECT_FALSE(SleeveRetraction(joints, given).is_any());
}

TEST_F(Sleeve, TakesItsButtonsAlong)
{
    const TriangleMesh plain = sleeve(wrist + 0.1);
    const Vec3 axis = joints.direction(lradius), side = axis.unitOrthogonal();
    const Vec3 on_cuff = joints.head(lradius) + (wrist + 0.08) * axis + 0.064 * side;
    const TriangleMesh given = with_button(plain, on_cuff, axis, axis.cross(side));
    const SleeveRetraction retraction(joints, given);
    ASSERT_TRUE(retraction.is_any());
    for (Eigen::Index v = plain.positions.rows(); v < given.positions.rows(); ++v)
        EXPECT_LT(along(retraction.positions(), v), 0.8 * wrist);
}

/// Cut lengthwise: the faces of either half of each ring, 2 mm apart.
TriangleMesh in_two_halves(const TriangleMesh& sleeve, const Vec3& apart)
{
    TriangleMesh halves[2];
    for (const bool second : { false, true }) {
        std::vector<int> faces;
        for (int f = 0; f < int(sleeve.triangles.rows()); ++f)
            if ((f / 2 % 24 >= 12) == second)
                faces.push_back(f);
        const GarmentMesh half { sleeve.positions, sleeve.triangles(faces, Eigen::all) };
        const GarmentMesh alone = Weld(half).gather(half);  // without the other half's vertices
        halves[second] = { alone.positions, alone.triangles };
        halves[second].positions.rowwise() += (second ? 0.001 : -0.001) * apart.transpose();
    }
    return joined(halves[0], halves[1]);
}

TEST_F(Sleeve, MayBeSewnFromTwoHalves)
{
    const Vec3 axis = joints.direction(lradius), apart = -axis.cross(axis.unitOrthogonal());
    const TriangleMesh given = in_two_halves(sleeve(wrist + 0.1), apart);
    const MeshTopology topology(given.triangles, int(given.positions.rows()));
    const SewnPieces sewn = find_sewn_pieces({ given.positions, given.triangles }, topology);
    EXPECT_FALSE(SleeveRetraction(joints, given).is_any()) << "neither half goes round the arm";
    const SleeveRetraction retraction(joints, given, sewn.ties);
    ASSERT_TRUE(retraction.is_any());
    EXPECT_LT(furthest(retraction.positions()), 0.8 * wrist);
}

TEST_F(Sleeve, SetsFreeTheHandThatItCovered)
{
    const SleeveRetraction retraction(joints, sleeve(wrist + 0.1));
    Positions points(4, 3);
    points << joints.tips[lhand_tip].transpose(), joints.head(lradius).transpose(), joints.tips[rhand_tip].transpose(),
        joints.tail(lradius).transpose();
    SkinWeights weights = on_bone(lradius, 4);
    weights.bones(2, 0) = rradius;
    const std::vector<double> scales = retraction.min_scales(points, weights, joints);
    EXPECT_EQ(scales[0], 1) << "fingertip";
    EXPECT_EQ(scales[1], 0) << "elbow";
    EXPECT_EQ(scales[2], 0) << "the other hand";
    EXPECT_NEAR(scales[3], 0.5, 1e-9) << "wrist";
}

}  // namespace
}  // namespace garmentfit
