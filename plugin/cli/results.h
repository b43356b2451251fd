// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a run ended, and the files it leaves.

#include <filesystem>
#include <string>
#include <string_view>

#include "session.h"

namespace fit::cli {

enum class Outcome { done = 0, too_small = 3, not_certified = 4 };  // exit codes

/// How the garments are worn at the end, or null when none was put on (yet).
const Dressing* final_dressing(const Scene& scene);
bool all_clean(const Dressing& dressing);
Outcome outcome_of(const Scene& scene);
/// One line on how it went wrong. Only for too_small and not_certified.
std::string explain(const Session& session);

/// Warns of guesses that were nearly a toss-up, and of garments that were not put on.
void add_doubts(Session& session);

/// Writes all that a command leaves behind but the report. The certificates become those of the files as written.
void write_results(Session& session, std::string_view command, const std::filesystem::path& folder);

}  // namespace fit::cli
