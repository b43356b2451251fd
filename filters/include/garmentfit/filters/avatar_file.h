// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The skinned file that a body was read from, whose skeleton its outfit keeps.

#include <filesystem>
#include <optional>
#include <vector>

#include "garmentfit/io.h"
#include "garmentfit/units.h"

namespace garmentfit {

/// A skinned glTF or GLB. Rows are those of MeshFile.
struct AvatarFile {
    std::filesystem::path path;
    Frame frame;  ///< in which its vertices lie where those of the body do
    /// Where the body was read by another program, which may have merged, reordered or left out vertices: for each
    /// vertex of the body one of the file at its place, and for each of the file one of the body, -1 for none. Empty:
    /// the same vertices in the same order.
    std::vector<int> file_rows = {}, body_rows = {};
};

/// The body's file, where it is a skinned glTF or GLB. Reads it again. @throws InvalidInput: it is gone.
std::optional<AvatarFile> avatar_in(const MeshFile& body, const Frame& frame);

/// The file of a body that another program has read, where it is a skinned glTF or GLB. Vertices are matched by their
/// order, else by their places. The file may have more of them than the body: its other parts.
/// @param body  n x 3, m
/// @param body_frame  units and axes of the body, which the file may have, too, if they are not those of glTF
/// @throws InvalidInput: missing, unreadable, a vertex of the body lies where none of the file does
std::optional<AvatarFile> avatar_of_body(const std::filesystem::path& path, const Positions& body,
                                         const Frame& body_frame);

/// The units and axes in which the vertices of a file lie where those of a body do, in this order: those of the body, or
/// those of glTF. None where they lie elsewhere in all of these.
/// @param in_file, body  in the file's units and axes; m
std::optional<Frame> frame_on_body(const Positions& in_file, const Positions& body, const Frame& body_frame);

}  // namespace garmentfit
