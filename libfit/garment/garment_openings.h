// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The openings of a garment, and the tubes that lead to them.

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

struct Opening {
    Vec3 centre = Vec3::Zero();
    Vec3 facing = Vec3::Zero();  ///< unit, outwards: mean normal of a disc that closes it
    Vec3 low, high;  ///< corners of its bounding box
    double girth = 0;  ///< m, length of its edge
    double roundness = 0;  ///< area of a disc that closes it over that of a circle of this girth
    double tube_length = 0;  ///< m along the cloth from the opening to where the tube widens, forks or ends
    Vec3 tube_end = Vec3::Zero();  ///< centroid of its last slice
    double tube_girth = 0;  ///< m, median of its slices
    double tube_waist = 0;  ///< m, smallest of its slices without the hem
    Positions rim;  ///< vertices of its edge
    Positions rim_next;  ///< the vertex after each of them along the edge of the cloth
    int piece = 0;  ///< number of the connected piece of cloth
    double piece_low = 0;  ///< m, lowest y of the piece
    double piece_height = 0;  ///< m, of the piece
};

/// Finds openings larger than buttonholes and measures their tubes. Holes and slits are none: they are narrow for an
/// armhole or a neck, and no tube leads to them as to a cuff.
/// @param outward  from outward_cloth
/// Cost: one shortest-path search over the edges for each opening, two for narrow ones.
std::vector<Opening> openings_of(const TriangleMesh& outward);
/// How many these are.
std::size_t count_openings(const TriangleMesh& outward);

/// Rotates openings with their garment, without measuring again. @param cloth  the rotated garment
std::vector<Opening> rotate(std::vector<Opening> openings, const TriangleMesh& cloth, const Eigen::Quaterniond& turn);

/// Whether the normals of two openings are mirror images in a plane across `axis`, unit.
bool face_alike(const Opening& a, const Opening& b, const Vec3& axis);

/// Whether no edge is open and the genus is 0, as of a sphere. A garment with thickness has no open edge either, but
/// its genus is larger.
bool is_sealed(const TriangleMesh& outward);

/// The vertices of a connected piece. @param piece  Opening::piece
Positions positions_of_piece(const TriangleMesh& outward, int piece);

struct Pieces {
    int count = 0;
    double largest = 0;  ///< m, longest side of the bounding box of the largest piece
};
/// Counts connected pieces.
Pieces count_pieces(const TriangleMesh& outward);

}  // namespace garmentfit
