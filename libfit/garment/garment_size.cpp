// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/garment_size.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "outward_cloth.h"
#include "tuning.h"
#include "type_guess.h"
#include "used_vertices.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

constexpr int k_directions = 18;  // derived: ten degrees apart, a width errs by less than 1 %

struct Extents {
    double depth = 0, width = 0;  ///< m, the least extent in any level direction, and that at a right angle to it
};

/// A garment may be turned about the vertical.
Extents level_extents(const Positions& positions)
{
    Extents least { std::numeric_limits<double>::infinity(), 0 };
    for (int i = 0; i < k_directions; ++i) {
        const double angle = i * std::numbers::pi / k_directions;
        const auto extent = [&](double x, double z) {
            const Eigen::VectorXd along = x * positions.col(0) + z * positions.col(2);
            return along.maxCoeff() - along.minCoeff();
        };
        const double depth = extent(std::cos(angle), std::sin(angle));
        if (depth < least.depth)
            least = { depth, extent(-std::sin(angle), std::cos(angle)) };
    }
    return least;
}

const UsualExtents& usual_extents(const GarmentMeasures& measures)
{
    return measures.leg > 0 ? k_usual_with_legs : measures.shoulders > 0 ? k_usual_with_arms : k_usual_without;
}

void add(std::vector<WearerHeight>& heights, double measure, const Usual& usual)
{
    if (measure > 0)
        heights.push_back({ k_usual_wearer * measure / usual.size, usual.spread });
}

}  // namespace

std::vector<WearerHeight> wearer_heights(const GarmentMesh& garment)
{
    const TriangleMesh outward = outward_cloth(garment);
    const std::vector<Opening> openings = openings_of(outward);
    const GarmentMeasures measures = measures_of(openings);
    std::vector<WearerHeight> heights = wearer_heights(measures);
    // A jacket reaches further than the trousers that were measured.
    const bool are_two = measures.piece >= 0 && guess_type(openings).type == GarmentType::suit;
    const Positions used = are_two ? positions_of_piece(outward, measures.piece)
                                   : Positions(garment.positions(used_vertices(garment.triangles), Eigen::all));
    const Extents extents = level_extents(used);
    add(heights, extents.depth, usual_extents(measures).depth);
    add(heights, extents.width, usual_extents(measures).width);
    if (measures.sleeve_length > 0)
        heights.push_back({ measures.sleeve_length / k_longest_sleeves.size, k_longest_sleeves.spread, true });
    if (measures.leg > 0 && measures.shoulders == 0)
        heights.push_back({ (used.col(1).maxCoeff() - used.col(1).minCoeff()) / k_longest_trousers.size,
                            k_longest_trousers.spread, true });
    return heights;
}

std::vector<WearerHeight> wearer_heights(const GarmentMeasures& measures)
{
    std::vector<WearerHeight> heights;
    add(heights, measures.shoulders, k_usual_shoulders);
    add(heights, measures.sleeve, k_usual_sleeve);
    add(heights, measures.trunk, k_usual_trunk);
    add(heights, measures.leg, k_usual_leg);
    return heights;
}

}  // namespace garmentfit
