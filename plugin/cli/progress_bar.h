// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One line on standard error: [########            ]  40%  draping the garment

#include <string>
#include <string_view>

#include "garmentfit/progress.h"

namespace garmentfit::cli {

class ProgressBar {
public:
    explicit ProgressBar(bool visible) : visible_(visible) { }
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// Draws, and stops libfit after Ctrl-C. Valid while this bar lives.
    Progress progress();

private:
    void draw(double fraction, std::string_view stage);

    bool visible_;
    std::string drawn_;  ///< the line on the terminal now
};

}  // namespace garmentfit::cli
