// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The files of one run, and the scene made of them: in metres, +y up.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/filters/filters.h"
#include "garmentfit/filters/frame_choice.h"
#include "garmentfit/io.h"
#include "garmentfit/skinned_gltf.h"
#include "garmentfit/worn_clothes.h"

namespace garmentfit::cli {

constexpr const char* k_body = "body.ply";
/// Beside it, with the skin where cloth presses it in.
constexpr const char* k_pressed_body = "pressed_body.ply";

/// The rig that a body's file holds, or why it is of no use; neither where it has no skin.
struct OwnRig {
    std::optional<ForeignRig> rig;
    std::string refusal;
};

struct BodyFile {
    std::filesystem::path path;
    MeshFile file;
    Triangles triangles;  ///< of the file, or reconstructed from its points
    FrameGuess frame;  ///< confidences are 1 where the user said it
    std::optional<StrippedBody> only_body = {};  ///< none where all parts of the file are the body
    OwnRig own = {};
    Appearance look {};  ///< after read_body_look
};

struct GarmentFile {
    std::filesystem::path path;
    MeshFile file;  ///< as given, off the body
    FrameGuess frame;  ///< confidences are 1 where the user said it
    std::optional<GarmentChoice> choice = {};  ///< none where a folder of an earlier step was read
    Appearance look {};  ///< after read_garment_looks

    std::string name() const { return file.written_name(); }
};

struct Session {
    BodyFile body;
    std::vector<GarmentFile> garments;  ///< those of scene.garments
    Scene scene;
    std::string skeleton = "shape";  ///< where it comes from: "shape", "file" (of the body), "given"
    std::string skeleton_refusal;  ///< why that of the body's file is not used; empty where it is or there is none
    std::vector<std::string> warnings;
    double read_seconds = 0, write_seconds = 0;

    std::vector<std::string> garment_names() const;
};

/// What is taken of a body's file.
struct BodyParts {
    bool reconstruct = false;  ///< builds a surface from the file's points where it has no faces
    Wears wears = Wears::keep;
};
void read_body(Session& session, const std::filesystem::path& path, const BodyChoice& choice, const BodyParts& parts);
void add_garment(Session& session, const std::filesystem::path& path, GarmentType type, const GarmentChoice& choice);

/// UVs, materials and pictures of files, for an outfit. What cannot be kept is a warning.
void read_body_look(Session& session);
void read_garment_looks(Session& session);

/// The skeleton and weights from what `rig` or `fit` wrote, rig.json and rigged.ply beside it, or from a skinned GLB.
/// @return false where the file has joints only, and the weights are still to be found
bool read_rig(Session& session, const std::filesystem::path& rig);
/// Takes the skeleton and the weights of the body's own file, where that is a skinned glTF whose joints have known names
/// and lie in the body; else the shape decides, with a warning where there is a skin.
void read_own_skeleton(Session& session);
/// All that `fit` wrote, for draping.
void read_fitted(Session& session, const std::filesystem::path& folder);
/// All that `drape` wrote, for recovering the pose.
void read_draped(Session& session, const std::filesystem::path& folder);

}  // namespace garmentfit::cli
