// SPDX-License-Identifier: GPL-3.0-or-later
// Truncated and mangled files of each format: each is read, or refused as InvalidInput; never anything else.
#include "garmentfit/io.h"

#include <gtest/gtest.h>

#include <random>

#include "garmentfit/error.h"
#include "mesh_file_samples.h"
#include "temporary_folder.h"

namespace {

using namespace garmentfit;

constexpr int k_variants = 1000;  // of each file; all of them take some seconds

class IoFuzz : public fixtures::TemporaryFolder {
protected:
    /// Reads, and writes what could be read: all indices must hold then.
    void survive(const std::string& name, const std::string& bytes) const
    {
        try {
            const MeshFile mesh = MeshFile::read(save(name, bytes));
            ++read_;
            ASSERT_TRUE(mesh.positions().allFinite());
            ASSERT_GE(mesh.triangles().minCoeff(), 0);
            ASSERT_LT(mesh.triangles().maxCoeff(), mesh.positions().rows());
            const Appearance look = mesh.appearance();
            ASSERT_TRUE(look.uvs.allFinite());
            if (look.uv_corners.rows() > 0) {
                ASSERT_EQ(look.uv_corners.rows(), mesh.triangles().rows());
                ASSERT_LT(look.uv_corners.maxCoeff(), look.uvs.rows());
            }
            for (const int material : look.material_of)
                ASSERT_LT(material, int(look.materials.size()));
            std::filesystem::remove(folder / "written");
            mesh.write(folder / "written", 2 * mesh.positions());
        } catch (const InvalidInput& error) {
            ++refused_;
            ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }

    mutable int read_ = 0, refused_ = 0;
    std::mt19937 random { 20 };

    std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random); }

    /// One to four wounds: a byte changed, a bit flipped, a stretch lost or doubled, a number made huge.
    std::string mangled(std::string bytes)
    {
        for (std::size_t wound = 0, wounds = 1 + below(4); wound < wounds && !bytes.empty(); ++wound) {
            const std::size_t at = below(bytes.size());
            const std::size_t length = 1 + below(std::min<std::size_t>(12, bytes.size() - at));
            switch (below(6)) {
            case 0: bytes[at] = static_cast<char>(below(256)); break;
            case 1: bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8))); break;
            case 2: bytes.erase(at, length); break;
            case 3: bytes.insert(at, bytes.substr(at, length)); break;
            case 4: bytes.replace(at, std::min<std::size_t>(4, length), std::string(4, '\xff')); break;
            default: replace_number(bytes, at); break;
            }
        }
        return bytes;
    }

    void replace_number(std::string& bytes, std::size_t from)
    {
        static const std::vector<std::string> numbers { "-1",  "0",    "1e999", "4294967295", "18446744073709551615",
                                                        "nan", "-0.5", "\"\"",  "[]",         "2147483647" };
        const std::size_t at = bytes.find_first_of("0123456789", from);
        if (at != std::string::npos)
            bytes.replace(at, bytes.find_first_not_of("0123456789.", at) - at, numbers[below(numbers.size())]);
    }
};

TEST_F(IoFuzz, TruncatedFilesAreReadOrRefused)
{
    for (const samples::File& file : samples::all())
        for (std::size_t length = 0; length<file.bytes.size(); length += file.bytes.size()> 1000 ? 5 : 1)
            survive(file.name, file.bytes.substr(0, length));
    EXPECT_GT(refused_, 1000);
}

TEST_F(IoFuzz, MangledFilesAreReadOrRefused)
{
    for (const samples::File& file : samples::all())
        for (int variant = 0; variant < k_variants; ++variant)
            survive(file.name, mangled(file.bytes));
    EXPECT_GT(refused_, 1000);
    EXPECT_GT(read_, 500);
}

TEST_F(IoFuzz, WrongNumbersInTheJsonOfAGlbAreReadOrRefused)
{
    for (int variant = 0; variant < k_variants; ++variant) {
        std::string json = samples::gltf_json("");
        for (std::size_t wound = 0, wounds = 1 + below(3); wound < wounds; ++wound)
            replace_number(json, below(json.size()));
        survive("a.glb", samples::glb(json));
    }
    EXPECT_GT(refused_, 500);
    EXPECT_GT(read_, 50);
}

TEST_F(IoFuzz, NoiseIsRefused)
{
    for (const char* name : { "a.obj", "a.ply", "a.off", "a.stl", "a.glb", "a.gltf" })
        for (int variant = 0; variant < 100; ++variant) {
            std::string noise(below(300), ' ');
            for (char& byte : noise)
                byte = static_cast<char>(below(256));
            survive(name, noise);
        }
    EXPECT_EQ(read_, 0);
}

}  // namespace
