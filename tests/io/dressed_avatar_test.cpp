// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cstring>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "file_bytes.h"
#include "fixtures.h"
#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/skinned_gltf.h"
#include "gltf_container.h"
#include "temporary_folder.h"

namespace {

using namespace garmentfit;
using Json = nlohmann::ordered_json;

constexpr int k_triangles = 20;

/// A strip of cloth beside the body.
TriangleMesh strip()
{
    TriangleMesh mesh { Positions(k_triangles + 2, 3), Triangles(k_triangles, 3) };
    for (int v = 0; v < k_triangles + 2; ++v)
        mesh.positions.row(v) << 0.3 + 0.1 * (v % 2), 1 + 0.02 * v, 0.1;
    for (int t = 0; t < k_triangles; ++t)
        mesh.triangles.row(t) << t, t + 1 + t % 2, t + 2 - t % 2;
    return mesh;
}

/// With a material, a picture and UVs.
Appearance printed(const TriangleMesh& mesh)
{
    Appearance look;
    look.pictures = { { "print", "image/png", "\x89PNG no picture" } };
    look.materials = { { .name = "printed cloth", .colour_picture = 0 } };
    look.material_of.assign(std::size_t(mesh.triangles.rows()), 0);
    look.uvs.setZero(mesh.positions.rows(), 2);
    look.uv_corners = mesh.triangles;
    return look;
}

class DressedAvatar : public fixtures::TemporaryFolder {
protected:
    void SetUp() override
    {
        TemporaryFolder::SetUp();
        write_skinned_glb(folder / "plain.glb", person.mesh, rig);
        GltfContainer container = read_gltf_container(read_file(folder / "plain.glb"));
        container.json["extensions"]
            = { { "VRM", { { "materialProperties", Json::array() }, { "meta", { { "title", "Ada" } } } } } };
        container.json["extensionsUsed"] = { "VRM" };
        container.json["animations"]
            = { { { "name", "nod" },
                  { "samplers", { { { "input", 0 }, { "output", 1 } } } },
                  { "channels", { { { "sampler", 0 }, { "target", { { "node", 3 }, { "path", "rotation" } } } } } } } };
        container.json["materials"] = { { { "name", "skin" } } };
        save("avatar.glb", bytes_of(container));
        avatar = container.json;
    }

    AvatarGarment garment_on(int joint) const
    {
        const JointWeights all = read_joint_weights(folder / "avatar.glb");
        const TriangleMesh mesh = strip();
        JointWeights weights(mesh.positions.rows(), all.cols());
        for (Eigen::Index v = 0; v < weights.rows(); ++v)
            weights.insert(v, joint) = 1;
        return { "strip", mesh, weights, printed(mesh) };
    }

    static Json json_of(const std::filesystem::path& glb) { return read_gltf_container(read_file(glb)).json; }

