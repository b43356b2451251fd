// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/cloth.h"

#include <gtest/gtest.h>

namespace {

using namespace garmentfit;

TEST(Cloth, OfEveryFabricHasFiguresOfItsOwn)
{
    ASSERT_EQ(fabric_names().size(), 5u);
    for (int i = 0; i < 5; ++i) {
        ClothOptions options;
        options.fabric = Fabric(i);
        const ClothOptions made = apply_fabric(options);
        EXPECT_GT(made.density, 0) << fabric_names()[i];
        EXPECT_EQ(made.density == ClothOptions().density, Fabric(i) == Fabric::cotton) << fabric_names()[i];
    }
}

TEST(Cloth, OfCottonIsTheDefault)
{
    const ClothOptions made = apply_fabric({});
    EXPECT_EQ(made.density, ClothOptions().density);
    EXPECT_EQ(made.stretch_stiffness, ClothOptions().stretch_stiffness);
    EXPECT_EQ(made.bend_stiffness, ClothOptions().bend_stiffness);
    EXPECT_EQ(made.friction, ClothOptions().friction);
}

TEST(Cloth, KeepsWhatTheUserSet)
{
    ClothOptions options;
    options.fabric = Fabric::denim;
    options.density = 0.33;
    const ClothOptions made = apply_fabric(options);
    EXPECT_EQ(made.density, 0.33);
    EXPECT_GT(made.bend_stiffness, 2 * ClothOptions().bend_stiffness);
}

}  // namespace
