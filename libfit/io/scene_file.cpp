// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_file.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <utility>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "bind_spaces.h"
#include "geometric_transforms.h"
#include "gltf_model.h"
#include "levels_of_detail.h"
#include "run_apart.h"

namespace garmentfit {
namespace {

constexpr std::chrono::seconds k_time_limit { 60 };  // unit: files of 100 MB take less
constexpr std::size_t k_beginning = 4096;  // unit: what may stand before the first element, comments included

/// Without what may stand before the first character: the mark of UTF-8, and blanks.
std::string_view beginning_of(std::string_view bytes)
{
    if (bytes.starts_with("\xef\xbb\xbf"))
        bytes.remove_prefix(3);
    bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
    return bytes.substr(0, k_beginning);
}

/// Other formats may name FBX and COLLADA, too: a glTF that was made from one in the name of its generator, say.
bool is_fbx(std::string_view bytes)
{
    const std::string_view beginning = beginning_of(bytes);
    return bytes.starts_with("Kaydara FBX Binary") || beginning.starts_with("FBXHeaderExtension")
        || (beginning.starts_with(';') && beginning.find("FBXHeaderExtension") != std::string_view::npos);
}

bool is_collada(std::string_view bytes)
{
    const std::string_view beginning = beginning_of(bytes);
    return beginning.starts_with('<') && beginning.find("<COLLADA") != std::string_view::npos;
}

/// Throws what Assimp throws, and its messages as std::runtime_error.
std::unique_ptr<aiScene> read(const FileBytes& file, bool with_pivots)
{
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS,
                             with_pivots);  // with them, a joint is a chain of nodes
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.ReadFileFromMemory(file.bytes.data(), file.bytes.size(),
                                aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_LimitBoneWeights,
                                is_fbx(file.bytes) ? "fbx" : "dae");
    std::unique_ptr<aiScene> scene(importer.GetOrphanedScene());
    if (!scene)
        throw std::runtime_error(importer.GetErrorString());
    return scene;
}

std::string convert(const FileBytes& file)
{
    const std::unique_ptr<aiScene> scene = read(file, false);
    if (is_fbx(file.bytes))
        apply_geometric_transforms(*read(file, true), *scene);
    rename_meshes_called_as_joints(*scene);
    restore_bind_shapes(*scene);
    unify_bind_spaces(*scene);
    keep_finest_levels(*scene);
    Assimp::Exporter exporter;
    const aiExportDataBlob* glb = exporter.ExportToBlob(scene.get(), "glb2");
    if (!glb)
        throw std::runtime_error(exporter.GetErrorString());
    return { static_cast<const char*>(glb->data), glb->size };
}

}  // namespace

bool is_scene_file(const FileBytes& file) { return is_fbx(file.bytes) || is_collada(file.bytes); }

FileBytes glb_of_scene(const FileBytes& file)
{
    ApartResult glb = run_apart([&] { return convert(file); }, k_time_limit);
    if (glb.is_done)
        return { file.name, std::move(glb.bytes) };
    const std::string why = glb.out_of_time ? "it takes more than a minute" : first_line(glb.bytes);
    file.fail("cannot be read as " + std::string(is_fbx(file.bytes) ? "FBX" : "COLLADA")
              + (why.empty() ? "" : " (" + why + ")") + "; export it again, as GLB where you can");
}

}  // namespace garmentfit