    const fixtures::Person person = fixtures::capsule_person({ .arm_angle = 60, .elbow_angle = 30 });
    const Rig rig = fixtures::simple_rig(person);
    Json avatar;
};

/// What a list had stands first in the other one, unchanged.
void expect_kept(const Json& before, const Json& after, const char* list)
{
    ASSERT_GE(after.at(list).size(), before.at(list).size()) << list;
    for (std::size_t i = 0; i < before.at(list).size(); ++i)
        EXPECT_EQ(after.at(list)[i], before.at(list)[i]) << list << ' ' << i;
}

TEST_F(DressedAvatar, KeepsAllThatTheFileHas)
{
    write_dressed_avatar(folder / "out.glb", folder / "avatar.glb", { garment_on(4) });
    const Json json = json_of(folder / "out.glb");
    for (const char* list : { "nodes", "meshes", "skins", "accessors", "animations", "materials" })
        expect_kept(avatar, json, list);
    EXPECT_EQ(json.at("extensionsUsed"), avatar.at("extensionsUsed"));
    EXPECT_EQ(json.at("extensions").at("VRM").at("meta"), avatar.at("extensions").at("VRM").at("meta"));
    EXPECT_EQ(json.at("extensions").at("VRM").at("materialProperties").size(), 1u) << "of the garment's material";
    EXPECT_TRUE(is_vrm(folder / "out.glb"));
    EXPECT_FALSE(is_vrm(folder / "plain.glb"));

    const Json node = json.at("nodes").back();
    EXPECT_EQ(node.at("name"), "strip");
    const Json primitive = json.at("meshes").at(node.at("mesh").get<std::size_t>()).at("primitives")[0];
    const Json material = json.at("materials").at(primitive.at("material").get<std::size_t>());
    EXPECT_EQ(material.at("name"), "printed cloth");
    const Json texture
        = json.at("textures")
              .at(material.at("pbrMetallicRoughness").at("baseColorTexture").at("index").get<std::size_t>());
    const Json image = json.at("images").at(texture.at("source").get<std::size_t>());
    const Json view = json.at("bufferViews").at(image.at("bufferView").get<std::size_t>());
    GltfContainer container = read_gltf_container(read_file(folder / "out.glb"));
    EXPECT_EQ(container.own_buffer()->substr(view.at("byteOffset"), view.at("byteLength")), "\x89PNG no picture");
}

TEST_F(DressedAvatar, StandsAtTheRootWithoutTransforms)
{
    GltfContainer container = read_gltf_container(read_file(folder / "avatar.glb"));
    Json& nodes = container.json["nodes"];
    std::size_t skinned = 0;
    while (!nodes[skinned].contains("skin"))
        ++skinned;
    const std::size_t armature = nodes.size();
    nodes.push_back({ { "name", "armature" }, { "children", container.json["scenes"][0]["nodes"] } });
    nodes[skinned]["scale"] = { 2, 2, 2 };
    container.json["scenes"][0]["nodes"] = { armature };
    const std::vector<std::size_t> joints = [&] {
        std::vector<std::size_t> all = nodes[armature]["children"];
        std::erase(all, skinned);
        return all;
    }();
    save("nested.glb", bytes_of(container));

    write_dressed_avatar(folder / "out.glb", folder / "nested.glb", { garment_on(4) });
    const Json json = json_of(folder / "out.glb");
    EXPECT_EQ(json.at("scenes")[0].at("nodes"), (Json { armature, skinned, json.at("nodes").size() - 1 }));
    EXPECT_EQ(json.at("nodes")[armature].at("children"), Json(joints));
    EXPECT_FALSE(json.at("nodes")[skinned].contains("scale"));
    const MeshFile before = MeshFile::read(folder / "nested.glb"), after = MeshFile::read(folder / "out.glb");
    EXPECT_EQ(after.positions().topRows(before.positions().rows()), before.positions());
}

TEST_F(DressedAvatar, ClothesHangOnTheJointsOfTheFile)
{
    const AvatarGarment garment = garment_on(4);
    write_dressed_avatar(folder / "out.glb", folder / "avatar.glb", { garment });
    const MeshFile read = MeshFile::read(folder / "out.glb");
    ASSERT_EQ(read.positions().rows(), person.mesh.positions.rows() + garment.surface.positions.rows());
    EXPECT_LT((read.positions().bottomRows(garment.surface.positions.rows()) - garment.surface.positions)
                  .cwiseAbs()
                  .maxCoeff(),
              1e-6);
    const JointWeights before = read_joint_weights(folder / "avatar.glb"),
                       after = read_joint_weights(folder / "out.glb");
    ASSERT_EQ(after.cols(), before.cols());
    EXPECT_LT((Eigen::MatrixXd(after.topRows(before.rows())) - Eigen::MatrixXd(before)).cwiseAbs().maxCoeff(), 1e-12);
    for (Eigen::Index v = before.rows(); v < after.rows(); ++v)
        EXPECT_EQ(after.coeff(v, 4), 1) << v;
    const Json json = json_of(folder / "out.glb");
    EXPECT_EQ(json.at("skins").back().at("joints").size(), 1) << "only joints that move the clothes";
}

TEST_F(DressedAvatar, LeavesOutCoveredFacesAndMarksThem)
{
    std::vector<char> covered(std::size_t(person.mesh.positions.rows()), 0);
    int hidden = 0;
    for (Eigen::Index v = 0; v < person.mesh.positions.rows(); ++v)
        covered[std::size_t(v)] = person.mesh.positions(v, 1) > 1;
    for (const auto face : person.mesh.triangles.rowwise())
        hidden += covered[std::size_t(face[0])] && covered[std::size_t(face[1])] && covered[std::size_t(face[2])];
    ASSERT_GT(hidden, 100);
    write_dressed_avatar(folder / "out.glb", folder / "avatar.glb", { garment_on(4) }, covered);
    EXPECT_EQ(MeshFile::read(folder / "out.glb").triangles().rows(),
              person.mesh.triangles.rows() - hidden + k_triangles);
    const Json json = json_of(folder / "out.glb");
    const Json mask
        = json.at("accessors")
              .at(json.at("meshes")[0].at("primitives")[0].at("attributes").at("_COVERED").get<std::size_t>());
    EXPECT_EQ(mask.at("count"), person.mesh.positions.rows());

    std::fill(covered.begin(), covered.end(), char(1));
    write_dressed_avatar(folder / "all.glb", folder / "avatar.glb", { garment_on(4) }, covered);
    EXPECT_EQ(MeshFile::read(folder / "all.glb").triangles().rows(), 1 + k_triangles) << "no mesh is empty";
}

TEST_F(DressedAvatar, OfGltfWithBuffersBesideItIsOneGlb)
{
    GltfContainer container = read_gltf_container(read_file(folder / "avatar.glb"));
    save("avatar.bin", *container.own_buffer());
    container.json["buffers"][0]["uri"] = "avatar.bin";
    save("avatar.gltf", container.json.dump());
    write_dressed_avatar(folder / "from_gltf.glb", folder / "avatar.gltf", { garment_on(4) });
    write_dressed_avatar(folder / "from_glb.glb", folder / "avatar.glb", { garment_on(4) });
    EXPECT_EQ(load(folder / "from_gltf.glb"), load(folder / "from_glb.glb"));
}

TEST_F(DressedAvatar, RefusesWhatDoesNotBelongTogether)
{
    AvatarGarment garment = garment_on(4);
    garment.weights = JointWeights(3, garment.weights.cols());
    EXPECT_THROW(write_dressed_avatar(folder / "out.glb", folder / "avatar.glb", { garment }), InvalidInput);
    EXPECT_THROW(write_dressed_avatar(folder / "out.glb", folder / "avatar.glb", { garment_on(4) }, { 1, 0 }),
                 InvalidInput);
    GltfContainer container = read_gltf_container(read_file(folder / "avatar.glb"));
    for (Json& node : container.json["nodes"])
        node.erase("skin");
    save("statue.glb", bytes_of(container));
    EXPECT_THROW(write_dressed_avatar(folder / "out.glb", folder / "statue.glb", { garment_on(4) }), InvalidInput);
    container = read_gltf_container(read_file(folder / "avatar.glb"));
    container.json["extensions"]["VRM"]["materialProperties"] = "none";
    save("odd.glb", bytes_of(container));
    EXPECT_THROW(write_dressed_avatar(folder / "out.glb", folder / "odd.glb", { garment_on(4) }), InvalidInput);
    EXPECT_FALSE(std::filesystem::exists(folder / "out.glb"));
}

/// A picture in the buffer of a GLB, where the format wants it.
std::string picture_in(const std::filesystem::path& glb, std::size_t row)
{
    GltfContainer container = read_gltf_container(read_file(glb));
    const Json image = container.json.at("images").at(row);
    EXPECT_FALSE(image.contains("uri"));
    EXPECT_EQ(image.at("mimeType"), "image/png");
    const Json view = container.json.at("bufferViews").at(image.at("bufferView").get<std::size_t>());
    return container.own_buffer()->substr(view.at("byteOffset"), view.at("byteLength"));
}

TEST_F(DressedAvatar, HasPicturesThatLayBesideItInItsBuffer)
{
    const std::string png = "\x89PNG\r\n\x1a\n is told by its start";
    save("skin.png", png);
    GltfContainer container = read_gltf_container(read_file(folder / "avatar.glb"));
    container.json["images"] = { { { "uri", "skin.png" } } };
    container.json["textures"] = { { { "source", 0 } } };
    container.json["materials"] = { { { "pbrMetallicRoughness", { { "baseColorTexture", { { "index", 0 } } } } } } };
    save("shown.glb", bytes_of(container));
    write_dressed_avatar(folder / "out.glb", folder / "shown.glb", { garment_on(4) });
    EXPECT_EQ(picture_in(folder / "out.glb", 0), png);
}

TEST_F(DressedAvatar, WithoutItsPicturesIsAGoodFileThatSaysSo)
{
    GltfContainer container = read_gltf_container(read_file(folder / "avatar.glb"));
    container.json["images"] = { { { "uri", "skin.png" } }, { { "uri", "relief.png" } }, { { "uri", "glow.png" } } };
    container.json["textures"] = { { { "source", 0 } }, { { "source", 1 } }, { { "source", 2 } } };
    container.json["materials"] = { { { "pbrMetallicRoughness", { { "baseColorTexture", { { "index", 0 } } } } },
                                      { "normalTexture", { { "index", 1 } } },
                                      { "emissiveTexture", { { "index", 2 } } } } };
    save("bare.glb", bytes_of(container));
    const std::vector<std::string> warnings = MeshFile::read(folder / "bare.glb").warnings();
    ASSERT_EQ(warnings.size(), 3u);
    EXPECT_EQ(warnings[0], "texture skin.png cannot be read; put it beside the file");

    write_dressed_avatar(folder / "out.glb", folder / "bare.glb", { garment_on(4) });
    std::set<std::string> different;
    for (std::size_t i = 0; i < 3; ++i)
        different.insert(picture_in(folder / "out.glb", i));
    EXPECT_EQ(different.size(), 3u) << "white, flat and black";
    for (const std::string& picture : different)
        EXPECT_EQ(picture.substr(0, 4), "\x89PNG");
    EXPECT_TRUE(MeshFile::read(folder / "out.glb").warnings().empty());
}

/// Numbers of an accessor of the body in a GLB, a row for each vertex.
Eigen::MatrixXf rows_of_body(const std::filesystem::path& glb, const char* attribute)
{
    GltfContainer container = read_gltf_container(read_file(glb));
    const Json& json = container.json;
    const Json accessor
        = json.at("accessors").at(json.at("meshes")[0].at("primitives")[0].at("attributes").at(attribute).get<int>());
    const Json view = json.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
    EXPECT_EQ(accessor.at("componentType"), 5126);
    Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor> rows(accessor.at("count").get<int>(), 4);
    std::memcpy(rows.data(), container.own_buffer()->data() + view.value("byteOffset", 0), 4 * rows.size());
    return rows;
}

TEST_F(DressedAvatar, HasWeightsThatTheFormatAllows)
{
    GltfContainer container = read_gltf_container(read_file(folder / "avatar.glb"));
    const Json& json = container.json;
    const int accessor = json.at("meshes")[0].at("primitives")[0].at("attributes").at("WEIGHTS_0");
    const std::size_t begin
        = json.at("bufferViews")
              .at(json.at("accessors").at(std::size_t(accessor)).at("bufferView").get<std::size_t>())
              .value("byteOffset", std::size_t(0));
    const auto set = [&](int vertex, const std::array<float, 4>& weights) {
        std::memcpy(container.own_buffer()->data() + begin + std::size_t(vertex) * sizeof weights, weights.data(),
                    sizeof weights);
    };
    set(0, { 0.5F, 0.25F, 0, 0 });
    set(1, { 3, 1, 0, 0 });
    set(2, { 0.75F, -0.25F, 0, 0 });
    set(3, { 0, 0, 0, 0 });
    set(4, { std::numeric_limits<float>::quiet_NaN(), 0.5F, 0, 0 });
    set(5, { std::numeric_limits<float>::infinity(), 0.5F, 0, 0 });
    save("bad.glb", bytes_of(container));
    EXPECT_EQ(read_skinned_gltf(folder / "bad.glb").unnormalized_vertices, 5);
    EXPECT_EQ(read_skinned_gltf(folder / "bad.glb").loose_vertices, 1);
    EXPECT_EQ(read_skinned_gltf(folder / "avatar.glb").unnormalized_vertices, 0);

    write_dressed_avatar(folder / "out.glb", folder / "bad.glb", { garment_on(4) });
    const Eigen::MatrixXf weights = rows_of_body(folder / "out.glb", "WEIGHTS_0");
    ASSERT_EQ(weights.rows(), person.mesh.positions.rows());
    EXPECT_GE(weights.minCoeff(), 0);
    EXPECT_LT((weights.rowwise().sum().array() - 1).abs().maxCoeff(), 2e-7);
    EXPECT_NEAR(weights(0, 0), 2.0 / 3, 1e-6);
    EXPECT_EQ(weights(1, 0), 0.75F);
    EXPECT_EQ(weights(2, 0), 1);
    EXPECT_EQ(weights(4, 0), 1) << "of the joint whose weight is a number";
    EXPECT_EQ(weights.row(6), rows_of_body(folder / "avatar.glb", "WEIGHTS_0").row(6));
}

TEST_F(DressedAvatar, KeepsTheEightStrongestJointsOfAVertex)
{
    AvatarGarment garment = garment_on(4);
    for (Eigen::Index v = 0; v < garment.weights.rows(); ++v)
        for (int k = 0; k < 10; ++k)
            garment.weights.coeffRef(v, k) = (k + 1) / 55.0;
    write_dressed_avatar(folder / "out.glb", folder / "avatar.glb", { garment });
    const JointWeights read = read_joint_weights(folder / "out.glb");
    for (Eigen::Index v = read.rows() - garment.weights.rows(); v < read.rows(); ++v) {
        ASSERT_EQ(read.row(v).nonZeros(), 8);
        ASSERT_NEAR(read.row(v).sum(), 1, 1e-6);
        double largest = 0;
        for (JointWeights::InnerIterator entry(read, v); entry; ++entry)
            largest = std::max(largest, entry.value());
        ASSERT_NEAR(largest, 10 / 52.0, 1e-6) << "what the two weakest had goes to the others";
    }
}

}  // namespace
