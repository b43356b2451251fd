// SPDX-License-Identifier: GPL-3.0-or-later
#include "disjoint_sets.h"

#include <gtest/gtest.h>

namespace garmentfit {
namespace {

TEST(DisjointSets, GroupsFollowTheirFirstMembers)
{
    DisjointSets sets(6);
    sets.join(4, 1);
    sets.join(5, 2);
    sets.join(1, 0);
    const std::vector<std::vector<int>> groups { { 0, 1, 4 }, { 2, 5 }, { 3 } };
    EXPECT_EQ(sets.groups(), groups);
}

TEST(DisjointSets, NothingHasNoGroups) { EXPECT_TRUE(DisjointSets(0).groups().empty()); }

}  // namespace
}  // namespace garmentfit
