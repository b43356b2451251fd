// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a garment lets a body out: its openings, and the tubes that lead to them.

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

struct Opening {
    Vec3 centre = Vec3::Zero();
    Vec3 facing = Vec3::Zero();  ///< unit, out of the garment: the mean normal of the disc that would close it
    Vec3 low, high;  ///< corners of its box
    double girth = 0;  ///< m, length of its edge
    double tube_length = 0;  ///< m along the cloth, until the tube widens, forks or ends
    Vec3 tube_end = Vec3::Zero();  ///< the middle of its last slice
    double tube_girth = 0;  ///< m, median
    double tube_waist = 0;  ///< m, smallest, the hem itself left out
    Positions rim;  ///< along its edge
    int piece = 0;  ///< openings of one connected piece of cloth share it
    double piece_low = 0;  ///< m; where that piece begins
    double piece_height = 0;  ///< m, of that piece
};

/// @param outward  from outward_cloth. Holes as small as buttonholes are left out.
/// Cost: one shortest-path search over the edges for each opening.
std::vector<Opening> openings_of(const TriangleMesh& outward);

/// The same when the garment is turned: nothing is measured again. @param cloth  the garment turned
std::vector<Opening> turned(std::vector<Opening> openings, const TriangleMesh& cloth, const Eigen::Quaterniond& turn);

/// Do two openings face like mirror images in a plane across `axis`, unit?
bool face_alike(const Opening& a, const Opening& b, const Vec3& axis);

/// Closed like a ball: no edge is open, and no hole goes through. (A garment with thickness has no open edge either, but
/// holes: its genus is above 0.)
bool is_sealed(const TriangleMesh& outward);

struct Pieces {
    int count = 0;
    double largest = 0;  ///< m, the longest side of the largest one's box
};
Pieces pieces_in(const TriangleMesh& outward);

}  // namespace garmentfit
