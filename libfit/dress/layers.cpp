// SPDX-License-Identifier: GPL-3.0-or-later
#include "layers.h"

#include <algorithm>

namespace garmentfit {

void set_positions(std::vector<WornGarment>& garments, const Positions& positions)
{
    Eigen::Index first = 0;
    for (WornGarment& garment : garments) {
        garment.positions = positions.middleRows(first, garment.rest.positions.rows());
        first += garment.rest.positions.rows();
    }
}

void add_slips(std::vector<WornGarment>& garments, const Positions& followed)
{
    Eigen::Index first = 0;
    for (WornGarment& garment : garments) {
        const Eigen::Index vertices = garment.positions.rows();
        Eigen::VectorXd down = followed.col(1).segment(first, vertices) - garment.positions.col(1);
        const auto middle = down.begin() + vertices / 2;
        std::nth_element(down.begin(), middle, down.end());
        garment.slipped += *middle;
        first += vertices;
    }
}

void measure_piece_shifts(std::vector<WornGarment>& garments)
{
    for (WornGarment& garment : garments)
        garment.piece_shift = longest_piece_shift(garment.rest, garment.positions);
}

}  // namespace garmentfit
