// SPDX-License-Identifier: GPL-3.0-or-later

// Writes an outfit for each program whose joints we know, and one over an avatar's own joints: `write_outfits FOLDER`.
// A body of capsules wears a textured tube. The programs of others that open them: tests/viewers/CMakeLists.txt.

#include <cmath>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <string>

#include "fixtures.h"
#include "garmentfit/garment_weights.h"
#include "garmentfit/io.h"
#include "garmentfit/skinned_gltf.h"

namespace {

using namespace garmentfit;
namespace fs = std::filesystem;

constexpr int k_around = 32, k_rows = 12;
constexpr unsigned char k_picture[] = {  // one blue pixel, PNG
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
    0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00,
    0x0c, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x70, 0x48, 0x38, 0x00, 0x00, 0x02, 0x44, 0x01, 0x61, 0xee,
    0x44, 0xb1, 0x45, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82
};

/// An open tube about the hips.
TriangleMesh skirt()
{
    TriangleMesh mesh { Positions(k_around * k_rows, 3), Triangles(2 * k_around * (k_rows - 1), 3) };
    for (int i = 0; i < k_rows; ++i)
        for (int k = 0; k < k_around; ++k) {
            const int here = i * k_around + k, right = i * k_around + (k + 1) % k_around;
            const double angle = 2 * std::numbers::pi * k / k_around;
            mesh.positions.row(here) << 0.28 * std::cos(angle), 0.6 + 0.4 * i / k_rows, 0.25 * std::sin(angle);
            if (i + 1 < k_rows) {
                mesh.triangles.row(2 * here) << here, here + k_around, right;
                mesh.triangles.row(2 * here + 1) << right, here + k_around, right + k_around;
            }
        }
    return mesh;
}

Appearance printed(const TriangleMesh& mesh)
{
    Appearance look;
    look.pictures = { { "print", "image/png", std::string(std::begin(k_picture), std::end(k_picture)) } };
    look.materials = { { .name = "printed cloth", .colour_picture = 0 } };
    look.material_of.assign(std::size_t(mesh.triangles.rows()), 0);
    look.uvs = mesh.positions.leftCols(2).array() + 0.5;
    look.uv_corners = mesh.triangles;
    return look;
}

void write_all(const fs::path& folder)
{
    const fixtures::Person person = fixtures::capsule_person({ .arm_angle = 60, .elbow_angle = 30 });
    const Rig rig = fixtures::simple_rig(person);
    const TriangleMesh cloth = skirt();
    const GarmentMesh garment { cloth.positions, cloth.triangles };
    std::vector<SkinnedMesh> meshes {
        { "body", person.mesh, rig.weights },
        { "skirt", cloth, garment_weights(person.mesh, rig.weights, garment, cloth.positions), printed(cloth) }
    };
    meshes[0].covered.assign(std::size_t(person.mesh.positions.rows()), 0);
    const std::pair<const char*, BoneNames> files[] { { "garmentfit.glb", BoneNames::garmentfit },
                                                      { "mixamo.glb", BoneNames::mixamo },
                                                      { "unreal.glb", BoneNames::unreal },
                                                      { "smpl.glb", BoneNames::smpl },
                                                      { "vrm.vrm", BoneNames::vrm } };
    for (const auto& [name, bones] : files)
        write_outfit_glb(folder / name, rig, meshes, { .names = bones });
    SkinnedMesh& worn = meshes[1];
    worn.more_weights = garment_weights(person.mesh, joint_weights_of(rig.weights), garment, cloth.positions,
                                        { .joints_per_vertex = 8 });
    write_outfit_glb(folder / "eight.glb", rig, meshes);

    write_outfit_glb(folder / "avatar.vrm", rig, { meshes[0] }, { .names = BoneNames::vrm });
    const JointWeights weights = read_joint_weights(folder / "avatar.vrm");
    const MeshFile avatar = MeshFile::read(folder / "avatar.vrm");
    const TriangleMesh body { avatar.positions(), avatar.triangles() };
    write_dressed_avatar(
        folder / "dressed_avatar.vrm", folder / "avatar.vrm",
        { { "skirt", cloth, garment_weights(body, weights, garment, cloth.positions), printed(cloth) } });
    fs::remove(folder / "avatar.vrm");  // a body alone
}

}  // namespace

int main(int count, char** arguments)
try {
    if (count != 2) {
        std::cerr << "usage: write_outfits FOLDER\n";
        return 2;
    }
    fs::create_directories(arguments[1]);
    write_all(arguments[1]);
} catch (const std::exception& error) {
    std::cerr << "write_outfits: " << error.what() << "\n";
    return 2;
}
