// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/animated_gltf.h"
#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/mesh.h"
#include "glb_buffer.h"

namespace garmentfit {
namespace {

using nlohmann::ordered_json;
using namespace gltf;

std::size_t frames_of(const std::vector<MovingMesh>& meshes)
{
    if (meshes.empty() || meshes.front().frames.empty())
        throw InvalidInput("animated GLB: there is nothing to write; give a mesh with at least one frame");
    for (const MovingMesh& mesh : meshes)
        if (mesh.frames.size() != meshes.front().frames.size())
            throw InvalidInput("animated GLB: " + mesh.name + " has " + std::to_string(mesh.frames.size()) + " frames, "
                               + meshes.front().name + " has " + std::to_string(meshes.front().frames.size())
                               + "; give all meshes the same number");
    return meshes.front().frames.size();
}

/// The first frame is the mesh, each later one a morph target: what it adds to the first.
ordered_json primitive_of(const MovingMesh& mesh, std::size_t material, GlbBuffer& buffer)
{
    const Positions& first = mesh.frames.front();
    const int positions = buffer.add<float>(first, k_float, "VEC3", k_array_buffer);
    buffer.set_bounds(positions, first);
    const int normals = buffer.add<float>(vertex_normals(first, mesh.triangles), k_float, "VEC3", k_array_buffer);
    ordered_json targets = ordered_json::array();
    for (std::size_t k = 1; k < mesh.frames.size(); ++k) {
        const Positions added = mesh.frames[k] - first;
        const int target = buffer.add<float>(added, k_float, "VEC3", k_array_buffer);
        buffer.set_bounds(target, added);
        targets.push_back({ { "POSITION", target } });
    }
    ordered_json primitive {
        { "attributes", { { "POSITION", positions }, { "NORMAL", normals } } },
        { "indices", buffer.add<std::uint32_t>(mesh.triangles, k_unsigned_int, "SCALAR", k_element_array_buffer) },
        { "material", material }
    };
    if (!targets.empty())
        primitive["targets"] = targets;
    return primitive;
}

ordered_json material_of(const MovingMesh& mesh)
{
    const Eigen::RowVector3d& c = mesh.colour;
    return {
        { "name", mesh.name },
        { "doubleSided", true },
        { "pbrMetallicRoughness",
          { { "baseColorFactor", { c.x(), c.y(), c.z(), 1 } }, { "metallicFactor", 0 }, { "roughnessFactor", 0.9 } } }
    };
}

/// One sampler for all meshes: at frame k only target k - 1 has weight.
ordered_json animation_of(std::size_t meshes, std::size_t frames, double seconds_per_frame, GlbBuffer& buffer)
{
    const Eigen::Index n = Eigen::Index(frames);
    const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(n, 0, seconds_per_frame * double(n - 1));
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(n, n - 1);
    weights.bottomRows(n - 1).setIdentity();
    const int input = buffer.add<float>(times, k_float, "SCALAR", 0);
    buffer.set_bounds(input, times);
    const int output = buffer.add<float>(weights, k_float, "SCALAR", 0);
    ordered_json channels = ordered_json::array();
    for (std::size_t node = 0; node < meshes; ++node)
        channels.push_back({ { "sampler", 0 }, { "target", { { "node", node }, { "path", "weights" } } } });
    return { { { "name", "dressing" },
               { "channels", channels },
               { "samplers", { { { "input", input }, { "interpolation", "LINEAR" }, { "output", output } } } } } };
}

}  // namespace

void write_animated_glb(const std::filesystem::path& path, const std::vector<MovingMesh>& meshes,
                        double seconds_per_frame)
{
    const std::size_t frames = frames_of(meshes);
    GlbBuffer buffer;
    ordered_json json { { "asset", { { "version", "2.0" }, { "generator", "garmentfit" } } }, { "scene", 0 } };
    ordered_json roots = ordered_json::array();
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        roots.push_back(m);
        json["nodes"].push_back({ { "name", meshes[m].name }, { "mesh", m } });
        ordered_json mesh { { "name", meshes[m].name }, { "primitives", { primitive_of(meshes[m], m, buffer) } } };
        if (frames > 1)
            mesh["weights"] = std::vector<double>(frames - 1, 0.0);
        json["meshes"].push_back(mesh);
        json["materials"].push_back(material_of(meshes[m]));
    }
    json["scenes"] = { { { "nodes", roots } } };
    if (frames > 1)
        json["animations"] = animation_of(meshes.size(), frames, seconds_per_frame, buffer);
    write_file(path, std::move(buffer).file(json));
}

}  // namespace garmentfit
