// SPDX-License-Identifier: GPL-3.0-or-later
#include "creases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

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

/// The surface of those cells of a grid that are solid.
TriangleMesh surface_of_cells(const std::array<std::vector<double>, 3>& lines,
                              const std::function<bool(const Vec3&)>& is_solid)
{
    const auto solid_at = [&](const std::array<int, 3>& cell) {
        Vec3 centre;
        for (int k = 0; k < 3; ++k) {
            if (cell[k] < 0 || cell[k] + 1 >= int(lines[k].size()))
                return false;
            centre[k] = (lines[k][cell[k]] + lines[k][cell[k] + 1]) / 2;
        }
        return is_solid(centre);
    };
    std::map<std::array<int, 3>, int> vertices;
    std::vector<std::array<int, 3>> faces;
    const auto vertex = [&](const std::array<int, 3>& corner) {
        return vertices.try_emplace(corner, int(vertices.size())).first->second;
    };
    std::array<int, 3> cell {};
    for (cell[0] = 0; cell[0] < int(lines[0].size()); ++cell[0])
        for (cell[1] = 0; cell[1] < int(lines[1].size()); ++cell[1])
            for (cell[2] = 0; cell[2] < int(lines[2].size()); ++cell[2])
                for (int k = 0; k < 3; ++k) {  // the face between this cell and the one before it along an axis
                    std::array<int, 3> before = cell;
                    --before[k];
                    const bool solid = solid_at(cell);
                    if (solid == solid_at(before))
                        continue;
                    std::array<int, 3> b = cell, c = cell, d = cell;
                    ++b[(k + 1) % 3];
                    ++c[(k + 1) % 3], ++c[(k + 2) % 3];
                    ++d[(k + 2) % 3];
                    std::array<int, 4> corners { vertex(cell), vertex(b), vertex(c), vertex(d) };
                    if (solid)
                        std::reverse(corners.begin(), corners.end());
                    faces.push_back({ corners[0], corners[1], corners[2] });
                    faces.push_back({ corners[0], corners[2], corners[3] });
                }
    TriangleMesh mesh { Positions(Eigen::Index(vertices.size()), 3), Triangles(Eigen::Index(faces.size()), 3) };
    for (const auto& [corner, v] : vertices)
        mesh.positions.row(v) << lines[0][corner[0]], lines[1][corner[1]], lines[2][corner[2]];
    for (std::size_t f = 0; f < faces.size(); ++f)
        mesh.triangles.row(Eigen::Index(f)) << faces[f][0], faces[f][1], faces[f][2];
    return mesh;
}

constexpr double k_crotch = 0.14, k_half_depth = 0.06;  // m

/// Two legs side by side, 6 mm apart: the slit between them is deeper than its front is far from its back.
TriangleMesh legs_side_by_side()
{
    std::vector<double> across { -0.15, -0.12, -0.09, -0.06, -0.03, -0.003, 0.003, 0.03, 0.06, 0.09, 0.12, 0.15 };
    std::vector<double> up, along;
    for (int i = 0; i <= 12; ++i)
        up.push_back(0.02 * i);
    for (int i = 0; i <= 6; ++i)
        along.push_back(0.02 * i - k_half_depth);
    return surface_of_cells({ across, up, along },
                            [](const Vec3& at) { return std::abs(at.x()) > 0.003 || at.y() > k_crotch; });
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

TEST(Creases, BetweenLegsAreBridgedWhereTheyEndBelow)
{
    const TriangleMesh legs = legs_side_by_side();
    const Positions bridged = Creases(legs, all_of(legs, 1)).bridged_surface();
    int inner = 0;
    for (Eigen::Index v = 0; v < bridged.rows(); ++v) {
        const Vec3 place = legs.positions.row(v);
        if (std::abs(place.x()) > 0.01 || place.y() > k_crotch || std::abs(place.z()) > 0.6 * k_half_depth)
            continue;
        ++inner;
        EXPECT_LT(bridged(v, 1), 0.03) << "cloth may stay above " << place.transpose();
        EXPECT_GE(bridged(v, 0) * place.x(), 0) << "the legs changed sides at " << place.transpose();
    }
    EXPECT_GE(inner, 30);
}

TEST(Creases, BetweenLegsAreBridgedAtTheirSidesWhereTheNearestEndIsAskedFor)
{
    const TriangleMesh legs = legs_side_by_side();
    const Positions bridged = Creases(legs, all_of(legs, 1), BridgeEnds::nearest).bridged_surface();
    int inner = 0;
    for (Eigen::Index v = 0; v < bridged.rows(); ++v) {
        const Vec3 place = legs.positions.row(v);
        if (std::abs(place.x()) > 0.01 || place.y() < 0.75 * k_crotch || place.y() > 0.9 * k_crotch
            || std::abs(place.z()) < 0.3 * k_half_depth)
            continue;
        ++inner;
        EXPECT_GT(std::abs(bridged(v, 2)), 0.8 * k_half_depth)
            << "the bridge does not end beside " << place.transpose();
    }
    EXPECT_GE(inner, 8);
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
