// SPDX-License-Identifier: GPL-3.0-or-later
#include "held_back.h"

#include <algorithm>
#include <array>

#include "body_parts.h"
#include "skin_weights.h"

namespace garmentfit {

std::vector<HeldBack> list_held_back_parts(const Positions& reached, const Positions& target,
                                           const SkinWeights& weights)
{
    const std::vector<int> bones = strongest_bones(weights);
    std::array<double, k_body_parts> longest {};
    for (std::size_t v = 0; v < bones.size(); ++v)
        if (const int part = part_of(bones[v]); part >= 0)
            longest[part] = std::max(longest[part], (reached.row(v) - target.row(v)).norm());
    std::vector<HeldBack> result;
    for (int p = 0; p < k_body_parts; ++p)
        if (longest[p] > 0)
            result.push_back({ part_name(p), longest[p] });
    std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.distance > b.distance; });
    return result;
}

}  // namespace garmentfit
