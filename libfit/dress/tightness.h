// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Measures how far a garment is stretched round each part of a body, and how much girth it lacks there.
//
// Stretch is l / l0 - 1 of an edge, dimensionless. Girths are metres.

#include <array>
#include <vector>

#include "body_parts.h"
#include "garmentfit/drape_garment.h"
#include "topology.h"

namespace garmentfit {

using PerPart = std::array<double, k_body_parts>;

/// Follows one garment on one body, in one pose.
class Tightness {
public:
    /// @param edges     of the garment; must outlive this
    /// @param weights   skin weights of the garment's vertices
    /// @param skeleton  in the pose of the garment
    /// @param allowed   stretch that the fabric gives; round the neck it may be more, for necklines end in a rib, or open
    /// @param index     of the garment, from the inside out
    Tightness(const Positions& rest, const Edges& edges, const SkinWeights& weights, const Skeleton& skeleton,
              double allowed, int index = 0);

    /// From now on the rest shape is this: the same garment in another size.
    void set_rest(const Positions& rest) { rest_ = rest; }

    /// How many times as large the garment would have to be, for its mean stretch round each part of the body to be a
    /// share of what is allowed there; 0 where it goes round none.
    double needed_size(const Positions& positions, double share) const;

    /// Lists the parts stretched beyond a share of what is allowed, worst first, on a body below its full size. Without
    /// those that lack no girth, as something is caught there and draws the cloth further than the full body would.
    /// @param growth  by how much its girth under the cloth still has to grow, from growth_left
    std::vector<TooTight> list_tight_parts(const Positions& positions, double share, const PerPart& growth) const;

    /// The same for cloth at rest on a body of full size. When more than a twentieth of all edges, by their length, is
    /// stretched beyond what is allowed, a part also counts if a twentieth of the edges round it is.
    std::vector<TooTight> list_tight_parts_at_rest(const Positions& positions) const;

    struct PartStretch {
        int part;
        double mean;  ///< over the edges that run round the part
        double tightest;  ///< a twentieth of these edges, by their length, is stretched more than this
        double girth;  ///< m, of the cloth as it is now
    };
    /// The parts that the cloth goes round.
    std::vector<PartStretch> measure_parts(const Positions& positions) const;

private:
    double allowed_at(int part) const;
    TooTight missing_girth(const PartStretch& part, double stretch, double growth) const;

    Positions rest_;
    const Edges& edges_;
    Skeleton skeleton_;
    double allowed_, caught_;  // stretches; beyond caught_, an edge is no measure of girth
    int index_;
    std::vector<int> bones_;  // of each garment vertex, the one it follows most
};

/// By how much of the body's girth a garment that lies on it is wider, round each part: 0.1 = by a tenth, 0 where there
/// is no cloth.
/// @param cloth, body  n x 3 and m x 3, metres, in the skeleton's pose
PerPart slack(const Positions& cloth, const Positions& body, const SkinWeights& weights, const Skeleton& skeleton);

/// By how much the girth under a garment still has to grow until a body is of full size, round each part; 0 where there
/// is no cloth.
/// @param cloth, body, full  n x 3, and m x 3 each, metres, in the skeleton's pose
PerPart growth_left(const Positions& cloth, const Positions& body, const Positions& full, const SkinWeights& weights,
                    const Skeleton& skeleton);

}  // namespace garmentfit
