// SPDX-License-Identifier: GPL-3.0-or-later
#include "crowding.h"

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

GarmentMesh flat(int n, double spacing)
{
    const TriangleMesh mesh = sheet(n, spacing, [](double, double) { return 0; });
    return make_garment(mesh.positions, mesh.triangles);
}

TEST(Crowding, OfEvenClothIsNextToNoneHoweverFineItIs)
{
    for (const double spacing : { 0.02, 0.005, 0.001 })
        EXPECT_LT(crowding(flat(40, spacing)), 0.5) << spacing;
}

TEST(Crowding, GrowsWithDetailsWhoseEdgesAreFarShorter)
{
    const GarmentMesh cloth = flat(40, 0.01), detail = flat(20, 2e-4);
    const TriangleMesh both = joined({ cloth.positions, cloth.triangles }, { detail.positions, detail.triangles });
    EXPECT_GT(crowding(make_garment(both.positions, both.triangles)), 20);
}

TEST(Crowding, OfNothingIsNone) { EXPECT_EQ(crowding({}), 0); }

}  // namespace
