// SPDX-License-Identifier: GPL-3.0-or-later
#include "creases.h"

#include <gtest/gtest.h>

#include <cmath>

namespace garmentfit {
namespace {

constexpr double k_top = 0.5, k_bottom = 0.4;  // m, of a slit 6 mm wide along z
constexpr int k_rows = 41;
constexpr double k_row = 0.05;

/// A table of 2 m with a slit across it.
TriangleMesh table_with_slit()
{
    std::vector<Vec3> profile;
    for (double x = -1; x < -0.01; x += k_row)
        profile.emplace_back(x, k_top, 0);
    for (double y = k_top; y > k_bottom - 0.001; y -= 0.02)
        profile.emplace_back(-0.003, y, 0);
    for (int i = int(profile.size()); i-- > 0;)
        profile.emplace_back(-profile[i].x(), profile[i].y(), 0);

    const int columns = int(profile.size());
    TriangleMesh mesh { Positions(k_rows * columns, 3), Triangles(2 * (k_rows - 1) * (columns - 1), 3) };
    Eigen::Index face = 0;
    for (int row = 0; row < k_rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const int v = row * columns + column;
            mesh.positions.row(v) = profile[column] + k_row * row * Vec3::UnitZ();
            if (row + 1 < k_rows && column + 1 < columns) {
                mesh.triangles.row(face++) << v, v + columns, v + 1;
                mesh.triangles.row(face++) << v + 1, v + columns, v + columns + 1;
            }
        }
    return mesh;
}

std::vector<char> all_of(const TriangleMesh& mesh, char near) { return std::vector<char>(mesh.positions.rows(), near); }

TEST(Creases, AreBridgedAcrossTheirBoundary)
{
    const TriangleMesh table = table_with_slit();
    const Positions bridged = Creases(table, all_of(table, 1)).bridged_surface();
    for (Eigen::Index v = 0; v < bridged.rows(); ++v) {
        EXPECT_GT(bridged(v, 1), k_top - 0.01) << "vertex " << v << " hangs in the slit";
        if (std::abs(table.positions(v, 0)) > 0.02) {
            EXPECT_EQ(bridged.row(v), table.positions.row(v)) << "vertex " << v << " is beside the slit";
        }
    }
}

TEST(Creases, WithoutClothNearThemAreLeftAlone)
{
    const TriangleMesh table = table_with_slit();
    EXPECT_EQ(Creases(table, all_of(table, 0)).bridged_surface(), table.positions);
}

TEST(Creases, WithdrawHalfwayToTheCore)
{
    const TriangleMesh table = table_with_slit();
    const Positions core = Positions::Zero(table.positions.rows(), 3);
    const Positions withdrawn = Creases(table, all_of(table, 1)).withdrawn_surface(core);
    for (Eigen::Index v = 0; v < withdrawn.rows(); ++v) {
        const double share = table.positions(v, 1) < k_top ? 0.5 : 1;
        if (share < 1 || std::abs(table.positions(v, 0)) > 0.02) {
            EXPECT_EQ(withdrawn.row(v), share * table.positions.row(v));
        }
    }
}

TEST(Creases, OfSmoothSkinAreNone)
{
    TriangleMesh table = table_with_slit();
    table.positions.col(1).setConstant(k_top);
    for (Eigen::Index v = 0; v < table.positions.rows(); ++v)
        table.positions(v, 1) += 0.05 * std::cos(10 * table.positions(v, 2));  // hollows of 20 cm radius
    EXPECT_EQ(Creases(table, all_of(table, 1)).bridged_surface(), table.positions);
}

}  // namespace
}  // namespace garmentfit
