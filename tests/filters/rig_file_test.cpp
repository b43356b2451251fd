// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/rig_file.h"

#include <fstream>
#include <sstream>

#include "garmentfit/error.h"
#include "temporary_folder.h"

namespace garmentfit {
namespace {

using RigFiles = fixtures::TemporaryFolder;

/// Bones in a row, and two vertices.
RigFile small_rig()
{
    RigFile contents;
    contents.frame = { 0.01, Vec3::UnitZ() };
    for (int b = 0; b < bone_count; ++b)
        contents.rig.skeleton.tails[b] = { 0.1 * b, 1. / 3, -0.2 };
    contents.rig.radii[lfemur] = 0.07;
    contents.rig.weights.bones.resize(2, 4);
    contents.rig.weights.bones << lfemur, ltibia, 0, 0, thorax, 0, 0, 0;
    contents.rig.weights.weights.resize(2, 4);
    contents.rig.weights.weights << 1. / 3, 2. / 3, 0, 0, 1, 0, 0, 0;
    return contents;
}

std::string message_of(const std::filesystem::path& path)
{
    try {
        read_whole_rig(path);
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return {};
}

TEST_F(RigFiles, GiveWeightsBackWithTheVeryBitsTheyWereWrittenWith)
{
    const RigFile written = small_rig();
    write_rig_file(folder / "man.rig.json", written);
    const RigFile read = read_whole_rig(folder / "man.rig.json");
    EXPECT_EQ(read.rig.weights.bones, written.rig.weights.bones);
    EXPECT_EQ(read.rig.weights.weights, written.rig.weights.weights);
    EXPECT_EQ(read.frame.metres_per_unit, written.frame.metres_per_unit);
    EXPECT_NEAR(read.rig.radii[lfemur], 0.07, 1e-15);
    EXPECT_NEAR((read.rig.skeleton.tails[rradius] - written.rig.skeleton.tails[rradius]).norm(), 0, 1e-15);
}

TEST_F(RigFiles, KeepWhetherAGarmentHasAUnit)
{
    RigFile written = small_rig();
    written.garments = { { "shirt.obj", { 0.01 }, {} }, { "coat.glb", { 0.3, Vec3::UnitY(), false }, {} } };
    write_rig_file(folder / "man.rig.json", written);
    const RigFile read = read_whole_rig(folder / "man.rig.json");
    ASSERT_EQ(read.garments.size(), 2u);
    EXPECT_TRUE(read.garments[0].frame.has_unit);
    EXPECT_FALSE(read.garments[1].frame.has_unit);
}

TEST_F(RigFiles, SayWhichVertexHasAWeightOutOfRange)
{
    RigFile contents = small_rig();
    contents.rig.weights.weights(1, 0) = 1.5;
    write_rig_file(folder / "man.rig.json", contents);
    EXPECT_NE(message_of(folder / "man.rig.json").find("vertex 1 has a bone or a weight out of range"),
              std::string::npos);
}

TEST_F(RigFiles, OfAnotherVersionAreRefusedByTheirVersionAndNotByAMissingKey)
{
    write_rig_file(folder / "man.rig.json", small_rig());
    std::stringstream whole;
    whole << std::ifstream(folder / "man.rig.json").rdbuf();
    std::string text = whole.str();
    const std::string current = "\"version\":2", key = "side_confidence";
    ASSERT_NE(text.find(current), std::string::npos);
    text.replace(text.find(current), current.size(), "\"version\":1");
    text.replace(text.find(key), key.size(), "side_margin");
    std::ofstream(folder / "man.rig.json") << text;
    const std::string message = message_of(folder / "man.rig.json");
    EXPECT_NE(message.find("has version 1, and this program reads version 2; write it again"), std::string::npos)
        << message;
}

TEST_F(RigFiles, WithoutWeightsNeedThemBesideThem)
{
    RigFile contents = small_rig();
    contents.rig.weights = {};
    write_rig_file(folder / "rig.json", contents);
    EXPECT_NE(message_of(folder / "rig.json").find("rigged.ply"), std::string::npos);
}

}  // namespace
}  // namespace garmentfit
