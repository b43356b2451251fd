// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/animated_gltf.h"
#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/mesh.h"
#include "glb_model.h"

namespace garmentfit {
namespace {

std::size_t frames_of(const std::vector<MovingMesh>& meshes)
{
    if (meshes.empty() || meshes.front().frames.empty())
        throw InvalidInput(ErrorCode::missing_input,
                           "animated GLB: no frames to write; give a mesh with at least one frame");
    for (const MovingMesh& mesh : meshes)
        if (mesh.frames.size() != meshes.front().frames.size())
            throw InvalidInput(ErrorCode::count_mismatch,
                               "animated GLB: " + mesh.name + " has " + std::to_string(mesh.frames.size()) + " frames, "
                                   + meshes.front().name + " has " + std::to_string(meshes.front().frames.size())
                                   + "; give all meshes the same number");
    return meshes.front().frames.size();
}

/// The first frame is the mesh. Each later one is a morph target: its positions less those of the first.
tinygltf::Primitive primitive_of(const MovingMesh& mesh, int material, GlbModel& glb)
{
    const Positions& first = mesh.frames.front();
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = material;
    const int positions = glb.add<float>(first, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    glb.set_bounds(positions, first);
    primitive.attributes["POSITION"] = positions;
    primitive.attributes["NORMAL"]
        = glb.add<float>(vertex_normals(first, mesh.triangles), TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    for (std::size_t k = 1; k < mesh.frames.size(); ++k) {
        const Positions added = mesh.frames[k] - first;
        const int target = glb.add<float>(added, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
        glb.set_bounds(target, added);
        primitive.targets.push_back({ { "POSITION", target } });
    }
    primitive.indices
        = glb.add<std::uint32_t>(mesh.triangles, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    return primitive;
}

tinygltf::Material material_of(const MovingMesh& mesh)
{
    tinygltf::Material material;
    material.name = mesh.name;
    material.doubleSided = true;
    material.pbrMetallicRoughness.baseColorFactor = { mesh.colour.x(), mesh.colour.y(), mesh.colour.z(), 1 };
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.9;  // unit: a matt look, no result depends on it
    return material;
}

/// One sampler for all meshes: at frame k only target k - 1 has weight.
tinygltf::Animation animation_of(std::size_t meshes, std::size_t frames, double seconds_per_frame, GlbModel& glb)
{
    const Eigen::Index n = Eigen::Index(frames);
    const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(n, 0, seconds_per_frame * double(n - 1));
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(n, n - 1);
    weights.bottomRows(n - 1).setIdentity();
    tinygltf::AnimationSampler sampler;
    sampler.interpolation = "LINEAR";
    sampler.input = glb.add<float>(times, TINYGLTF_TYPE_SCALAR);
    glb.set_bounds(sampler.input, times);
    sampler.output = glb.add<float>(weights, TINYGLTF_TYPE_SCALAR);
    tinygltf::Animation animation;
    animation.name = "dressing";
    animation.samplers.push_back(sampler);
    for (std::size_t node = 0; node < meshes; ++node) {
        tinygltf::AnimationChannel channel;
        channel.sampler = 0;
        channel.target_node = int(node);
        channel.target_path = "weights";
        animation.channels.push_back(channel);
    }
    return animation;
}

}  // namespace

void write_animated_glb(const std::filesystem::path& path, const std::vector<MovingMesh>& meshes,
                        double seconds_per_frame)
{
    const std::size_t frames = frames_of(meshes);
    GlbModel glb;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        tinygltf::Mesh mesh;
        mesh.name = meshes[m].name;
        mesh.primitives.push_back(primitive_of(meshes[m], int(m), glb));
        mesh.weights.assign(frames - 1, 0.0);
        tinygltf::Node node;
        node.name = meshes[m].name;
        node.mesh = int(m);
        glb.model.scenes[0].nodes.push_back(int(m));
        glb.model.nodes.push_back(node);
        glb.model.meshes.push_back(mesh);
        glb.model.materials.push_back(material_of(meshes[m]));
    }
    if (frames > 1)
        glb.model.animations.push_back(animation_of(meshes.size(), frames, seconds_per_frame, glb));
    write_file(path, glb.file());
}

}  // namespace garmentfit
