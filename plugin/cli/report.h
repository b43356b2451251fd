// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// report.json, and the few lines for people.

#include <string>

#include "command_line.h"
#include "session.h"

namespace garmentfit::cli {

/// Lengths in the body's units.
std::string report_json(const Call& call, const Session& session);
std::string summary(const Call& call, const Session& session);

}  // namespace garmentfit::cli
