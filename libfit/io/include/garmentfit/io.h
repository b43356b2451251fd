// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Mesh files: OBJ, PLY, OFF, STL, glTF/GLB. Geometry is read; everything else is kept, to be written back.

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/appearance.h"
#include "garmentfit/export.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// A run of triangles with names: a primitive of glTF. Names are empty where the file has none.
struct MeshPart {
    std::string material, mesh, node;
    Eigen::Index first_triangle = 0, triangles = 0;
    bool is_skinned = false;  ///< has weights over joints
};

/// A mesh file that can be written again with other positions. Vertices, order, polygons, UVs, groups, materials,
/// comments and extra properties stay as they are. Normals turn with the surface.
class GARMENTFIT_API MeshFile {
public:
    /// The format follows from the content where it has a signature, else from the extension.
    /// @throws InvalidInput: missing, unreadable, unknown format, truncated, mangled, no faces, index out of range, not
    ///         finite; names file and line or byte.
    static MeshFile read(const std::filesystem::path& path);

    /// The same for files that may have no faces, such as the points of a scanner. @throws InvalidInput.
    static MeshFile read_points(const std::filesystem::path& path);

    /// In the file's units and axes; STL welded, glTF nodes applied. Vertices without faces that lie far away, or are
    /// not finite, are in the middle of the others here; write() keeps them as they were.
    const Positions& positions() const;
    const Triangles& triangles() const;  ///< polygons cut into fans
    const std::filesystem::path& path() const;  ///< where it was read from
    const std::string& format() const;  ///< "obj", "ply", "off", "stl", "glb" (also of FBX and COLLADA) or "gltf"
    /// The file's name, for a copy in another folder. FBX and COLLADA are written as GLB, with that ending.
    std::string written_name() const;

    /// Writes the file as it was read, with other positions (n x 3, same order). Writes a temporary file and renames
    /// it, so that no half-written file is left. @throws InvalidInput when the place cannot be written.
    void write(const std::filesystem::path& path, const Positions& positions) const;

    /// UVs, materials and pictures of OBJ and glTF, for files of another format; what is missing or mangled is a
    /// warning. Reads files beside this one. O(n).
    Appearance appearance() const;

    /// UVs of OBJ, glTF and PLY, without reading pictures. No rows where the file has none. O(n).
    CornerUvs corner_uvs() const;

    /// What was odd in the file and does not matter to the surface, in whole sentences: normals that are missing, or
    /// that point against the faces; vertices without faces that lie far away.
    const std::vector<std::string>& warnings() const { return warnings_; }

    /// All triangles in named runs, in their order. Of glTF; empty for other formats.
    std::vector<MeshPart> parts() const;

    /// Files beside this one that it names, as it names them, and those that these name: materials and pictures of OBJ.
    std::vector<std::string> companions() const;

    /// Companions that are missing, or lie outside of the file's folder, in whole sentences.
    std::vector<std::string> lost_companions() const;

    /// The same as write(), and copies all other companions beside it, so that it looks there as here. Where one of
    /// them has the name of another file there, all go into a folder with the name of the mesh, which names them there.
    void write_with_companions(const std::filesystem::path& path, const Positions& positions) const;

    /// What write() leaves out of glTF where vertices have moved, as it would be wrong: "a skin", "morph targets",
    /// "tangents", "animations".
    const std::vector<std::string>& left_behind() const;

    struct Content;  ///< one kind for each format, private

private:
    std::string bytes_for(const std::filesystem::path& path, const Positions& positions) const;

    std::shared_ptr<const Content> content_;
    std::filesystem::path path_;
    Positions positions_;
    std::vector<int> strays_;  ///< rows that were moved to the middle
    std::vector<std::string> warnings_;
};

/// One named column of vertex data for write_ply; `integer` columns are written as int, the others as double.
struct VertexProperty {
    std::string name;
    std::vector<double> values;
    bool integer = false;
};

/// Binary little-endian PLY with double positions. Never leaves a half-written file.
GARMENTFIT_API void write_ply(const std::filesystem::path& path, const Positions& positions, const Triangles& triangles,
                              const std::vector<VertexProperty>& properties = {},
                              const std::vector<std::string>& comments = {});

/// Scalar vertex properties of a PLY file by name. @throws InvalidInput.
GARMENTFIT_API std::vector<VertexProperty> read_ply_properties(const std::filesystem::path& path);

/// Writes a temporary file in the same folder, then renames it: a reader sees the old file or the new one.
/// @throws InvalidInput when the place cannot be written.
GARMENTFIT_API void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace garmentfit
