// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Of the pairs near contact those that say something of their own.

#include <vector>

#include "contact.h"

namespace garmentfit {

/// How many vertices of a primitive its closest point lies between: 1 at a corner, 3 inside of a triangle.
int vertices_at(const ContactPair& pair, int begin, int end);

/// Near a vertex that slides over a surface there are several triangles. Those beside the one below it are near, too, at
/// their borders, and in a direction that is tilted against its way: linear contacts with them would slow it down. A
/// contact at the end of an edge is one of the vertex there.
struct DistinctContacts {
    std::vector<ContactPair> distinct;
    std::vector<ContactPair> repeated;  ///< those that are left out, of which each can stop motion all the same
};
DistinctContacts distinct_contacts(const std::vector<ContactPair>& pairs, const Positions& x);

}  // namespace garmentfit
