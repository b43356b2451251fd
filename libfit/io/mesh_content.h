// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is kept of a mesh file in each format, and the functions that read it.

#include <string>
#include <vector>

#include "file_bytes.h"
#include "garmentfit/io.h"

namespace garmentfit {

struct MeshFile::Content {
    Positions positions;
    Triangles triangles;
    std::string format;

    virtual ~Content() = default;
    /// The bytes of the file with other positions (same count).
    virtual std::string bytes_with(const Positions& positions) const = 0;
    virtual Appearance appearance() const { return {}; }
    virtual CornerUvs corner_uvs() const { return {}; }
    virtual std::vector<std::string> companions() const { return {}; }
    /// Bytes of a file of this format, its companions in a folder beside it.
    virtual std::string naming_companions_in(const std::string& bytes, const std::string&) const { return bytes; }
    virtual std::vector<MeshPart> parts() const { return {}; }
    /// Of the surface with normals, the share whose normals point against the winding of the faces; 0 without normals.
    virtual double against_faces() const { return 0; }
    std::vector<std::string> left_behind;  ///< what bytes_with leaves out where vertices have moved
    std::vector<std::string> warnings;  ///< of what is mangled and was left out, in whole sentences
};

using ContentPtr = std::shared_ptr<const MeshFile::Content>;

ContentPtr read_obj(FileBytes file);
ContentPtr read_off(FileBytes file);
ContentPtr read_stl(FileBytes file);
/// @param folder  of the file's buffers and pictures
ContentPtr read_gltf(FileBytes file, const std::filesystem::path& folder);
ContentPtr read_ply(FileBytes file);

/// Vertices that no face uses may be anything. @return the first vertex of a face that is not finite; of a file without
/// faces, the first of all; -1: none
Eigen::Index first_not_finite(const MeshFile::Content& content);

/// Whether the header line says OFF.
bool is_off(const FileBytes& file);

/// Collects faces corner by corner and cuts polygons into fans.
class FanBuilder {
public:
    explicit FanBuilder(int columns = 1) : columns_(columns), fans_(columns) { }

    /// One polygon: `columns` indices (of position, of normal, ...) for each corner, all of the first corner first.
    void add(const std::vector<int>& corners);
    Triangles triangles(int column = 0) const;
    Eigen::Index rows() const { return static_cast<Eigen::Index>(fans_[0].size() / 3); }

private:
    int columns_;
    std::vector<std::vector<int>> fans_;
};

}  // namespace garmentfit
