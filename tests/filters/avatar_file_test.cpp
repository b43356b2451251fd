// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/avatar_file.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "fixtures.h"
#include "garmentfit/skinned_gltf.h"
#include "temporary_folder.h"

namespace garmentfit {
namespace {

using namespace fixtures;

struct FileOfBody : TemporaryFolder {
    void SetUp() override
    {
        TemporaryFolder::SetUp();
        file = folder / "woman.glb";
        write_skinned_glb(file, person.mesh, simple_rig(person));
    }

    const Person person = capsule_person();
    const Positions body = person.mesh.positions;
    const Frame metres = {};
    std::filesystem::path file;
};

TEST_F(FileOfBody, HasTheSameVerticesWhereTheBodyWasReadAsItIs)
{
    const Positions kept = body.cast<float>().cast<double>();
    const auto avatar = avatar_of_body(file, kept, metres);
    ASSERT_TRUE(avatar);
    EXPECT_EQ(avatar->path, file);
    EXPECT_TRUE(avatar->file_rows.empty() && avatar->body_rows.empty());
}

TEST_F(FileOfBody, HasItsOwnUnitsAndAxes)
{
    const Frame other { 0.01, Vec3::UnitZ() };
    auto avatar = avatar_of_body(file, body, other);
    ASSERT_TRUE(avatar);
    EXPECT_EQ(avatar->frame.metres_per_unit, 1);
    EXPECT_EQ(avatar->frame.up, Vec3::UnitY());

    write_skinned_glb(folder / "tall.glb", { body / 0.01, person.mesh.triangles }, simple_rig(person));
    avatar = avatar_of_body(folder / "tall.glb", body, other);
    ASSERT_TRUE(avatar);
    EXPECT_EQ(avatar->frame.metres_per_unit, 0.01);
    EXPECT_EQ(avatar->frame.up, Vec3::UnitY());
}

TEST_F(FileOfBody, IsMatchedByPlacesWhereVerticesWereReorderedMergedAndLeftOut)
{
    const int n = int(body.rows()), doubled = 7, left_out = 5;
    TriangleMesh in_file = person.mesh;  // a vertex twice, as on a seam
    in_file.positions.conservativeResize(n + 1, 3);
    in_file.positions.row(n) = body.row(doubled);
    in_file.triangles.row(0) = in_file.triangles.row(0).unaryExpr([&](int v) { return v == doubled ? n : v; });
    Person seamed = person;
    seamed.mesh = in_file;
    write_skinned_glb(folder / "seamed.glb", in_file, simple_rig(seamed));

    std::vector<int> order(std::size_t(n) - left_out);  // of the body's vertices, by rows of the file
    std::iota(order.begin(), order.end(), left_out);
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    const auto avatar = avatar_of_body(folder / "seamed.glb", body(order, Eigen::all), metres);
    ASSERT_TRUE(avatar);
    ASSERT_EQ(avatar->file_rows.size(), order.size());
    ASSERT_EQ(avatar->body_rows.size(), std::size_t(n) + 1);
    for (std::size_t v = 0; v < order.size(); ++v) {
        EXPECT_TRUE(avatar->file_rows[v] == order[v] || (order[v] == doubled && avatar->file_rows[v] == n)) << v;
        EXPECT_EQ(avatar->body_rows[std::size_t(order[v])], int(v));
    }
    for (int v = 0; v < left_out; ++v)
        EXPECT_EQ(avatar->body_rows[std::size_t(v)], -1);
    EXPECT_EQ(avatar->body_rows[std::size_t(n)], avatar->body_rows[doubled]);
}

TEST_F(FileOfBody, IsRefusedWhereItsVerticesLieElsewhere)
{
    const std::string words = "do not lie where any of its " + std::to_string(body.rows()) + " do; give the file that";
    expect_invalid([&] { avatar_of_body(file, body.rowwise() + Vec3(0.1, 0, 0).transpose(), metres); }, words);
    expect_invalid([&] { avatar_of_body(file, 1.06 * body, metres); }, words);
    const Person other = capsule_person({ .arm_angle = 0 });
    expect_invalid([&] { avatar_of_body(file, other.mesh.positions, metres); }, words);
}

TEST_F(FileOfBody, IsNoneWithoutASkin)
{
    write_ply(folder / "woman.ply", body, person.mesh.triangles);
    EXPECT_FALSE(avatar_of_body(folder / "woman.ply", body, metres));
}

TEST_F(FileOfBody, IsRefusedWhereItIsMissingOrBroken)
{
    expect_invalid([&] { avatar_of_body(folder / "gone.glb", body, metres); }, "gone.glb");
    const std::string whole = load(file);
    expect_invalid([&] { avatar_of_body(save("cut.glb", whole.substr(0, whole.size() / 2)), body, metres); },
                   "cut.glb");
}

}  // namespace
}  // namespace garmentfit
