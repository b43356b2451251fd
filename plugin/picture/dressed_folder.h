// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What `garmentfit dress` wrote, read for looking at.

#include <filesystem>
#include <string>
#include <vector>

#include "fit/types.h"

namespace fit::picture {

/// One moment of dressing, in metres with +y up.
struct State {
    TriangleMesh body;  ///< no faces: none shown
    std::vector<TriangleMesh> garments;  ///< from the inside out
    Vec3 front = Vec3::UnitZ();  ///< where the body's chest faces
};

struct DressedFolder {
    State own;  ///< the body alone
    State given;  ///< the garments alone, as given
    State fitted;  ///< garments and body in the fitted pose; empty when dressing ended before
    State dressed;  ///< as dressed
    std::string verdict;  ///< "certified: ..." or why not
};

/// @throws InvalidInput.
DressedFolder read_dressed_folder(const std::filesystem::path& folder);

}  // namespace fit::picture
