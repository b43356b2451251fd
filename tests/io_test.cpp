// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/io.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <iterator>

#include "fit/error.h"

namespace {

using namespace fit;

class Io : public testing::Test {
protected:
    void SetUp() override
    {
        const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
        folder = std::filesystem::path(testing::TempDir()) / (std::string("fit_io_") + info->name());
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::filesystem::path save(const std::string& name, const std::string& bytes) const
    {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return folder / name;
    }

    static std::string load(const std::filesystem::path& path)
    {
        std::ifstream stream(path, std::ios::binary);
        return { std::istreambuf_iterator<char>(stream), {} };
    }

    /// What the file looks like after reading it and writing it with `positions`.
    std::string rewritten(const std::string& name, const std::string& bytes, const Positions* positions = nullptr) const
    {
        const MeshFile mesh = MeshFile::read(save(name, bytes));
        mesh.write(folder / ("out_" + name), positions ? *positions : mesh.positions());
        return load(folder / ("out_" + name));
    }

    /// The one-line complaint about a file.
    std::string complaint(const std::filesystem::path& path) const
    {
        try {
            MeshFile::read(path);
        } catch (const InvalidInput& error) {
            return error.what();
        }
        return "no complaint";
    }

    std::filesystem::path folder;
};

const std::string k_ascii_ply = "ply\nformat ascii 1.0\ncomment by hand\nobj_info old\nelement material 1\nproperty list uchar int ids\n"
                                "property float shine\nelement vertex 4\nproperty uchar red\nproperty double x\nproperty double y\n"
                                "property list uchar short tags\nproperty float z\nelement face 1\nproperty list uchar int vertex_index\n"
                                "property int flag\nend_header\n2 5 6 0.50\n255 0 0.10 0 1e-3\n9 1 0.1 2 3 4 0\n7 1.0 1 0 0.25\n8 0 1 1 -5 0\n"
                                "4 0 1 2 3 42\n";

TEST_F(Io, AnAsciiPlyComesBackByteForByte)
{
    EXPECT_EQ(rewritten("a.ply", k_ascii_ply), k_ascii_ply);
    const MeshFile mesh = MeshFile::read(save("a.ply", k_ascii_ply));
    EXPECT_EQ(mesh.format(), "ply");
    ASSERT_EQ(mesh.positions().rows(), 4);
    EXPECT_EQ(Vec3(mesh.positions().row(0)), Vec3(0, 0.1, 1e-3));
    Triangles fan(2, 3);
    fan << 0, 1, 2, 0, 2, 3;
    EXPECT_EQ(mesh.triangles(), fan);
}

TEST_F(Io, AMovedVertexChangesOnlyItsOwnNumbers)
{
    Positions moved = MeshFile::read(save("a.ply", k_ascii_ply)).positions();
    moved.row(2) << 2, 1.0 / 3, 0.1;
    std::string expected = k_ascii_ply;
    expected.replace(expected.find("1.0 1 0 0.25"), 12, "2 0.3333333333333333 0 0.1");
    EXPECT_EQ(rewritten("a.ply", k_ascii_ply, &moved), expected);
}

TEST_F(Io, WritePlyKeepsDoublesAndProperties)
{
    Positions positions(3, 3);
    positions << 0, 0, 0, 1.0 / 3, 0, 0, 0, 1e-9, 7;
    const Triangles triangles = Triangles::Map(std::array { 0, 1, 2 }.data(), 1, 3);
    write_ply(folder / "w.ply", positions, triangles, { { "joint0", { 3, 4, 5 }, true }, { "weight0", { 0.1, 0.2, 0.3 } } }, { "hello" });
    const MeshFile mesh = MeshFile::read(folder / "w.ply");
    EXPECT_EQ(mesh.positions(), positions);
    EXPECT_EQ(mesh.triangles(), triangles);
    const auto properties = read_ply_properties(folder / "w.ply");
    ASSERT_EQ(properties.size(), 5u);
    EXPECT_EQ(properties[3].name, "joint0");
    EXPECT_TRUE(properties[3].integer);
    EXPECT_EQ(properties[3].values, (std::vector<double> { 3, 4, 5 }));
    EXPECT_EQ(properties[4].values, (std::vector<double> { 0.1, 0.2, 0.3 }));
}

TEST_F(Io, SaysWhatIsWrongAndWhere)
{
    EXPECT_NE(complaint(folder / "none.ply").find("no such file"), std::string::npos);
    EXPECT_NE(complaint(folder).find("directory"), std::string::npos);
    EXPECT_NE(complaint(save("e.ply", "")).find("is empty"), std::string::npos);
    EXPECT_NE(complaint(save("t.xyz", "hello")).find("unknown format"), std::string::npos);
}

}  // namespace
