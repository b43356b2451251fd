// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Work of other libraries on files that may be mangled, in a process of its own (docs/decisions/0031-assimp-apart.md).

#include <chrono>
#include <functional>
#include <string>

namespace garmentfit {

struct ApartResult {
    bool is_done = false;
    std::string bytes;  ///< what the work returned; else why it failed, or "" where it crashed
    bool out_of_time = false;
};

/// Runs the work in a copy of this process, and ends that after the time limit. A crash ends only the copy. What the
/// work throws is a failure with its message. It sees only this thread: it must not wait for others.
ApartResult run_apart(const std::function<std::string()>& work, std::chrono::seconds limit);

}  // namespace garmentfit
