// SPDX-License-Identifier: GPL-3.0-or-later
#include "skin_transfer.h"

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

constexpr int k_side = 21;  // vertices

/// 20 by 20 cm, with a bump in the middle.
TriangleMesh skin_with_bump(double base, double height)
{
    return sheet(k_side, 0.01,
                 [=](double x, double z) { return base + (std::hypot(x - 0.1, z - 0.1) < 0.035 ? height : 0); });
}

/// Two sheets of skin 3 cm apart that face the same way, each with all weight on one bone.
struct TwoSheets {
    TriangleMesh mesh = joined(skin_with_bump(0, 0), skin_with_bump(0.03, 0));
    Eigen::MatrixXd weights;

    TwoSheets(int lower, int upper) : weights(Eigen::MatrixXd::Zero(mesh.positions.rows(), bone_count))
    {
        weights.topRows(k_side * k_side).col(lower).setOnes();
        weights.bottomRows(k_side * k_side).col(upper).setOnes();
    }
};

SkinWeights transfer_to(const TriangleMesh& surface, const TwoSheets& from)
{
    return transfer_skin_weights(from.mesh, from.weights, { surface, surface, false });
}

TEST(SkinTransfer, SkinThatTouchesOtherSkinGetsTheBoneOfItsNeighbours)
{
    const SkinWeights transferred = transfer_to(skin_with_bump(0, 0.028), TwoSheets(lradius, rradius));
    for (Eigen::Index v = 0; v < transferred.bones.rows(); ++v) {
        EXPECT_EQ(transferred.bones(v, 0), lradius);
        EXPECT_NEAR(transferred.weights(v, 0), 1, 1e-12);
    }
}

/// A vertex for each corner of each triangle.
TriangleMesh with_hard_edges(const TriangleMesh& mesh)
{
    TriangleMesh hard { Positions(3 * mesh.triangles.rows(), 3), Triangles(mesh.triangles.rows(), 3) };
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            hard.triangles(f, k) = int(3 * f) + k;
            hard.positions.row(3 * f + k) = mesh.positions.row(mesh.triangles(f, k));
        }
    return hard;
}

TEST(SkinTransfer, HardEdgesAreNoCutsInTheSkin)
{
    const TwoSheets from(lradius, rradius);
    const TriangleMesh skin = skin_with_bump(0, 0.028);
    const SkinWeights transferred
        = transfer_skin_weights(from.mesh, from.weights, { with_hard_edges(skin), skin, true });
    for (Eigen::Index v = 0; v < transferred.bones.rows(); ++v)
        EXPECT_EQ(transferred.bones(v, 0), lradius) << v;
}

/// A prism with an edge from 0 to +z, that is as wide at x as x is from there.
TriangleMesh wedge(double x)
{
    TriangleMesh mesh { Positions(6, 3), Triangles(8, 3) };
    mesh.positions << 0, 0, 0, 0, 0, 1, x, -0.5, 0, x, 0.5, 0, x, 0.5, 1, x, -0.5, 1;
    mesh.triangles << 0, 3, 2, 1, 5, 4, 0, 2, 5, 0, 5, 1, 0, 1, 4, 0, 4, 3, 2, 3, 4, 2, 4, 5;
    return mesh;
}

TEST(SkinTransfer, ShellsThatTouchAtAnEdgeKeepTheirOwnBones)
{
    const TriangleMesh shells = joined(wedge(-1), wedge(1));
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(12, bone_count);
    weights.topRows(6).col(rradius).setOnes();
    weights.bottomRows(6).col(lradius).setOnes();
    const TriangleMesh hard = with_hard_edges(shells);
    const SkinWeights transferred = transfer_skin_weights(shells, weights, { hard, shells, true });
    for (Eigen::Index v = 0; v < transferred.bones.rows(); ++v)
        if (const double x = hard.positions(v, 0); x != 0) {
            EXPECT_EQ(transferred.bones(v, 0), x < 0 ? rradius : lradius) << v;
        }
}

TEST(SkinTransfer, SkinThatTouchesTheNextBoneGetsIt)
{
    const SkinWeights transferred = transfer_to(skin_with_bump(0, 0.028), TwoSheets(lradius, lhumerus));
    EXPECT_EQ(transferred.bones(k_side * k_side / 2, 0), lhumerus);
    EXPECT_EQ(transferred.bones(0, 0), lradius);
}

TEST(SkinTransfer, WeightsAtAProxyVertexAreThatVertexs)
{
    const TwoSheets from(lfemur, rfemur);
    const SkinWeights transferred = transfer_to(from.mesh, from);
    for (Eigen::Index v = 0; v < transferred.bones.rows(); ++v)
        EXPECT_EQ(transferred.bones(v, 0), v < k_side * k_side ? lfemur : rfemur) << v;
}

TEST(SkinTransfer, APatchOfFarBonesIsStrayAndNamesTheBonesAroundIt)
{
    const TriangleMesh skin = skin_with_bump(0, 0.01);
    std::vector<int> bones(skin.positions.rows(), lradius);
    int raised = 0;
    for (Eigen::Index v = 0; v < skin.positions.rows(); ++v)
        if (skin.positions(v, 1) > 0.005) {
            bones[v] = thorax;
            ++raised;
        }
    const std::vector<StrayPatch> patches = stray_patches(skin.triangles, bones);
    ASSERT_EQ(patches.size(), 1u);
    EXPECT_EQ(int(patches[0].vertices.size()), raised);
    for (int bone = 0; bone < bone_count; ++bone)
        EXPECT_EQ(patches[0].near_bones[bone], bone == lradius || bone == lhumerus) << bone_name(bone);
}

TEST(SkinTransfer, NothingIsStrayWhereBonesFollowEachOther)
{
    const TriangleMesh skin = skin_with_bump(0, 0);
    std::vector<int> bones(skin.positions.rows());
    for (Eigen::Index v = 0; v < skin.positions.rows(); ++v)
        bones[v] = skin.positions(v, 0) < 0.07 ? lradius : skin.positions(v, 0) < 0.13 ? lhumerus : lclavicle;
    EXPECT_TRUE(stray_patches(skin.triangles, bones).empty());
}

}  // namespace
