// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "distinct_contacts.h"

// Contacts that say something of their own, and those that only repeat others.

namespace {

using namespace garmentfit;

ContactPair pair_at(PairKind kind, const std::array<int, 4>& vertices, const Positions& x)
{
    return { kind, ContactReason::self, vertices, closest_points(kind, corners_of(x, vertices)) };
}

TEST(DistinctContacts, AVertexTouchesTheNearestOfNeighbouringTriangles)
{
    Positions x(5, 3);  // two triangles on a common edge, and a vertex above the first
    x << 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1, 0.2, 0.1, 0.2;
    const auto on_first = pair_at(PairKind::vertex_face, { 4, 0, 1, 2 }, x),
               on_second = pair_at(PairKind::vertex_face, { 4, 1, 3, 2 }, x);
    const DistinctContacts contacts = distinct_contacts({ on_second, on_first }, x);
    ASSERT_EQ(contacts.distinct.size(), 1u);
    EXPECT_EQ(contacts.distinct[0].vertices, on_first.vertices);
    ASSERT_EQ(contacts.repeated.size(), 1u);
    EXPECT_EQ(contacts.repeated[0].vertices, on_second.vertices);
}

TEST(DistinctContacts, EdgesThatAreParallelOrMeetAtAnEndRepeatContactsOfVertices)
{
    Positions x(8, 3);  // edges along x, a parallel one, a crossing one, and one that begins above the first
    x << 0, 0, 0, 1, 0, 0, 0, 0.1, 0, 1, 0.1, 0.01, 0.5, 0.1, -0.5, 0.5, 0.1, 0.5, 0.5, 0.1, 0, 0.5, 1, 0.3;
    const auto parallel = pair_at(PairKind::edge_edge, { 0, 1, 2, 3 }, x),
               crossing = pair_at(PairKind::edge_edge, { 0, 1, 4, 5 }, x),
               at_an_end = pair_at(PairKind::edge_edge, { 0, 1, 6, 7 }, x);
    const DistinctContacts contacts = distinct_contacts({ parallel, crossing, at_an_end }, x);
    ASSERT_EQ(contacts.distinct.size(), 1u);
    EXPECT_EQ(contacts.distinct[0].vertices, crossing.vertices);
    ASSERT_EQ(contacts.repeated.size(), 2u) << "none is lost: each can stop motion";
}

}  // namespace
