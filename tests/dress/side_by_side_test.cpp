// SPDX-License-Identifier: GPL-3.0-or-later
#include "side_by_side.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "fixtures.h"

namespace garmentfit {
namespace {

/// Two strips, 1 mm apart where edges are 4 mm long, but the same vertices along x.
TriangleMesh two_sheets(int n)
{
    const auto at = [](double height) { return [height](double, double) { return height; }; };
    return fixtures::joined(fixtures::sheet(n, 0.004, at(0)), fixtures::sheet(n, 0.004, at(0.001)));
}

struct Sheets {
    TriangleMesh mesh;
    MeshTopology topology;
    SideBySide beside;

    explicit Sheets(int n) :
        mesh(two_sheets(n)), topology(mesh.triangles, int(mesh.positions.rows())),
        beside(mesh.positions, topology, mesh.positions)
    {
    }
};

TEST(SideBySide, SpreadsMarksOverEdgesAndToTheSheetBeside)
{
    constexpr int n = 9, middle = n * n / 2;
    const Sheets sheets(n);
    std::vector<char> marks(2 * n * n, 0);
    marks[middle] = 1;
    sheets.beside.spread(marks, 1);
    EXPECT_EQ(std::count(marks.begin(), marks.end(), 1), 1 + 6 + 1) << "itself, its neighbours, and the one above";
    EXPECT_TRUE(marks[n * n + middle]);
    sheets.beside.spread(marks, 3);
    EXPECT_TRUE(marks[middle + 4] && marks[n * n + middle + 3]);
    EXPECT_FALSE(marks[n * n + middle + 4]) << "four links away and one up";
}

TEST(SideBySide, EvensAFieldBetweenWhatIsNotMarked)
{
    constexpr int n = 9, middle = n * n / 2;
    const Sheets sheets(n);
    Eigen::MatrixXd along = sheets.mesh.positions.leftCols(1);
    std::vector<char> marks(2 * n * n, 0);
    marks[middle] = 1;
    sheets.beside.spread(marks, 2);
    Eigen::MatrixXd noisy = along;
    for (int v = 0; v < 2 * n * n; ++v)
        if (marks[v])
            noisy(v) += 0.01 * std::sin(7 * v);
    const Eigen::MatrixXd evened = sheets.beside.evened(noisy, marks, 0);
    EXPECT_LT((evened - along).cwiseAbs().maxCoeff(), 1e-12) << "what grows evenly is harmonic";
}

TEST(SideBySide, KeepsWhatAllIsMarkedOfByItsHold)
{
    const Sheets sheets(5);
    const Eigen::MatrixXd field = Eigen::MatrixXd::Constant(50, 2, 3);
    const Eigen::MatrixXd evened = sheets.beside.evened(field, std::vector<char>(50, 1), 1e-3);
    EXPECT_LT((evened - field).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace garmentfit
