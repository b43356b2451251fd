// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The files that a run leaves.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "session.h"

namespace garmentfit::cli {

/// Warns of guesses that were nearly a toss-up, and of garments that were not put on.
void add_doubts(Session& session);

/// Writes all that a command leaves behind but the report. The certificates become those of the files as written.
void write_results(Session& session, std::string_view command, const std::filesystem::path& folder);

/// What an earlier run left in `folder` and this one would write, had it something to write there: beside the new report it would pass
/// for its result. Names of files and folders; none where no earlier run wrote into the folder, and never a file that was read.
std::vector<std::string> outdated_results(const Session& session, std::string_view command,
                                          const std::filesystem::path& folder);

}  // namespace garmentfit::cli
