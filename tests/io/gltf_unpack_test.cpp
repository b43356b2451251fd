// SPDX-License-Identifier: GPL-3.0-or-later
#include "gltf_unpack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "packed_gltf_samples.h"
#include "temporary_folder.h"

namespace {

using namespace garmentfit;
using fixtures::expect_invalid;
using nlohmann::ordered_json;

/// The sample of mesh_file_samples.h, packed in several ways.
class PackedGltf : public fixtures::TemporaryFolder, public samples::PackedGltf {
protected:
    MeshFile read() { return MeshFile::read(save("packed.gltf", json.dump())); }
    MeshFile whole() { return MeshFile::read(save("plain.glb", samples::glb())); }

    void expect_as_whole(const MeshFile& packed, double tolerance)
    {
        const MeshFile expected = whole();
        ASSERT_EQ(packed.positions().rows(), expected.positions().rows());
        EXPECT_LE((packed.positions() - expected.positions()).cwiseAbs().maxCoeff(), tolerance);
        EXPECT_EQ(packed.triangles(), expected.triangles());
    }

    void expect_written_in_plain(const MeshFile& packed)
    {
        Positions moved = packed.positions();
        moved.col(1).array() += 0.25;
        packed.write(folder / "out.gltf", moved);
        const ordered_json written = ordered_json::parse(load(folder / "out.gltf"));
        EXPECT_FALSE(written.contains("extensionsRequired")) << written.dump();
        EXPECT_EQ(written["materials"][0]["name"], "linen");
        const MeshFile again = MeshFile::read(folder / "out.gltf");
        EXPECT_LT((again.positions() - moved).cwiseAbs().maxCoeff(), 1e-6);
        EXPECT_EQ(again.triangles(), packed.triangles());
    }
};

TEST_F(PackedGltf, IsReadAndWrittenWhereMeshoptPackedIt)
{
    pack_with_meshopt();
    const MeshFile packed = read();
    expect_as_whole(packed, 0);
    expect_written_in_plain(packed);
}

TEST_F(PackedGltf, IsReadWherePositionsAreIntegers)
{
    require("KHR_mesh_quantization");
    add_buffer(plain);
    const MeshFile expected = whole();
    std::string bytes;
    for (std::size_t v = 0; v < k_vertices; ++v)
        for (std::size_t k = 0; k < 4; ++k) {  // three numbers, and two bytes up to a multiple of four
            float value = 0;
            if (k < 3)
                std::memcpy(&value, plain.data() + v * k_stride + k * sizeof value, sizeof value);
            const auto integer = std::int16_t(std::lround(value * 32767));
            bytes.append(reinterpret_cast<const char*>(&integer), sizeof integer);
        }
    const int view = add_view(bytes);
    json["bufferViews"][std::size_t(view)]["byteStride"] = 8;
    json["accessors"][0]
        = { { "bufferView", view }, { "componentType", 5122 }, { "normalized", true },        { "count", 4 },
            { "type", "VEC3" },     { "min", { 0, 0, 0 } },    { "max", { 32767, 32767, 0 } } };
    const MeshFile packed = read();
    expect_as_whole(packed, 1e-4);
    expect_written_in_plain(packed);
}

TEST_F(PackedGltf, IsReadWhereAFewPositionsReplaceOthers)
{
    add_buffer(plain);
    const std::array<float, 3> place { 0.5F, 2, 3 };
    const std::array<std::uint16_t, 2> row { 2, 0 };
    const std::string values(reinterpret_cast<const char*>(place.data()), sizeof place),
        rows(reinterpret_cast<const char*>(row.data()), sizeof row);
    json["accessors"][0]["sparse"] = { { "count", 1 },
                                       { "indices", { { "bufferView", add_view(rows) }, { "componentType", 5123 } } },
                                       { "values", { { "bufferView", add_view(values) } } } };
    const Positions read_back = read().positions(), before = whole().positions();
    EXPECT_EQ(read_back.row(0), before.row(0));
    EXPECT_LT((Vec3(read_back.row(2)) - Vec3(1 + 2 * 0.5, 4, 6)).norm(), 1e-6);  // the node's scale and place
}

TEST_F(PackedGltf, IsReadAndWrittenWhereDracoPackedIt)
{
    pack_with_draco(draco_square());
    const MeshFile packed = read();
    ASSERT_EQ(packed.positions().rows(), 4);
    ASSERT_EQ(packed.triangles().rows(), 2);
    double area = 0;
    for (const auto& t : packed.triangles().rowwise())
        area += 0.5
            * Vec3(packed.positions().row(t[1]) - packed.positions().row(t[0]))
                  .cross(Vec3(packed.positions().row(t[2]) - packed.positions().row(t[0])))
                  .z();
    EXPECT_NEAR(area, 4, 1e-3);
    expect_written_in_plain(packed);
}

TEST_F(PackedGltf, HasTheBoundsOfWhatDracoRounded)
{
    pack_with_draco(draco_square());
    json["accessors"][0]["min"] = { -0.01, -0.01, -0.01 };
    json["accessors"][0]["max"] = { 1.01, 1.01, 0.01 };
    const ordered_json accessor
        = read_plain_gltf(read_file(save("packed.gltf", json.dump())), folder).json.at("accessors")[0];
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(accessor.at("min")[k].get<double>(), 0, 1e-4);
        EXPECT_NEAR(accessor.at("max")[k].get<double>(), k < 2 ? 1 : 0, 1e-4);
    }
}

