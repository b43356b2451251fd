// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/cloth.h"

#include <gtest/gtest.h>

namespace {

using namespace garmentfit;

ClothOptions cloth_of(Fabric fabric)
{
    ClothOptions options;
    options.fabric = fabric;
    return options;
}

TEST(Cloth, EveryFabricHasFiguresOfItsOwn)
{
    ASSERT_EQ(fabric_names().size(), 5u);
    for (int a = 0; a < 5; ++a) {
        const Material material = material_of(cloth_of(Fabric(a)));
        EXPECT_GT(material.density, 0) << fabric_names()[a];
        for (int b = 0; b < a; ++b)
            EXPECT_NE(material.density, material_of(cloth_of(Fabric(b))).density)
                << fabric_names()[a] << ", " << fabric_names()[b];
    }
}

TEST(Cloth, IsCottonWhereNothingIsSaid)
{
    const Material material = material_of({}), cotton = material_of(cloth_of(Fabric::cotton));
    EXPECT_EQ(material.density, cotton.density);
    EXPECT_EQ(material.stretch_stiffness, cotton.stretch_stiffness);
    EXPECT_EQ(material.bend_stiffness, cotton.bend_stiffness);
    EXPECT_EQ(material.friction, cotton.friction);
}

TEST(Cloth, KeepsWhatTheUserSet)
{
    ClothOptions options = cloth_of(Fabric::denim);
    options.density = 0.33;
    EXPECT_EQ(material_of(options).density, 0.33);
    EXPECT_EQ(material_of(options).bend_stiffness, material_of(cloth_of(Fabric::denim)).bend_stiffness);
}

// A figure that happens to be cotton's is given like any other.
TEST(Cloth, KeepsAFigureOfCottonOnAnotherFabric)
{
    ClothOptions options = cloth_of(Fabric::denim);
    options.density = material_of(cloth_of(Fabric::cotton)).density;
    EXPECT_EQ(material_of(options).density, material_of(cloth_of(Fabric::cotton)).density);
    EXPECT_NE(material_of(options).density, material_of(cloth_of(Fabric::denim)).density);
}

}  // namespace
