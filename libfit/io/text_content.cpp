// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_content.h"

#include "turned_normals.h"

namespace garmentfit {

std::string TextContent::bytes_with(const Positions& moved) const
{
    const Positions turned = turn_normals(normals, normal_corners, triangles, positions, moved);
    Rewriter rewriter(file.bytes);
    for (const Place& place : places) {
        const Vec3 before = (place.is_normal ? normals : positions).row(place.row);
        const Vec3 after = (place.is_normal ? turned : moved).row(place.row);
        if (before != after && before.allFinite())
            rewriter.replace(place.span, text_of(after));
    }
    return rewriter.finish();
}

double TextContent::against_faces() const { return share_against_faces(normals, normal_corners, triangles, positions); }

void TextContent::require_finite() const
{
    const Eigen::Index vertex = first_not_finite(*this);
    for (const Place& place : places)
        if (place.row == vertex && !place.is_normal)
            fail_not_finite(file, place.span);
}

}  // namespace garmentfit
