// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a garment's place in its file says of the body that it lies round.

#include <vector>

#include "garmentfit/types.h"
#include "nearest.h"
#include "winding_number.h"

namespace garmentfit {

/// Where the input body may stand in the garment's file: where it is, or on the same floor.
struct BodyPlace {
    Vec3 shift;  ///< m, of the body
    double inside_share;  ///< of the garment's vertices in it
    double near_share;  ///< of them near its skin; 0 where the file says no place
};

/// Files of avatars and their clothes have the floor or the pelvis at the origin: where body and garment do not come
/// from one file, one may have this and the other one that.
/// @param pelvis  its height, m
std::vector<Vec3> body_shifts(const Positions& body, double pelvis);

/// Some corners of its faces, evenly spread over the list: files hold vertices that no face uses.
Positions spread_corners(const TriangleMesh& garment);

/// A body's surface, for questions about many places.
class BodySurface {
public:
    explicit BodySurface(const TriangleMesh& body);

    /// @param corners  spread_corners of the garment
    /// @param is_known  the user says that the garment lies on the body, wherever the origin is
    BodyPlace place_of(const Positions& corners, const Vec3& shift, bool is_known) const;

private:
    double height_;
    TriangleTree skin_;
    WindingNumber winding_;
};

}  // namespace garmentfit
