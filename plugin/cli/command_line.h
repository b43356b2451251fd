// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the user typed, as values.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "garmentfit/filters/filters.h"
#include "session.h"

namespace garmentfit::cli {

struct Call {
    const Filter* filter = nullptr;
    std::filesystem::path body, from, rig, joints, out;  ///< `from`: the folder that drape and recover continue
    std::vector<std::filesystem::path> garments;
    std::vector<std::string> types;  ///< the first for the first garment, ...; the rest is "auto"
    FrameChoice body_frame, garment_frame;
    std::string front;  ///< an axis of the body's file; empty: to be found
    Parameters parameters;
    int threads = 0;  ///< 0 = all cores
    bool reconstruct = false;  ///< the body may be a point cloud
    bool quiet = false, json = false;
};

/// Nothing when the call asked for help or the version only, which are printed.
/// @throws InvalidInput.
std::optional<Call> parse(int argc, char** argv);

}  // namespace garmentfit::cli
