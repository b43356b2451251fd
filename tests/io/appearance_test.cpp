// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/appearance.h"

#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "file_bytes.h"
#include "garmentfit/io.h"
#include "garmentfit/skinned_gltf.h"
#include "gltf_container.h"
#include "pictures.h"
#include "temporary_folder.h"

namespace {

using namespace garmentfit;
namespace fs = std::filesystem;

using Look = fixtures::TemporaryFolder;

void write_text(const fs::path& path, const std::string& text)
{
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

/// The header of a PNG: nothing here decodes one.
std::string png(int width, int height)
{
    std::string bytes("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
    for (const int side : { width, height })
        for (const int shift : { 24, 16, 8, 0 })
            bytes += char(side >> shift & 255);
    return bytes;
}

/// Two squares that share an edge: one has a seam in its UVs along it. Two materials.
const std::string k_obj = "mtllib a cloth.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
                          "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0 0\nvt 0.5 0.25\n"
                          "usemtl blue cotton\nf 1/1 2/2 3/3 4/4\nusemtl lace\nf 2/5 5/2 6/3 3/6\n";
const std::string k_mtl = "# by hand\nnewmtl blue cotton\nKd 0.1 0.2 0.3\nmap_Kd -s 1 1 1 tex/my weave.png\nNs 10\r\n"
                          "newmtl lace\nKd 1 1 1\nd 0.5\nmap_Kd gone.png\nmap_d holes.png\n";

fs::path write_cloth(const fs::path& folder)
{
    write_text(folder / "cloth.obj", k_obj);
    write_text(folder / "a cloth.mtl", k_mtl);
    write_text(folder / "tex" / "my weave.png", png(64, 32));
    return folder / "cloth.obj";
}

bool mentions(const std::vector<std::string>& warnings, const std::string& text)
{
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const std::string& w) { return w.find(text) != std::string::npos; });
}

TEST_F(Look, OfObjHasItsMaterialsUvsAndPictures)
{
    const Appearance look = MeshFile::read(write_cloth(folder)).appearance();
    ASSERT_EQ(look.materials.size(), 2u);
    EXPECT_EQ(look.materials[0].name, "blue cotton");
    ASSERT_EQ(look.pictures.size(), 1u);
    EXPECT_EQ(look.pictures[0].mime_type, "image/png");
    EXPECT_EQ(look.pictures[0].bytes, png(64, 32));
    EXPECT_EQ(look.materials[0].colour_picture, 0);
    EXPECT_EQ(look.materials[1].colour_picture, -1);
    EXPECT_EQ(look.materials[1].alpha, "BLEND");
    EXPECT_EQ(look.materials[1].colour[3], 0.5);
    EXPECT_EQ(look.material_of, (std::vector<int> { 0, 0, 1, 1 }));
    ASSERT_EQ(look.uv_corners.rows(), 4);
    EXPECT_EQ(look.uvs.rows(), 5) << "equal UVs are one";
    EXPECT_TRUE(look.uvs.row(look.uv_corners(3, 2)).isApprox(Eigen::RowVector2d(0.5, 0.75)));
    EXPECT_TRUE(mentions(look.warnings, "gone.png")) << "a missing texture";
    EXPECT_TRUE(mentions(look.warnings, "map_d"));
}

TEST_F(Look, UvsOfCornersAreThoseOfTheFileInEachFormat)
{
    const CornerUvs of_obj = MeshFile::read(write_cloth(folder)).corner_uvs();
    ASSERT_EQ(of_obj.rows(), 4);
    EXPECT_TRUE(of_obj.row(3).tail<2>().isApprox(Eigen::RowVector2d(0.5, 0.75))) << "v from the top, as in glTF";
    write_text(folder / "cloth.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "property float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\n"
               "end_header\n0 0 0 0.25 0.5\n1 0 0 1 0.5\n0 1 0 0.25 1\n3 2 0 1\n");
    const CornerUvs of_ply = MeshFile::read(folder / "cloth.ply").corner_uvs();
    ASSERT_EQ(of_ply.rows(), 1);
    CornerUvs expected(1, 6);
    expected << 0.25, 1, 0.25, 0.5, 1, 0.5;
    EXPECT_EQ(of_ply, expected);
    write_text(folder / "half.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\nf 1 3 4\n");
    const CornerUvs of_half = MeshFile::read(folder / "half.obj").corner_uvs();
    ASSERT_EQ(of_half.rows(), 2);
    EXPECT_TRUE(of_half.row(0).allFinite());
    EXPECT_FALSE(of_half.row(1).array().isFinite().any());
    write_text(folder / "bare.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    EXPECT_EQ(MeshFile::read(folder / "bare.obj").corner_uvs().rows(), 0);
}

TEST_F(Look, UvsOfFacesInPlyAreThoseOfTheirCorners)
{
    const std::string header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                               "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
                               "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    write_text(folder / "wedges.ply", header + "4 0 1 2 3 8 0 0 1 0 1 1 0 1\n3 0 1 2 0\n");
    const CornerUvs uvs = MeshFile::read(folder / "wedges.ply").corner_uvs();
    ASSERT_EQ(uvs.rows(), 3) << "the first face has four corners";
    CornerUvs expected(2, 6);
    expected << 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1;
    EXPECT_EQ(uvs.topRows(2), expected);
    EXPECT_FALSE(uvs.row(2).array().isFinite().any()) << "an empty list";
    write_text(folder / "none.ply", header + "4 0 1 2 3 0\n3 0 1 2 0\n");
    EXPECT_EQ(MeshFile::read(folder / "none.ply").corner_uvs().rows(), 0);
}

TEST_F(Look, OfObjHasNoMaterialForLooseEdges)
{
    write_cloth(folder);
    write_text(folder / "cloth.obj", k_obj + "f 1/1 2/2\nf 3\nf 1/1 2/2 3/3\n");
    const Appearance look = MeshFile::read(folder / "cloth.obj").appearance();
    EXPECT_EQ(look.material_of, (std::vector<int> { 0, 0, 1, 1, 1 }));
    EXPECT_EQ(look.uv_corners.rows(), 5);
}

TEST_F(Look, OfObjWithoutItsFilesIsAWarning)
{
    write_text(folder / "cloth.obj", k_obj);
    const Appearance look = MeshFile::read(folder / "cloth.obj").appearance();
    EXPECT_TRUE(look.materials.empty());
    EXPECT_TRUE(look.material_of.empty());
    EXPECT_EQ(look.uv_corners.rows(), 4);
    EXPECT_TRUE(mentions(look.warnings, "cloth.mtl"));
}

TEST_F(Look, CompanionsAreNamedAsTheFilesNameThem)
{
    const std::vector<std::string> expected { "a cloth.mtl", "gone.png", "holes.png", "tex/my weave.png" };
    EXPECT_EQ(MeshFile::read(write_cloth(folder)).companions(), expected);
}

TEST_F(Look, OfManglesIsNeverAnError)
{
    write_text(folder / "cloth.obj",
               "mtllib m.mtl\nmtllib\nusemtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt\nvt x nan\n"
               "f 1/9 2/-7 3/1\nf 1/ 2// 3/x\n");
    write_text(folder / "m.mtl", "Kd 1\nnewmtl\nmap_Kd\nmap_Kd -s\nmap_Kd -bm\nKd inf nan x\nmap_Kd .\nmap_Ke m.mtl\n");
    const Appearance look = MeshFile::read(folder / "cloth.obj").appearance();
    EXPECT_TRUE(look.uvs.allFinite());
    EXPECT_LT(look.uv_corners.maxCoeff(), look.uvs.rows());
    EXPECT_TRUE(look.pictures.empty());
    EXPECT_TRUE(mentions(look.warnings, "neither PNG nor JPEG"));
}

TEST(Pictures, TellTheirTypeAndSize)
{
    EXPECT_EQ(picture_size(png(16384, 20)), std::pair(16384, 20));
    const std::string jpeg("\xFF\xD8\xFF\xE0\0\4xx\xFF\xC0\0\21\10\1\0\2\0\3", 18);
    EXPECT_EQ(picture_type(jpeg), "image/jpeg");
    EXPECT_EQ(picture_size(jpeg), std::pair(512, 256));
    EXPECT_EQ(picture_size(jpeg.substr(0, 12)), std::pair(0, 0));
    EXPECT_EQ(picture_type("BM"), "");
    EXPECT_NE(warning_of_size("huge.png", png(16384, 20)).find("16384 x 20"), std::string::npos);
    EXPECT_EQ(warning_of_size("large.png", png(8192, 8192)), "");
}

SkinWeights on_root_bone(Eigen::Index rows)
{
    SkinWeights weights;
    weights.bones.setZero(rows, 4);
    weights.weights.setZero(rows, 4);
    weights.weights.col(0).setOnes();
    return weights;
}

nlohmann::ordered_json json_of(const fs::path& glb) { return read_gltf_container(read_file(glb)).json; }

TEST_F(Look, GoesIntoOutfitsAndIsReadBack)
{
    const MeshFile file = MeshFile::read(write_cloth(folder));
    const SkinnedMesh cloth { "cloth", { file.positions(), file.triangles() }, on_root_bone(6), file.appearance() };
    write_skinned_glb(folder / "outfit.glb", Skeleton(), { { "body", cloth.surface, cloth.weights }, cloth });

    const auto json = json_of(folder / "outfit.glb");
    ASSERT_EQ(json.at("meshes").size(), 2u);
    EXPECT_FALSE(json.at("meshes")[0].at("primitives")[0].contains("material"));
    const auto& primitives = json.at("meshes")[1].at("primitives");
    ASSERT_EQ(primitives.size(), 2u) << "one for each material";
    EXPECT_EQ(primitives[0].at("attributes"), primitives[1].at("attributes")) << "the same vertices";
    EXPECT_EQ(json.at("materials")[primitives[1].at("material").get<std::size_t>()].at("name"), "lace");
    EXPECT_EQ(json.at("images").size(), 1u);

    const MeshFile outfit = MeshFile::read(folder / "outfit.glb");
    ASSERT_EQ(outfit.positions().rows(), 6 + 8) << "two vertices have two UVs each";
    EXPECT_TRUE(outfit.positions().middleRows(6, 6).isApprox(file.positions())) << "the order of the file";
    const Appearance read = outfit.appearance(), given = file.appearance();
    EXPECT_TRUE(read.warnings.empty());
    ASSERT_EQ(read.pictures.size(), 1u);
    EXPECT_EQ(read.pictures[0].bytes, given.pictures[0].bytes);
    ASSERT_EQ(read.materials.size(), 2u);
    EXPECT_EQ(read.materials[0].colour_picture, 0);
    EXPECT_EQ(read.materials[1].alpha, "BLEND");
    EXPECT_EQ(read.material_of, (std::vector<int> { -1, -1, -1, -1, 0, 0, 1, 1 }));
    for (int f = 0; f < 4; ++f)
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(read.uv_corners(f, k), -1);
            EXPECT_TRUE(read.uvs.row(read.uv_corners(f + 4, k)).isApprox(given.uvs.row(given.uv_corners(f, k))));
            EXPECT_TRUE(outfit.positions()
                            .row(outfit.triangles()(f + 4, k))
                            .isApprox(file.positions().row(file.triangles()(f, k))));
        }
}

TEST_F(Look, OfPicturesBesideAGltfIsKept)
{
    const MeshFile file = MeshFile::read(write_cloth(folder));
    write_skinned_glb(folder / "outfit.glb", Skeleton(),
                      { { "cloth", { file.positions(), file.triangles() }, on_root_bone(6), file.appearance() } });
    GltfContainer container = read_gltf_container(read_file(folder / "outfit.glb"));
    container.json["images"][0] = { { "uri", "tex/my%20weave.png" } };
    write_text(folder / "other.glb", bytes_of(container));
    EXPECT_EQ(MeshFile::read(folder / "other.glb").appearance().pictures.at(0).bytes, png(64, 32));
    fs::remove(folder / "tex" / "my weave.png");
    const Appearance without = MeshFile::read(folder / "other.glb").appearance();
    EXPECT_TRUE(without.pictures.empty());
    EXPECT_EQ(without.materials.size(), 2u);
    const MeshFile other = MeshFile::read(folder / "other.glb");
    EXPECT_TRUE(mentions(other.warnings(), "tex/my weave.png cannot be read"));
    other.write(folder / "moved.glb", 2 * other.positions());
    EXPECT_EQ(file_of_picture(read_gltf_container(read_file(folder / "moved.glb")).json["images"][0]), "")
        << "viewers refuse a file whose pictures are missing";
}

TEST_F(Look, OfMangledUvsIsAWarningForEachMaterial)
{
    const MeshFile file = MeshFile::read(write_cloth(folder));
    write_skinned_glb(folder / "outfit.glb", Skeleton(),
                      { { "cloth", { file.positions(), file.triangles() }, on_root_bone(6), file.appearance() } });
    GltfContainer container = read_gltf_container(read_file(folder / "outfit.glb"));
    const auto uvs = container.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"].get<std::size_t>();
    container.json["accessors"][uvs]["type"] = "SCALAR";
    write_text(folder / "mangled.glb", bytes_of(container));
    const Appearance look = MeshFile::read(folder / "mangled.glb").appearance();
    EXPECT_EQ(look.uvs.rows(), 0);
    EXPECT_EQ(look.uv_corners.rows(), 0);
    EXPECT_EQ(look.materials.size(), 2u);
    EXPECT_TRUE(mentions(look.warnings, "TEXCOORD_0"));
}

TEST_F(Look, CoveredFacesAreLeftOutAndTheMaskStays)
{
    const MeshFile file = MeshFile::read(write_cloth(folder));
    SkinnedMesh body { "body", { file.positions(), file.triangles() }, on_root_bone(6), file.appearance() };
    body.covered = { 1, 1, 1, 1, 0, 0 };
    body.hides_covered = true;
    write_skinned_glb(folder / "outfit.glb", Skeleton(), { body });
    EXPECT_EQ(MeshFile::read(folder / "outfit.glb").triangles().rows(), 2);
    const auto json = json_of(folder / "outfit.glb");
    const auto& primitives = json.at("meshes")[0].at("primitives");
    ASSERT_EQ(primitives.size(), 1u) << "nothing of the other material is left";
    EXPECT_TRUE(primitives[0].at("attributes").contains("_COVERED"));
    body.covered.assign(6, 1);
    write_skinned_glb(folder / "none.glb", Skeleton(), { body });
    EXPECT_EQ(MeshFile::read(folder / "none.glb").triangles().rows(), 4) << "glTF knows no empty mesh";
}

TEST_F(Look, OfLargePicturesIsKeptWithAWarning)
{
    write_text(write_cloth(folder).parent_path() / "tex" / "my weave.png", png(16384, 16384));
    const MeshFile file = MeshFile::read(folder / "cloth.obj");
    EXPECT_EQ(file.appearance().pictures.size(), 1u);
    EXPECT_TRUE(mentions(file.appearance().warnings, "my weave.png has 16384 x 16384 pixels"));
    write_skinned_glb(folder / "outfit.glb", Skeleton(),
                      { { "cloth", { file.positions(), file.triangles() }, on_root_bone(6), file.appearance() } });
    EXPECT_TRUE(mentions(MeshFile::read(folder / "outfit.glb").warnings(), "has 16384 x 16384 pixels"));
}

/// What materials and pictures a mesh has in its new place: the colour of the first material, and its picture.
std::pair<double, std::string> look_at(const fs::path& obj)
{
    const Appearance look = MeshFile::read(obj).appearance();
    return { look.materials.at(0).colour[2], look.pictures.at(0).bytes };
}

TEST_F(Look, OfFilesWithEqualNamesFromOtherFoldersStaysTheirOwn)
{
    for (const char* part : { "a", "b", "c" })
        write_cloth(folder / part);
    write_text(folder / "b" / "tex" / "my weave.png", png(8, 8));
    fs::rename(folder / "b" / "cloth.obj", folder / "b" / "a skirt.obj");
    fs::rename(folder / "c" / "cloth.obj", folder / "c" / "copy.obj");
    const fs::path out = folder / "out";
    fs::create_directories(out);
    for (const char* name : { "a/cloth.obj", "b/a skirt.obj", "c/copy.obj" }) {
        const MeshFile file = MeshFile::read(folder / name);
        file.write_with_companions(out / file.path().filename(), 2 * file.positions());
    }
    EXPECT_EQ(look_at(out / "cloth.obj"), std::pair(1.0, png(64, 32)));
    EXPECT_EQ(look_at(out / "a skirt.obj"), std::pair(1.0, png(8, 8)));
    EXPECT_EQ(look_at(out / "copy.obj"), std::pair(1.0, png(64, 32)));
    EXPECT_TRUE(fs::exists(out / "a_skirt" / "tex" / "my weave.png"));
    EXPECT_FALSE(fs::exists(out / "copy")) << "equal files need no folder";
    EXPECT_EQ(MeshFile::read(out / "a skirt.obj").positions(), 2 * MeshFile::read(folder / "a/cloth.obj").positions());
}

TEST_F(Look, SaysWhichCompanionsAreNotCopied)
{
    write_cloth(folder / "in");
    write_text(folder / "in" / "cloth.obj", "mtllib ../far.mtl\n" + k_obj);
    const std::vector<std::string> lost = MeshFile::read(folder / "in" / "cloth.obj").lost_companions();
    ASSERT_EQ(lost.size(), 3u);
    EXPECT_TRUE(mentions(lost, "../far.mtl lies outside"));
    EXPECT_TRUE(mentions(lost, "gone.png is missing"));
    EXPECT_TRUE(mentions(lost, "holes.png is missing"));
}

}  // namespace
