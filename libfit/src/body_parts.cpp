// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_parts.h"

#include <algorithm>
#include <array>

namespace fit {
namespace {

struct Part {
    const char* name;
    std::vector<int> bones;
};

const std::array<Part, k_body_parts>& parts()
{
    static const std::array<Part, k_body_parts> table { {
        { "chest", { upperback, thorax } },
        { "waist", { lowerback } },
        { "hips", { lhipjoint, rhipjoint } },
        { "neck", { lowerneck, upperneck } },
        { "left shoulder", { lclavicle } },
        { "right shoulder", { rclavicle } },
        { "left upper arm", { lhumerus } },
        { "right upper arm", { rhumerus } },
        { "left forearm", { lradius } },
        { "right forearm", { rradius } },
        { "left thigh", { lfemur } },
        { "right thigh", { rfemur } },
        { "left calf", { ltibia } },
        { "right calf", { rtibia } },
    } };
    return table;
}

}  // namespace

int part_of(int bone)
{
    for (int p = 0; p < k_body_parts; ++p)
        if (const auto& bones = parts()[p].bones; std::find(bones.begin(), bones.end(), bone) != bones.end())
            return p;
    return -1;
}

const char* part_name(int part) { return parts()[part].name; }

std::vector<int> strongest_bones(const SkinWeights& weights)
{
    std::vector<int> result(weights.bones.rows());
    for (std::size_t v = 0; v < result.size(); ++v) {
        int k;
        weights.weights.row(v).maxCoeff(&k);
        result[v] = weights.bones(v, k);
    }
    return result;
}

std::vector<HeldBack> held_back(const Positions& reached, const Positions& target, const SkinWeights& weights)
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

}  // namespace fit
