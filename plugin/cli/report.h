// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// report.json, and the few lines for people.

#include <string>
#include <string_view>

#include "command_line.h"
#include "session.h"

namespace garmentfit::cli {

/// Lengths in the body's units.
std::string report_json(const Call& call, const Session& session);
/// {"error": {"code": "no_faces", "message": "..."}}, for a run that ended without a report.
std::string error_json(std::string_view code, const std::string& message);
std::string summary(const Call& call, const Session& session);

}  // namespace garmentfit::cli
