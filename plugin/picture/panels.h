// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// States side by side, at one scale, with captions. Needs a display, such as that of xvfb-run.

#include <filesystem>
#include <string>
#include <vector>

#include "dressed_folder.h"

namespace garmentfit::picture {

struct Panel {
    const State* state = nullptr;
    std::string caption;
    double turn = 0;  ///< radians, of the viewer round the body, from its front towards its left side
};

void draw(const std::vector<Panel>& panels, const std::string& headline, int height, const std::filesystem::path& png);

}  // namespace garmentfit::picture
