// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Ctrl-C, passed to libfit through Progress.

namespace garmentfit::cli {

/// The first SIGINT or SIGTERM only raises a flag; a second one ends the program at once.
void watch_interruption();
bool interrupted();
/// @throws Cancelled when interrupted.
void stop_if_interrupted();

}  // namespace garmentfit::cli
