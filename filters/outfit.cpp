// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/outfit.h"

#include <algorithm>

#include "garmentfit/covered_skin.h"
#include "garmentfit/error.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/garment_weights.h"
#include "garmentfit/inset_skin.h"

namespace garmentfit {
namespace {

std::vector<std::string> names_of(const std::vector<OutfitPart>& parts)
{
    std::vector<std::string> names;
    for (const OutfitPart& part : parts)
        names.push_back(part.name);
    return names;
}

void check(const Scene& scene, const std::vector<OutfitPart>& garments, const std::filesystem::path& path)
{
    if (const std::string fault = fault_of_outfit_name(path); !fault.empty())
        throw InvalidInput(ErrorCode::wrong_call, fault);
    if (!scene.recovered)
        throw InvalidInput(ErrorCode::missing_input,
                           "an outfit shows the body in its own pose; recover the pose before it is written");
    if (!scene.recovered->certified)
        throw InvalidInput(ErrorCode::invalid_input,
                           "only what is certified is written as an outfit: "
                               + explain(*scene.recovered, names_of(garments)));
}

std::vector<SkinnedMesh> skinned_meshes(const Scene& scene, const OutfitPart& body,
                                        const std::vector<OutfitPart>& garments, int influences)
{
    const Dressing& dressing = *scene.recovered;
    const TriangleMesh skin { dressing.body, scene.body->surface.triangles };
    const JointWeights skin_weights = joint_weights_of(scene.rig->weights);
    std::vector<SkinnedMesh> meshes { { body.name, skin, scene.rig->weights, body.look } };
    for (const std::size_t i : dressing.worn()) {
        const GarmentMesh& garment = scene.garments[i].mesh;
        const Positions& worn = dressing.garments[i].positions;
        JointWeights weights = garment_weights(skin, skin_weights, garment, worn, { .joints_per_vertex = influences });
        meshes.push_back({ .name = garments.at(i).name,
                           .surface = { worn, garment.triangles },
                           .weights = skin_weights_of(weights),
                           .look = garments.at(i).look,
                           .more_weights = std::move(weights) });
    }
    return meshes;
}

/// Draws the body, the first of these, in under the others.
void inset_body(std::vector<SkinnedMesh>& meshes)
{
    std::vector<TriangleMesh> clothes;
    for (std::size_t i = 1; i < meshes.size(); ++i)
        clothes.push_back(meshes[i].surface);
    meshes[0].surface.positions = inset_skin(meshes[0].surface, clothes);
}

std::vector<char> covered_by_clothes(const std::vector<SkinnedMesh>& meshes, const Rig& rig)
{
    std::vector<SkinnedCloth> clothes;
    for (std::size_t i = 1; i < meshes.size(); ++i)
        clothes.push_back({ meshes[i].surface, meshes[i].weights });
    return find_covered_skin(meshes[0].surface, rig, clothes);
}

/// Marks vertices without faces as covered, too: their faces were left out of the body.
std::vector<char> mark_stripped(std::vector<char> covered, const TriangleMesh& body)
{
    std::vector<char> has_faces(std::size_t(body.positions.rows()), 0);
    for (Eigen::Index i = 0; i < body.triangles.size(); ++i)
        has_faces[std::size_t(body.triangles.data()[i])] = 1;
    covered.resize(has_faces.size(), 0);
    for (std::size_t v = 0; v < has_faces.size(); ++v)
        covered[v] = covered[v] || !has_faces[v];
    return covered;
}

/// Of each vertex of the body, over the joints of its file.
JointWeights weights_on_body(const AvatarFile& avatar)
{
    const JointWeights of_file = read_joint_weights(avatar.path);
    if (avatar.file_rows.empty())
        return of_file;
    JointWeights weights(Eigen::Index(avatar.file_rows.size()), of_file.cols());
    for (Eigen::Index v = 0; v < weights.rows(); ++v) {
        weights.startVec(v);
        for (JointWeights::InnerIterator joint(of_file, avatar.file_rows[std::size_t(v)]); joint; ++joint)
            weights.insertBack(v, joint.col()) = joint.value();
    }
    weights.finalize();
    return weights;
}

/// From the vertices of the body to those of its file; parts that the body has not are not covered.
std::vector<char> covered_in_file(const std::vector<char>& covered, const AvatarFile& avatar)
{
    if (covered.empty() || avatar.body_rows.empty())
        return covered;
    std::vector<char> in_file;
    for (const int row : avatar.body_rows)
        in_file.push_back(row < 0 ? char(0) : covered.at(std::size_t(row)));
    return in_file;
}

void write_on_avatar(const Scene& scene, const std::vector<OutfitPart>& garments, const OutfitRequest& request,
                     const std::vector<char>& covered)
{
    const Dressing& dressing = *scene.recovered;
    const TriangleMesh skin { dressing.body, scene.body->surface.triangles };
    const JointWeights weights = weights_on_body(*request.avatar);
    if (weights.rows() != skin.positions.rows())
        throw InvalidInput(ErrorCode::rig_mismatch,
                           request.avatar->path.string() + ": has weights of " + std::to_string(weights.rows())
                               + " vertices, the body has " + std::to_string(skin.positions.rows())
                               + "; give the file that the body was read from");
    std::vector<AvatarGarment> clothes;
    for (const std::size_t i : dressing.worn()) {
        const GarmentMesh& garment = scene.garments[i].mesh;
        const Positions& worn = dressing.garments[i].positions;
        clothes.push_back({ garments.at(i).name,
                            { request.avatar->frame.to_file(worn), garment.triangles },
                            garment_weights(skin, weights, garment, worn, { .joints_per_vertex = request.influences }),
                            garments.at(i).look });
    }
    write_dressed_avatar(
        request.path, request.avatar->path, clothes,
        covered_in_file(request.is_stripped ? mark_stripped(covered, skin) : covered, *request.avatar));
}

}  // namespace

const std::vector<std::pair<std::string, BoneNames>>& bone_name_sets()
{
    static const std::vector<std::pair<std::string, BoneNames>> sets { { "garmentfit", BoneNames::garmentfit },
                                                                       { "vrm", BoneNames::vrm },
                                                                       { "mixamo", BoneNames::mixamo },
                                                                       { "unreal", BoneNames::unreal },
                                                                       { "smpl", BoneNames::smpl } };
    return sets;
}

std::optional<BoneNames> bone_names_called(const std::string& name)
{
    if (name == k_own_bones)
        return std::nullopt;
    std::string known = k_own_bones;
    for (const auto& [each, names] : bone_name_sets()) {
        if (each == name)
            return names;
        known += ", " + each;
    }
    throw InvalidInput(ErrorCode::unknown_name, "there are no bones called \"" + name + "\"; give one of " + known);
}

const std::vector<std::pair<std::string, int>>& influence_choices()
{
    static const std::vector<std::pair<std::string, int>> choices { { "four", k_few_influences },
                                                                    { "eight", k_many_influences } };
    return choices;
}

int influences_called(const std::string& name)
{
    for (const auto& [each, count] : influence_choices())
        if (each == name)
            return count;
    throw InvalidInput(ErrorCode::unknown_name,
                       "influences: " + name + " joints a vertex is no choice; give four or eight");
}

bool is_on_avatar(const OutfitRequest& request)
{
    return !request.bones && request.avatar && (request.path.extension() != ".vrm" || is_vrm(request.avatar->path));
}

std::string fault_of_outfit_name(const std::filesystem::path& path)
{
    const std::string extension = path.extension().string();
    return extension == ".glb" || extension == ".vrm" ? "" : path.string() + ": give a name that ends in .glb or .vrm";
}

void write_outfit(const Scene& scene, const OutfitPart& body, const std::vector<OutfitPart>& garments,
                  const OutfitRequest& request)
{
    check(scene, garments, request.path);
    if (request.path.has_parent_path())
        std::filesystem::create_directories(request.path.parent_path());
    const bool on_avatar = is_on_avatar(request);
    std::vector<SkinnedMesh> meshes;
    if (!on_avatar || request.hide_covered_skin)
        meshes = skinned_meshes(scene, body, garments, request.influences);
    if (!on_avatar && request.hide_covered_skin)
        inset_body(meshes);
    const std::vector<char> covered
        = request.hide_covered_skin ? covered_by_clothes(meshes, *scene.rig) : std::vector<char>();
    if (on_avatar)
        return write_on_avatar(scene, garments, request, covered);
    meshes[0].covered = covered;
    meshes[0].hides_covered = request.hide_covered_skin;
    const BoneNames bones = request.bones.value_or(BoneNames::garmentfit);
    write_outfit_glb(request.path, *scene.rig, meshes,
                     { request.path.extension() == ".vrm" ? BoneNames::vrm : bones, request.path.stem().string() });
}

}  // namespace garmentfit
