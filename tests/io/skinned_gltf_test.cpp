// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/skinned_gltf.h"

#include <map>
#include <string>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/rig_body.h"
#include "temporary_folder.h"

namespace {

using namespace garmentfit;
using fixtures::capsule_person;
using fixtures::TemporaryFolder;

class SkinnedGltf : public TemporaryFolder {
protected:
    const fixtures::Person person = capsule_person();
    const Rig rig = fixtures::simple_rig(person);
    std::filesystem::path glb;

    void SetUp() override
    {
        TemporaryFolder::SetUp();
        glb = folder / "rigged.glb";
        write_skinned_glb(glb, person.mesh, rig);
    }

    /// Renames joints in the file, to names of the same length: the GLB stays valid.
    void call_joints(const std::map<std::string, std::string>& names) const
    {
        std::string bytes = load(glb);
        for (const auto& [from, to] : names) {
            const std::string old = "\"name\":\"" + from + "\"";
            const std::size_t at = bytes.find(old);
            ASSERT_NE(at, std::string::npos) << from;
            ASSERT_EQ(from.size(), to.size());
            bytes.replace(at, old.size(), "\"name\":\"" + to + "\"");
        }
        save("rigged.glb", bytes);
    }
};

TEST_F(SkinnedGltf, ComesBackAsItWasWritten)
{
    const ForeignRig read = read_skinned_gltf(glb);
    for (int b = 0; b < bone_count; ++b)
        EXPECT_LT((read.skeleton.tail(b) - rig.skeleton.tail(b)).norm(), 1e-6) << bone_name(b);
    for (int e = 0; e < extremity_count; ++e)
        EXPECT_LT((read.skeleton.tips[e] - rig.skeleton.tips[e]).norm(), 1e-6) << e;
    EXPECT_EQ(read.weights.bones.leftCols<2>(), rig.weights.bones.leftCols<2>());
    EXPECT_LT((read.weights.weights - rig.weights.weights).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(SkinnedGltf, NamesTheJointThatItCannotFind)
{
    call_joints({ { "lfemur", "thing1" } });
    fixtures::expect_invalid([&] { read_skinned_gltf(glb); }, "left hip");
}

TEST_F(SkinnedGltf, UnderstandsOtherNamesForJoints)
{
    call_joints(
        { { "lfemur", "LUpLeg" }, { "rtibia", "shin_r" }, { "lhumerus", "arm-left" }, { "lradius", "elbow_l" } });
    const ForeignRig read = read_skinned_gltf(glb);
    for (const int b : { lfemur, rtibia, lhumerus, lradius })
        EXPECT_LT((read.skeleton.head(b) - rig.skeleton.head(b)).norm(), 1e-6) << bone_name(b);
}

TEST_F(SkinnedGltf, RefusesAMeshWithoutASkin)
{
    const auto no = save("no.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"name":"a"}],"scenes":[{"nodes":[0]}]})");
    fixtures::expect_invalid([&] { read_skinned_gltf(no); }, "skin");
}

}  // namespace
