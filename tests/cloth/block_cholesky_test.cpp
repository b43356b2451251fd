// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "block_cholesky.h"
#include "fixtures.h"
#include "topology.h"

// The sparse factor of 3 x 3 blocks, against Eigen's dense one.

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

/// A symmetric block that differs from pair to pair.
Eigen::Matrix3d block_of(int i, int j)
{
    const Vec3 a(0.3 + std::min(i, j) % 5, 1, -0.2), b(std::max(i, j) % 7, 0.5, 1);
    return 0.05 * (a * b.transpose() + b * a.transpose());
}

struct System {
    int count;
    std::vector<std::pair<int, int>> pairs;
    BlockCholesky sparse { count, pairs };
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * count, 3 * count);

    void set(int i, int j, const Eigen::Matrix3d& block)
    {
        *sparse.find(i, j) = block;
        dense.block<3, 3>(3 * i, 3 * j) = dense.block<3, 3>(3 * j, 3 * i) = block;
    }
    void fill(double diagonal)
    {
        for (const auto& [i, j] : pairs)
            set(i, j, block_of(i, j));
        for (int v = 0; v < count; ++v)
            set(v, v, (diagonal + v % 3) * Eigen::Matrix3d::Identity());
    }
};

System sheet_and_loose_rows()
{
    const TriangleMesh mesh = flat(24, 1, Vec3::Zero());
    const int vertices = int(mesh.positions.rows());
    std::vector<std::pair<int, int>> pairs;
    const Edges edges = MeshTopology(mesh.triangles, vertices).edges();
    for (Eigen::Index e = 0; e < edges.rows(); ++e)
        pairs.emplace_back(edges(e, 0), edges(e, 1));
    pairs.emplace_back(vertices + 1, vertices);  // a second component, one pair twice, and a row without any
    pairs.emplace_back(vertices, vertices + 1);
    pairs.emplace_back(0, vertices - 1);
    return { vertices + 3, pairs };
}

Positions some_forces(int rows)
{
    Positions result(rows, 3);
    for (int i = 0; i < rows; ++i)
        result.row(i) << std::sin(i), std::cos(3 * i), i % 11 - 5;
    return result;
}

double largest_error(const System& system, const Positions& solution, const Positions& forces)
{
    Eigen::VectorXd x(solution.size()), f(forces.size());
    for (int i = 0; i < system.count; ++i) {
        x.segment<3>(3 * i) = solution.row(i).transpose();
        f.segment<3>(3 * i) = forces.row(i).transpose();
    }
    return (system.dense * x - f).cwiseAbs().maxCoeff();
}

TEST(BlockCholesky, SolvesAsADenseMatrixDoes)
{
    System system = sheet_and_loose_rows();
    const Positions forces = some_forces(system.count);
    for (const double diagonal : { 20.0, 35.0 }) {  // factorised anew with other numbers
        system.sparse.set_zero();
        system.fill(diagonal);
        ASSERT_TRUE(system.sparse.factorise());
        EXPECT_LT(largest_error(system, system.sparse.solve(forces), forces), 1e-4);
    }
}

TEST(BlockCholesky, HasNoBlockForOtherPairs)
{
    System system = sheet_and_loose_rows();
    EXPECT_EQ(system.sparse.find(0, system.count - 1), nullptr);
    EXPECT_EQ(system.sparse.find(3, 5), system.sparse.find(5, 3));
    EXPECT_NE(system.sparse.find(0, 0), nullptr);
}

TEST(BlockCholesky, SaysWhereAMatrixIsNotDefinite)
{
    System system = sheet_and_loose_rows();
    system.fill(20);
    EXPECT_TRUE(system.sparse.factorise());
    system.set(7, 7, -Eigen::Matrix3d::Identity());
    EXPECT_FALSE(system.sparse.factorise());
}

}  // namespace
