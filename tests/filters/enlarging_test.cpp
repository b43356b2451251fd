// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "garmentfit/filters/outcome.h"
#include "stages.h"

namespace {

using namespace garmentfit;

/// One garment that is worn, and lacks girth in the end.
Scene tight_scene(double size, double missing)
{
    Scene scene;
    scene.garments.resize(1);
    scene.recovered.emplace();
    Dressing& end = *scene.recovered;
    end.garments.resize(1);
    end.garments[0].positions.setZero(3, 3);
    end.garments[0].size = size;
    end.fabric_stretches = { 0.2 };
    end.too_tight = { { 0, "hips", 0.1, missing } };
    return scene;
}

TEST(Enlarging, AGarmentThatIsTooSmallInTheEndIsEnlargedWhereThatIsAllowed)
{
    Parameters parameters;
    Scene scene = tight_scene(1.1, 0.4);
    ASSERT_EQ(outcome_of(*final_dressing(scene)), Outcome::too_small);
    EXPECT_FALSE(enlarge_too_small(scene, parameters));
    parameters.drape.cloth.largest_enlargement = 0.35;
    EXPECT_FALSE(enlarge_too_small(scene, parameters)) << "not by 40 %";
    EXPECT_EQ(scene.garments[0].size, 1);
    parameters.drape.cloth.largest_enlargement = 0.5;
    EXPECT_TRUE(enlarge_too_small(scene, parameters));
    EXPECT_NEAR(scene.garments[0].size, 1.4, 1e-9) << "half of what its fabric gives is left to it";

    Scene not_put_on = tight_scene(1, 0.1);
    not_put_on.recovered->scale_reached = 0.8;
    EXPECT_FALSE(enlarge_too_small(not_put_on, parameters)) << "draping did that already";
    Scene fits = tight_scene(1, 0.1);
    fits.recovered->too_tight.clear();
    EXPECT_FALSE(enlarge_too_small(fits, parameters));
}

}  // namespace
