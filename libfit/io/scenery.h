// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What an avatar's file shows besides the avatar.

#include <vector>

#include "garmentfit/io.h"

namespace garmentfit {

/// Of each part whether it is scenery, such as a desk, a floor or a stand: no joint moves it, and most of it is far from
/// what joints move. Hair and eyes without a joint are near; a head without one rests on the body. Where the file has no
/// skin, flat panels are, such as backdrops and lamps. Nothing is where it is mangled: who reads its joints says so.
std::vector<char> find_scenery(const MeshFile& avatar, const std::vector<MeshPart>& parts);

}  // namespace garmentfit