TEST_F(PackedGltf, InstancesHaveTheirOwnVertices)
{
    add_buffer(plain);
    json["meshes"].push_back(json["meshes"][0]);  // another mesh of the same vertices
    json["nodes"].push_back({ { "mesh", 1 }, { "translation", { 0, 0, 5 } } });
    json["nodes"].push_back({ { "mesh", 0 } });
    for (const int node : { 2, 3 })
        json["scenes"][0]["nodes"].push_back(node);
    const MeshFile thrice = read(), once = whole();
    const Eigen::Index n = once.positions().rows();
    ASSERT_EQ(thrice.positions().rows(), 3 * n);
    ASSERT_EQ(thrice.triangles().rows(), 3 * once.triangles().rows());
    EXPECT_EQ(thrice.positions().topRows(n), once.positions());
    EXPECT_EQ(thrice.positions().row(n), Eigen::RowVector3d(0, 0, 5));
    EXPECT_EQ(thrice.positions().row(2 * n), Eigen::RowVector3d(0, 0, 0));
    Positions moved = thrice.positions();
    moved.bottomRows(n).col(1).array() += 0.25;
    thrice.write(folder / "out.gltf", moved);
    EXPECT_LT((MeshFile::read(folder / "out.gltf").positions() - moved).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(PackedGltf, IsRefusedInWordsWhereItIsMangled)
{
    const auto expect = [&](const char* words, const std::function<void()>& mangle) {
        const ordered_json before = json;
        mangle();
        expect_invalid([&] { read(); }, words);
        json = before;
    };
    expect("cannot be decoded", [&] { pack_with_draco(draco_square().substr(0, 20)); });
    expect("no attribute", [&] {
        pack_with_draco(draco_square());
        json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 7;
    });
    pack_with_meshopt();
    const auto packed
        = [&]() -> ordered_json& { return json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]; };
    expect("cannot be decoded", [&] { packed()["byteLength"] = 9; });
    expect("beyond buffer", [&] { packed()["byteLength"] = 9999; });
    expect("2 GB", [&] { packed()["count"] = 4000000000u; });
    expect("mangled", [&] { packed().erase("count"); });
    expect("filter", [&] { packed()["filter"] = "QUATERNION"; });
}

// A file from anywhere ends in a mesh or in an error, whatever its packed bytes are.
TEST_F(PackedGltf, EndsWellWhateverItsBytesAre)
{
    constexpr int k_rounds = 1000;
    std::mt19937 random(7);
    const auto expect_end = [&] {
        try {
            read();
        } catch (const InvalidInput& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    };
    const auto mangled = [&](std::string bytes) {
        for (unsigned changes = 1 + random() % 4; changes > 0; --changes)
            bytes[random() % bytes.size()] = char(random());
        return random() % 4 == 0 ? bytes.substr(0, random() % bytes.size()) : bytes;
    };
    const std::string square = draco_square();
    const ordered_json whole = json;
    for (int round = 0; round < k_rounds; ++round) {
        json = whole;
        pack_with_draco(mangled(square));
        expect_end();
    }
    json = whole;
    pack_with_meshopt();
    const ordered_json packed = json;
    for (int round = 0; round < k_rounds; ++round) {
        json = packed;
        for (const std::size_t view : { 0, 1 }) {
            ordered_json& part = json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
            std::string bytes(part["byteLength"].get<std::size_t>(), '\0');
            std::generate(bytes.begin(), bytes.end(), [&] { return char(random()); });
            bytes[0] = char(view == 0 ? 0xa0 : 0xd1);  // the headers of such data
            part["buffer"] = add_buffer(bytes);
        }
        expect_end();
    }
}

}  // namespace
