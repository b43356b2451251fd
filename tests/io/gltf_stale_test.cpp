// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "file_bytes.h"
#include "fixtures.h"
#include "garmentfit/io.h"
#include "garmentfit/skinned_gltf.h"
#include "gltf_container.h"
#include "temporary_folder.h"

namespace {

using namespace garmentfit;
using Json = nlohmann::ordered_json;

/// A garment of a game: skinned, with a morph target, tangents, an animation, below a node that its skin ignores.
class StaleGltf : public fixtures::TemporaryFolder {
protected:
    void SetUp() override
    {
        TemporaryFolder::SetUp();
        const fixtures::Person person = fixtures::capsule_person({ .arm_angle = 60, .elbow_angle = 30 });
        write_skinned_glb(folder / "plain.glb", person.mesh, fixtures::simple_rig(person));
        GltfContainer container = read_gltf_container(read_file(folder / "plain.glb"));
        Json& json = container.json;
        Json& mesh = json["meshes"][0];
        Json& primitive = mesh["primitives"][0];
        const auto positions = primitive["attributes"]["POSITION"];
        primitive["attributes"]["TANGENT"] = positions;  // nobody reads its numbers
        primitive["targets"] = { { { "POSITION", positions } } };
        mesh["weights"] = { 0 };
        mesh["extras"] = { { "targetNames", { "wide" } } };
        for (Json& node : json["nodes"])
            if (node.contains("mesh")) {
                node["translation"] = { 5, 0, 0 };
                node["weights"] = { 0 };
            }
        json["animations"] = { { { "name", "wave" }, { "channels", Json::array() }, { "samplers", Json::array() } } };
        save("shirt.glb", bytes_of(container));
    }

    /// The shirt without its skin below a node that is moved by so much along y.
    MeshFile hung_at(double height)
    {
        GltfContainer container = read_gltf_container(read_file(folder / "shirt.glb"));
        for (Json& node : container.json["nodes"])
            if (node.contains("mesh")) {
                node["translation"] = { 0, height, 0 };
                node.erase("skin");
            }
        return MeshFile::read(save("hung.glb", bytes_of(container)));
    }

    Json json_of(const char* name) const { return read_gltf_container(read_file(folder / name)).json; }
};

TEST_F(StaleGltf, DoesNotComeAlongWhereVerticesHaveMoved)
{
    const MeshFile shirt = MeshFile::read(folder / "shirt.glb");
    EXPECT_EQ(shirt.left_behind(), (std::vector<std::string> { "a skin", "morph targets", "tangents", "animations" }));
    const Positions moved = shirt.positions() * 1.25;
    shirt.write(folder / "worn.glb", moved);

    const MeshFile worn = MeshFile::read(folder / "worn.glb");
    EXPECT_LT((worn.positions() - moved).cwiseAbs().maxCoeff(), 1e-6) << "the place of its node counts now";
    EXPECT_EQ(worn.triangles(), shirt.triangles());
    EXPECT_TRUE(worn.left_behind().empty());
    EXPECT_FALSE(has_skin(folder / "worn.glb"));
    const Json json = json_of("worn.glb");
    for (const char* gone : { "TANGENT", "JOINTS_", "WEIGHTS_", "targets", "targetNames", "animations", "skins" })
        EXPECT_EQ(json.dump().find(gone), std::string::npos) << gone;
}

TEST_F(StaleGltf, KeepsItsDigitsWhereItIsWrittenFarFromItsNode)
{
    const MeshFile shirt = hung_at(1000);
    const Positions moved = shirt.positions().rowwise() - Eigen::RowVector3d(1e-3, 1000, 0);
    shirt.write(folder / "worn.glb", moved);
    EXPECT_LT((MeshFile::read(folder / "worn.glb").positions() - moved).cwiseAbs().maxCoeff(), 2e-7);
}

TEST_F(StaleGltf, IsWrittenThoughItsSceneHasNoNumber)
{
    GltfContainer container = read_gltf_container(read_file(folder / "shirt.glb"));
    container.json["scene"] = Json::array();
    const MeshFile shirt = MeshFile::read(save("odd.glb", bytes_of(container)));
    const Positions moved = shirt.positions() * 1.25;
    shirt.write(folder / "worn.glb", moved);
    EXPECT_LT((MeshFile::read(folder / "worn.glb").positions() - moved).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(StaleGltf, KeepsItsNodeWhereItStaysNearIt)
{
    const MeshFile shirt = hung_at(2);
    shirt.write(folder / "worn.glb", shirt.positions() * 1.25);
    EXPECT_EQ(json_of("worn.glb")["nodes"], [&] {
        Json nodes = json_of("hung.glb")["nodes"];
        for (Json& node : nodes)
            node.erase("weights");
        return nodes;
    }());
}

TEST_F(StaleGltf, LeavesMeshesInTheirOrder)
{
    const fixtures::Person person = fixtures::capsule_person();
    TriangleMesh smaller = person.mesh;
    smaller.positions *= 0.5;
    const Rig rig = fixtures::simple_rig(person);
    write_outfit_glb(folder / "both.glb", rig,
                     { { "skinned", person.mesh, rig.weights }, { "plain", smaller, rig.weights } },
                     { .names = BoneNames::smpl });
    GltfContainer container = read_gltf_container(read_file(folder / "both.glb"));
    for (Json& node : container.json["nodes"])
        if (node.value("name", "") == "plain")
            node.erase("skin");
    const MeshFile both = MeshFile::read(save("both.glb", bytes_of(container)));
    const Positions moved = both.positions() * 1.25;
    both.write(folder / "worn.glb", moved);
    EXPECT_LT((MeshFile::read(folder / "worn.glb").positions() - moved).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(StaleGltf, StaysWhereNothingHasMoved)
{
    const MeshFile shirt = MeshFile::read(folder / "shirt.glb");
    shirt.write(folder / "copy.glb", shirt.positions());
    EXPECT_EQ(json_of("copy.glb"), json_of("shirt.glb"));
}

TEST_F(StaleGltf, IsNotLookedForWhereThereIsNone)
{
    GltfContainer container = read_gltf_container(read_file(folder / "shirt.glb"));
    Json& primitive = container.json["meshes"][0]["primitives"][0];
    primitive.erase("targets");
    primitive["attributes"].erase("TANGENT");
    container.json.erase("animations");
    save("skinned.glb", bytes_of(container));
    EXPECT_EQ(MeshFile::read(folder / "skinned.glb").left_behind(), std::vector<std::string> { "a skin" });
}

}  // namespace
