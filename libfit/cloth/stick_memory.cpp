// SPDX-License-Identifier: GPL-3.0-or-later
#include "stick_memory.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace garmentfit {
namespace {

bool is_before(const StickMemory::Slip& a, const StickMemory::Slip& b)
{
    return std::tie(a.kind, a.vertices) < std::tie(b.kind, b.vertices);
}

}  // namespace

Vec3 StickMemory::stored(const ContactPair& pair, const Vec3& normal) const
{
    const Slip wanted { pair.kind, pair.vertices, {} };
    const auto found = std::lower_bound(slips_.begin(), slips_.end(), wanted, is_before);
    if (found == slips_.end() || is_before(wanted, *found))
        return Vec3::Zero();
    return found->stored - found->stored.dot(normal) * normal;
}

void StickMemory::assign(std::vector<Slip> slips)
{
    slips_ = std::move(slips);
    std::sort(slips_.begin(), slips_.end(), is_before);
}

}  // namespace garmentfit
