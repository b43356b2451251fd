// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads what `garmentfit rig`, `fit` or `dress` wrote, to draw it.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "garmentfit/types.h"

namespace garmentfit::picture {

struct ShownBone {
    Vec3 head, tail;
    int side = 0;  ///< 0 the middle, 1 left, 2 right
    std::optional<double> value {};  ///< drawn as a colour of the state's scale, instead of the side's
};

/// How numbers become colours.
struct Scale {
    std::string title;  ///< "ease, cm"
    double low = 0, high = 1;
    bool red_is_low = false;
};

/// Body and garments in one state of dressing, in metres with +y up.
struct State {
    TriangleMesh body;  ///< no faces: none is drawn
    std::vector<TriangleMesh> garments;  ///< from the inside out
    Vec3 front = Vec3::UnitZ();  ///< where the body's chest faces
    std::vector<ShownBone> bones {};  ///< with bones, body and garments are drawn transparent
    Positions colours {};  ///< of the body's vertices, red, green, blue from 0 to 1; none: skin
    std::vector<Eigen::VectorXd> values {};  ///< of each garment's vertices, drawn as colours; none: plain cloth
    Scale scale {};
};

struct DressedFolder {
    State input;  ///< the body alone, in its input pose
    State given;  ///< the garments alone, as given
    State fitted;  ///< garments and body in the fitted pose; empty where dressing ended before it
    State dressed;  ///< as dressed
    std::string verdict;  ///< "certified: ..." or why not
};

/// Whether a folder holds a rig and no garments: what `garmentfit rig` wrote. @throws InvalidInput.
bool is_rig_folder(const std::filesystem::path& folder);
/// The body with its bones, each vertex in the colours of the bones that move it. @throws InvalidInput.
State read_rig_folder(const std::filesystem::path& folder);

/// A garment and the bones fitted to it.
struct FittedGarment {
    std::string name;
    State state;
    double score_before, score_after;  ///< E of equation (4) of the paper, by the metric of the method that was used; m
};

/// Whether `garmentfit fit` wrote it. @throws InvalidInput.
bool is_fit_folder(const std::filesystem::path& folder);
/// Each garment with its bones, coloured by clearance; grey where the garment does not cover them. @throws
/// InvalidInput.
std::vector<FittedGarment> read_fit_folder(const std::filesystem::path& folder);

/// The dressed body, its garments coloured by "ease", "strain" or "pressure". @throws InvalidInput.
State read_map(const std::filesystem::path& folder, const std::string& map);

/// @throws InvalidInput.
DressedFolder read_dressed_folder(const std::filesystem::path& folder);

}  // namespace garmentfit::picture
