// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_parts.h"

#include <algorithm>
#include <array>
#include <vector>

namespace garmentfit {
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

}  // namespace garmentfit
