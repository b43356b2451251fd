// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The files that a run writes.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/filters/outfit.h"
#include "session.h"

namespace garmentfit::cli {

/// Warns of guesses of low confidence, and of garments that were not put on.
void add_warnings(Session& session);

/// Writes all results of a command but the report. The certificates become those of the files as written.
void write_results(Session& session, std::string_view command, const std::filesystem::path& folder);

/// Body and clothes as one skinned GLB, in the pose of the body's file. Of a session whose pose was recovered.
/// @throws InvalidInput where it cannot be written.
void write_outfit(const Session& session, const OutfitRequest& request);

/// Names of files and folders that an earlier run may have written into `folder` under the names of this command's
/// results: beside the new report they would look like its results. Empty where no earlier run wrote there; never a
/// file that was read.
std::vector<std::string> outdated_results(const Session& session, std::string_view command,
                                          const std::filesystem::path& folder);

}  // namespace garmentfit::cli
