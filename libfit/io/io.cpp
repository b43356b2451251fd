// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/io.h"

#include <algorithm>
#include <cctype>

#include "garmentfit/error.h"
#include "mesh_content.h"
#include "scene_file.h"
#include "stray_vertices.h"
#include "tuning.h"

namespace garmentfit {
namespace {

namespace fs = std::filesystem;

std::string extension_of(const std::filesystem::path& path)
{
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return extension;
}

/// FBX and COLLADA are written as GLB.
bool is_only_read(const std::filesystem::path& path)
{
    const std::string extension = extension_of(path);
    return extension == ".fbx" || extension == ".dae";
}

ContentPtr read_content(FileBytes file, const std::filesystem::path& path)
{
    const std::string extension = extension_of(path);
    if (file.bytes.starts_with("ply") || extension == ".ply")
        return read_ply(std::move(file));
    if (file.bytes.starts_with("glTF") || extension == ".glb" || extension == ".gltf")
        return read_gltf(std::move(file), path.parent_path());
    if (is_scene_file(file))
        return read_gltf(std::move(file), path.parent_path());
    if (is_off(file) || extension == ".off")
        return read_off(std::move(file));
    if (extension == ".obj")
        return read_obj(std::move(file));
    if (extension == ".stl")
        return read_stl(std::move(file));
    file.fail("unknown format; export it as .obj, .ply, .off, .stl, .glb, .gltf, .fbx or .dae");
}

std::vector<std::string> warnings_about(const MeshFile::Content& content, std::size_t strays)
{
    std::vector<std::string> warnings = content.warnings;
    if (strays > 0)
        warnings.push_back(std::to_string(strays)
                           + " vertices that no face uses lie far away; they are left out, and written as they were");
    if (content.against_faces() > k_left_handed)
        warnings.push_back("its normals point against its faces, as in files of left-handed programs: left and right "
                           "may be exchanged");
    return warnings;
}

// ---- companions ----------------------------------------------------------------------------------------------------

struct Companions {
    std::vector<std::string> names;  ///< that can be copied
    std::vector<std::string> faults;
};

Companions find_companions(const std::vector<std::string>& given, const fs::path& folder)
{
    Companions result;
    for (const std::string& name : given) {
        const fs::path relative = fs::path(name).lexically_normal();
        std::error_code none;
        if (relative.is_absolute() || *relative.begin() == "..")
            result.faults.push_back(name
                                    + " lies outside of the file's folder and is not copied; put it beside the file");
        else if (!fs::is_regular_file(folder / relative, none))
            result.faults.push_back(name + " is missing and is not copied; put it beside the file");
        else
            result.names.push_back(relative.generic_string());
    }
    return result;
}

/// Whether one of them has the name of another file there.
bool collide(const std::vector<std::string>& names, const fs::path& from, const fs::path& to)
{
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        std::error_code none;
        return fs::exists(to / name, none) && !fs::equivalent(from / name, to / name, none)
            && read_file(from / name).bytes != read_file(to / name).bytes;
    });
}

/// Programs split the names of .mtl files at blanks.
std::string free_folder_name(const fs::path& mesh)
{
    std::string stem = mesh.stem().string();
    std::replace(stem.begin(), stem.end(), ' ', '_');
    std::string name = stem;
    for (int k = 2; fs::exists(mesh.parent_path() / name); ++k)
        name = stem + "_" + std::to_string(k);
    return name;
}

void copy_files(const std::vector<std::string>& names, const fs::path& from, const fs::path& to)
{
    for (const std::string& name : names) {
        fs::create_directories((to / name).parent_path());
        std::error_code none;
        fs::copy_file(from / name, to / name, fs::copy_options::skip_existing, none);
    }
}

}  // namespace

MeshFile MeshFile::read(const std::filesystem::path& path)
{
    MeshFile mesh = read_points(path);
    if (mesh.triangles().rows() == 0)
        throw InvalidInput(ErrorCode::no_faces,
                           path.string()
                               + ": has no faces; give a surface mesh, or --reconstruct the points of a body");
    return mesh;
}

MeshFile MeshFile::read_points(const std::filesystem::path& path)
{
    MeshFile mesh;
    mesh.content_ = read_content(read_file(path), path);
    mesh.path_ = path;
    const Positions& in_file = mesh.content_->positions;
    mesh.strays_ = stray_vertices(in_file, mesh.triangles());
    mesh.positions_ = mesh.strays_.empty() ? in_file : gather_strays(in_file, mesh.triangles());
    mesh.warnings_ = warnings_about(*mesh.content_, mesh.strays_.size());
    return mesh;
}

std::string MeshFile::written_name() const
{
    std::filesystem::path name = path_.filename();
    return is_only_read(path_) ? name.replace_extension(".glb").string() : name.string();
}

const Positions& MeshFile::positions() const { return positions_; }
const Triangles& MeshFile::triangles() const { return content_->triangles; }
const std::filesystem::path& MeshFile::path() const { return path_; }
const std::string& MeshFile::format() const { return content_->format; }

Appearance MeshFile::appearance() const { return content_->appearance(); }
CornerUvs MeshFile::corner_uvs() const { return content_->corner_uvs(); }
std::vector<MeshPart> MeshFile::parts() const { return content_->parts(); }
std::vector<std::string> MeshFile::companions() const { return content_->companions(); }
const std::vector<std::string>& MeshFile::left_behind() const { return content_->left_behind; }

void MeshFile::write(const std::filesystem::path& path, const Positions& positions) const
{
    write_file(path, bytes_for(path, positions));
}

std::vector<std::string> MeshFile::lost_companions() const
{
    return find_companions(content_->companions(), path_.parent_path()).faults;
}

void MeshFile::write_with_companions(const std::filesystem::path& path, const Positions& positions) const
{
    std::string bytes = bytes_for(path, positions);
    const fs::path from = path_.parent_path();
    const std::vector<std::string> names = find_companions(content_->companions(), from).names;
    std::string folder;
    if (collide(names, from, path.parent_path())) {
        folder = free_folder_name(path);
        bytes = content_->naming_companions_in(bytes, folder);
    }
    copy_files(names, from, path.parent_path() / folder);
    write_file(path, bytes);
}

std::string MeshFile::bytes_for(const std::filesystem::path& path, const Positions& positions) const
{
    if (positions.rows() != content_->positions.rows())
        throw InvalidInput(ErrorCode::count_mismatch,
                           path.string() + ": cannot write " + std::to_string(positions.rows())
                               + " positions into a mesh of " + std::to_string(content_->positions.rows())
                               + " vertices; give a position for each vertex");
    if (is_only_read(path))
        throw InvalidInput(ErrorCode::unwritable_file,
                           path.string() + ": FBX and COLLADA are not written; give a name that ends in .glb");
    Positions written = positions;
    for (const int v : strays_)
        written.row(v) = content_->positions.row(v);
    return content_->bytes_with(written);
}

}  // namespace garmentfit
