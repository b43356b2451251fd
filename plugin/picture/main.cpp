// SPDX-License-Identifier: GPL-3.0-or-later

// garmentfit-picture: the results of `garmentfit dress`, `fit` or `rig`, side by side.

#include <cstdlib>
#include <iostream>

#include <CLI/CLI.hpp>

#include "dressed_folder.h"
#include "garmentfit/error.h"
#include "garmentfit/number_text.h"
#include "garmentfit/version.h"
#include "panels.h"

namespace {

using namespace garmentfit::picture;

constexpr double k_half_turn = 3.14159;  // radians; derived
constexpr double k_part_turn = 0.7;  // radians; taste: shows a sleeve and the front at once

std::vector<Panel> panels_of(const DressedFolder& folder)
{
    std::vector<Panel> panels { { &folder.input, "body", 0 }, { &folder.given, "garment as given", 0 } };
    if (folder.fitted.body.triangles.rows() > 0)
        panels.push_back({ &folder.fitted, "fitted: body in the garment", 0 });
    panels.push_back({ &folder.dressed, "dressed", 0 });
    panels.push_back({ &folder.dressed, "dressed, from the left", k_part_turn });
    return panels;
}

std::vector<Panel> panels_of(const State& state)
{
    return { { &state, "front", 0 }, { &state, "from the left", k_part_turn }, { &state, "back", k_half_turn } };
}

std::vector<Panel> panels_of(const std::vector<FittedGarment>& fitted)
{
    if (fitted.size() == 1)
        return panels_of(fitted.front().state);
    std::vector<Panel> panels;
    for (const FittedGarment& garment : fitted) {
        panels.push_back({ &garment.state, garment.name, 0 });
        panels.push_back({ &garment.state, "from the left", k_part_turn });
    }
    return panels;
}

std::string headline_of(const std::vector<FittedGarment>& fitted)
{
    std::string text = "bones coloured by clearance; E";
    for (const FittedGarment& garment : fitted)
        text += (&garment == &fitted.front() ? " " : "; ") + garmentfit::fixed_text(garment.score_before, 2) + " -> "
            + garmentfit::fixed_text(garment.score_after, 2) + " m";
    return text;
}

void draw_folder(const std::string& folder, const std::string& map, int height, const std::string& output)
{
    if (!map.empty()) {
        const State coloured = read_map(folder, map);
        draw(panels_of(coloured), "fit map: " + coloured.scale.title, height, output);
    } else if (is_rig_folder(folder)) {
        const State rigged = read_rig_folder(folder);
        draw(panels_of(rigged), "bones: left blue, right red; skin in the colours of its bones", height, output);
    } else if (is_fit_folder(folder)) {
        const std::vector<FittedGarment> fitted = read_fit_folder(folder);
        draw(panels_of(fitted), headline_of(fitted), height, output);
    } else {
        const DressedFolder read = read_dressed_folder(folder);
        draw(panels_of(read), read.verdict, height, output);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    std::string folder, output, map;
    int height = 800;
    CLI::App app("Draws what garmentfit dress wrote: body, garment, fitted state and dressed result; what "
                 "garmentfit fit wrote: bones in the garment, coloured by their clearance in it; or what "
                 "garmentfit rig wrote: bones and weights",
                 "garmentfit-picture");
    app.set_version_flag("--version", "garmentfit-picture " GARMENTFIT_VERSION);
    app.add_option("DIR", folder, "Folder that garmentfit dress, fit or rig wrote")->required();
    app.add_option("-o,--output", output, "PNG file")->required();
    app.add_option("--map", map, "Colours the garments by ease, strain or pressure instead, with a legend")
        ->check(CLI::IsMember({ "ease", "strain", "pressure" }));
    app.add_option("--height", height, "Height of the picture in pixels")
        ->check(CLI::Range(100, 10000))
        ->default_str("800");
    app.footer("Examples:\n"
               "  xvfb-run -a garmentfit-picture dressed -o dressed.png\n"
               "  xvfb-run -a garmentfit-picture dressed --map ease -o ease.png\n");
    CLI11_PARSE(app, argc, argv);
    try {
        if (!std::getenv("DISPLAY"))  // VTK would end the process without saying what to do
            throw garmentfit::InvalidInput("no display for the picture; run the command under xvfb-run -a");
        draw_folder(folder, map, height, output);
    } catch (const std::exception& error) {
        std::cerr << "garmentfit-picture: " << error.what() << '\n';
        return 2;
    }
    return 0;
}
