// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress_bar.h"

#include <cstdio>

#include "interruption.h"

namespace garmentfit::cli {
namespace {

constexpr int k_cells = 30;  // unit: bar, percent and stage fit a line of 80 columns

std::string bar(double fraction, std::string_view stage)
{
    const int filled = static_cast<int>(fraction * k_cells);
    char percent[8];
    std::snprintf(percent, sizeof percent, "%3d%%", static_cast<int>(100 * fraction));
    return '[' + std::string(filled, '#') + std::string(k_cells - filled, ' ') + "] " + percent + "  "
        + std::string(stage);
}

}  // namespace

ProgressBar::~ProgressBar()
{
    if (!drawn_.empty())
        std::fputs("\r\033[K", stderr);  // clear the line: what follows is the result
}

Progress ProgressBar::progress()
{
    return Progress([this](double fraction, std::string_view stage) {
        draw(fraction, stage);
        return !interrupted();
    });
}

void ProgressBar::draw(double fraction, std::string_view stage)
{
    if (!visible_)
        return;
    std::string line = bar(fraction, stage);
    if (line == drawn_)
        return;
    std::fprintf(stderr, "\r\033[K%s", line.c_str());
    drawn_ = std::move(line);
}

}  // namespace garmentfit::cli
