// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The ends that come from outside: Ctrl-C and the time limit. Work that asks Progress ends by itself, with what it has
// to say. A step inside a library that asks nothing is ended here, a little later.

#include <filesystem>
#include <functional>
#include <string>

namespace garmentfit::cli {

enum class ForcedEnd { stopped, time_limit };

/// The first SIGINT or SIGTERM is only kept in mind, and leaves the program 0.7 s; a second one ends it at once.
/// @param end  for an end that is forced, on a thread of its own: tells it and ends the process, so does not return
void watch_interruption(std::function<void(ForcedEnd)> end);
bool interrupted();
/// By whom, for people; a signal that other programs send is not the user's.
std::string interruption_text();
/// @throws Cancelled when interrupted.
void stop_if_interrupted();

/// Forces an end where the program still runs at twice this time, and at least 10 s after it. 0: no limit.
void watch_time_limit(double seconds);
/// From here on nothing is forced, until somebody watches again: the program is about to end, or to put finished files
/// in their place. Does not return where an end is being forced.
void stop_watching();

}  // namespace garmentfit::cli
