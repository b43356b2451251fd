// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the user typed, as values.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "garmentfit/filters/filters.h"
#include "garmentfit/filters/outfit.h"
#include "session.h"

namespace garmentfit::cli {

struct Call {
    const Filter* filter = nullptr;
    std::filesystem::path body, from, rig, joints, out;  ///< `from`: the folder that drape and recover continue
    OutfitRequest outfit;  ///< where body and clothes go as one skinned file; no path: nowhere
    std::vector<std::filesystem::path> garments;
    std::vector<std::string> types;  ///< the first for the first garment, ...; the rest is "auto"
    FrameChoice body_frame, garment_frame;
    /// Of the garments, like their types; a single value is that of all of them.
    std::vector<std::string> garment_fronts;
    std::vector<double> garment_scales;
    std::vector<bool> as_placed;
    std::vector<std::string> as_placed_texts;  ///< from which as_placed is read
    /// Values of --fabric: "jersey" for all garments, or once for each; "shirt.obj=jersey" for one.
    std::vector<std::string> fabrics;
    std::string front;  ///< an axis of the body's file; empty: to be found
    Parameters parameters;
    int threads = 0;  ///< 0 = all cores
    Wears wears = Wears::keep;  ///< what is done with clothes in the body's file
    bool reconstruct = false;  ///< the body may be a point cloud
    bool ignores_skin = false;  ///< the skeleton is found by the body's shape, also where its file has one
    bool quiet = false, json = false;

    /// What was said about one of the garments.
    GarmentChoice garment_choice(std::size_t garment) const;
    /// What each garment is made of; empty for those of which nothing was said.
    /// @param names  of the garments' files  @throws InvalidInput.
    std::vector<std::optional<Fabric>> fabrics_of(const std::vector<std::string>& names) const;
};

/// Nothing when the call asked for help or the version only, which are printed.
/// @throws InvalidInput.
std::optional<Call> parse(int argc, char** argv);

}  // namespace garmentfit::cli
