// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/cloth.h"

#include <gtest/gtest.h>

#include "garmentfit/error.h"

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
    ASSERT_EQ(fabric_names().size(), 11u);
    EXPECT_EQ(fabric_names()[static_cast<int>(Fabric::tulle)], "tulle");
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
TEST(Cloth, LetsAGarmentBeStretchedAsFarAsItsFabricGives)
{
    EXPECT_EQ(material_of({}).largest_stretch, 0.15);
    EXPECT_GT(material_of(cloth_of(Fabric::swimwear)).largest_stretch, material_of(Fabric::jersey).largest_stretch);
    ClothOptions options = cloth_of(Fabric::swimwear);
    options.largest_stretch = 0.1;
    EXPECT_EQ(material_of(options).largest_stretch, 0.1);
    for (std::size_t f = 0; f < fabric_names().size(); ++f)
        EXPECT_GE(material_of(Fabric(f)).strain_limit, material_of(Fabric(f)).largest_stretch) << fabric_names()[f];
}

TEST(Cloth, FindsTheFabricThatGivesJustEnough)
{
    EXPECT_EQ(fabric_that_gives(0.27, 0.15), Fabric::jersey);
    EXPECT_EQ(fabric_that_gives(0.05, 0.15), Fabric::fleece) << "less is needed, but the present one did not do";
    EXPECT_FALSE(fabric_that_gives(0.9, 0.15));
}

TEST(Cloth, IsNamed)
{
    EXPECT_EQ(fabric_of("rib"), Fabric::rib);
    EXPECT_THROW(fabric_of("paper"), InvalidInput);
}

TEST(Cloth, KeepsAFigureOfCottonOnAnotherFabric)
{
    ClothOptions options = cloth_of(Fabric::denim);
    options.density = material_of(cloth_of(Fabric::cotton)).density;
    EXPECT_EQ(material_of(options).density, material_of(cloth_of(Fabric::cotton)).density);
    EXPECT_NE(material_of(options).density, material_of(cloth_of(Fabric::denim)).density);
}

}  // namespace
