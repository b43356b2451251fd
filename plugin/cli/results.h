// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The files that a run leaves.

#include <filesystem>
#include <string>
#include <string_view>

#include "session.h"

namespace fit::cli {

/// Warns of guesses that were nearly a toss-up, and of garments that were not put on.
void add_doubts(Session& session);

/// Writes all that a command leaves behind but the report. The certificates become those of the files as written.
void write_results(Session& session, std::string_view command, const std::filesystem::path& folder);

}  // namespace fit::cli
