// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/skeleton.h"

#include <gtest/gtest.h>

namespace {

using namespace fit;

TEST(Skeleton, EveryBoneFollowsItsParentAndHasAMirror)
{
    for (int b = 0; b < bone_count; ++b) {
        EXPECT_LT(parent_of(b), b);
        EXPECT_EQ(mirror_of(mirror_of(b)), b);
        EXPECT_EQ(bone_of(bone_name(b)), b);
    }
    EXPECT_EQ(bone_of("tail"), -1);
}

}  // namespace
