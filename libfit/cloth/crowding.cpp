// SPDX-License-Identifier: GPL-3.0-or-later
#include "crowding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "cloth_motion.h"
#include "topology.h"
#include "tuning.h"
#include "weld.h"

namespace garmentfit {

double crowding(const GarmentMesh& garment)
{
    const GarmentMesh cloth = Weld(garment).gather(garment);
    const auto count = cloth.positions.rows();
    const double side = k_active_distance * self_contact_distance({}, cloth.positions, edges_of(cloth.triangles));
    if (count == 0 || !(side > 0))
        return 0;
    std::vector<std::array<std::int64_t, 3>> cubes;
    for (const auto& place : cloth.positions.rowwise()) {
        const auto cell = [&](int axis) { return std::int64_t(std::floor(place[axis] / side)); };
        cubes.push_back({ cell(0), cell(1), cell(2) });
    }
    std::sort(cubes.begin(), cubes.end());
    double pairs = 0;
    for (auto first = cubes.begin(); first != cubes.end();) {
        const auto last = std::find_if(first, cubes.end(), [&](const auto& cube) { return cube != *first; });
        pairs += double(last - first) * double(last - first - 1);
        first = last;
    }
    return pairs / double(count);
}

}  // namespace garmentfit
