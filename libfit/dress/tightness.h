// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How far a garment is stretched round each part of a body, and how much girth it lacks there.

#include <array>
#include <vector>

#include "body_parts.h"
#include "garmentfit/drape_garment.h"

namespace garmentfit {

using PerPart = std::array<double, k_body_parts>;

/// Follows one garment on one body, in one pose.
class Tightness {
public:
    /// @param weights   skin weights of the garment's vertices
    /// @param skeleton  in the pose of the garment
    /// @param index     of the garment, from the inside out
    Tightness(const GarmentMesh& garment, const SkinWeights& weights, const Skeleton& skeleton, int index = 0);

    /// The largest mean stretch round a part of the body, dimensionless; 0 = nowhere stretched.
    double largest_stretch(const Positions& positions) const;

    /// Parts stretched beyond `allowed`, worst first, on a body that has not grown to its full size yet.
    /// @param growth  by how much its girth under the cloth still has to grow, from growth_left
    std::vector<TooTight> too_tight(const Positions& positions, double allowed, const PerPart& growth) const;

    /// For cloth at rest on a body of full size. When as a whole more than a twentieth of it is stretched beyond `allowed`, the
    /// parts it is stretched round by that much at their tightest places count, too.
    std::vector<TooTight> too_tight_at_rest(const Positions& positions, double allowed) const;

private:
    struct Round {
        int part;
        double stretch;  // mean over the edges that run round the part
        double tightest;  // a twentieth of these edges is stretched more than this
        double girth;  // m, of the cloth as it is now
    };
    std::vector<Round> rounds(const Positions& positions) const;
    TooTight missing(const Round& round, double stretch, double growth) const;

    GarmentMesh garment_;
    Skeleton skeleton_;
    int index_;
    std::vector<int> bones_;  // of each garment vertex, the one it follows most
};

/// By how much of the body's girth a garment that lies on it is wider, round each part: 0.1 = by a tenth, 0 where there is no cloth.
/// @param cloth, body  n x 3 and m x 3, metres, in the skeleton's pose
PerPart slack(const Positions& cloth, const Positions& body, const SkinWeights& weights, const Skeleton& skeleton);

/// By how much the girth under a garment still has to grow until a body is of full size, round each part; 0 where there is no cloth.
/// @param cloth, body, full  n x 3, and m x 3 each, metres, in the skeleton's pose
PerPart growth_left(const Positions& cloth, const Positions& body, const Positions& full, const SkinWeights& weights,
                    const Skeleton& skeleton);

}  // namespace garmentfit
