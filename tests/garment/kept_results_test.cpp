// SPDX-License-Identifier: GPL-3.0-or-later
#include "kept_results.h"

#include <numbers>

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;

GarmentMesh ball(double radius)
{
    const TriangleMesh mesh = fixtures::polygonise([&](const Vec3& p) { return p.norm() - radius; },
                                                   Vec3::Constant(-0.5), Vec3::Constant(0.5), 0.1);
    return make_garment(mesh.positions, mesh.triangles);
}

class KeptResultsTest : public testing::Test {
protected:
    /// A wrap that is told from others by its place.
    TriangleMesh wrap(const GarmentMesh& garment)
    {
        return kept_.of(garment, [&] {
            ++made_;
            return TriangleMesh { garment.positions.topRows(3), garment.triangles.topRows(1) };
        });
    }

    KeptResults<TriangleMesh> kept_;
    int made_ = 0;
};

TEST_F(KeptResultsTest, OneWrapServesAGarmentInAnyPlaceSizeAndTurn)
{
    const GarmentMesh garment = ball(0.3);
    GarmentMesh moved = garment;
    const Eigen::AngleAxisd turn(std::numbers::pi / 2, Vec3(1, 2, 3).normalized());
    moved.positions
        = (100 * garment.positions * turn.toRotationMatrix().transpose()).rowwise() + Eigen::RowVector3d(4, 5, 6);
    wrap(garment);
    const TriangleMesh found = wrap(moved);
    EXPECT_EQ(made_, 1);
    EXPECT_LT((found.positions - moved.positions.topRows(3)).norm(), 1e-9);
}

TEST_F(KeptResultsTest, AnotherShapeOrOtherFacesHaveTheirOwn)
{
    const GarmentMesh garment = ball(0.3);
    GarmentMesh wider = garment, cut = garment;
    wider.positions.col(0) *= 1.001;
    cut.triangles = cut.triangles.topRows(20).eval();
    for (const GarmentMesh& one : { garment, wider, cut })
        wrap(one);
    EXPECT_EQ(made_, 3);
}

}  // namespace
