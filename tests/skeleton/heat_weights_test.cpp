// SPDX-License-Identifier: GPL-3.0-or-later
#include "heat_weights.h"

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;

VisibleBones all_bones(Eigen::Index vertices)
{
    std::array<bool, bone_count> all;
    all.fill(true);
    return VisibleBones(std::size_t(vertices), all);
}

TEST(HeatWeights, TrianglesWithoutAreaDoNotKeepTheRestFromItsWeights)
{
    const fixtures::Person person = fixtures::capsule_person();
    const Eigen::Index n = person.mesh.positions.rows();
    const Eigen::MatrixXd whole = heat_weights(person.mesh, person.skeleton, all_bones(n));
    TriangleMesh mesh = person.mesh;
    mesh.positions.row(mesh.triangles(0, 1)) = mesh.positions.row(mesh.triangles(0, 0));
    const Eigen::MatrixXd weights = heat_weights(mesh, person.skeleton, all_bones(n));
    EXPECT_TRUE(weights.allFinite());
    EXPECT_LT((weights.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-9);
    for (Eigen::Index v = 0; v < n; ++v)
        if ((person.mesh.positions.row(v) - mesh.positions.row(mesh.triangles(0, 0))).norm() > 0.3) {
            EXPECT_LT((weights.row(v) - whole.row(v)).cwiseAbs().maxCoeff(), 0.02) << v;
        }
}

TEST(HeatWeights, APartOfTrianglesWithoutAreaHasWeightsToo)
{
    const fixtures::Person person = fixtures::capsule_person();
    const Eigen::Index n = person.mesh.positions.rows(), faces = person.mesh.triangles.rows();
    TriangleMesh mesh = person.mesh;
    mesh.positions.conservativeResize(n + 4, 3);
    for (int k = 0; k < 4; ++k)
        mesh.positions.row(n + k) = mesh.positions.row(0) + Eigen::RowVector3d(0.01 * k, 0, 0);
    mesh.triangles.conservativeResize(faces + 2, 3);
    mesh.triangles.bottomRows(2) << int(n), int(n) + 1, int(n) + 2, int(n) + 1, int(n) + 3, int(n) + 2;
    const Eigen::MatrixXd weights = heat_weights(mesh, person.skeleton, all_bones(n + 4));
    EXPECT_TRUE(weights.allFinite());
    EXPECT_LT((weights.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-9);
}

}  // namespace
