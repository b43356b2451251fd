// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/scene_arrays.h"

#include <map>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/filters/given_rig.h"

namespace garmentfit {
namespace {

using namespace fixtures;

std::map<std::string, Rows> by_name(const MeshArrays& arrays)
{
    std::map<std::string, Rows> found;
    for (const auto* list : { &arrays.points, &arrays.cells, &arrays.field })
        for (const NamedArray& array : *list)
            if (const Rows* rows = std::get_if<Rows>(&array.values))
                found[array.name] = *rows;
            else if (const auto* bones = std::get_if<BoneIndices>(&array.values))
                found[array.name] = bones->cast<double>();
            else if (const auto* counts = std::get_if<Counts>(&array.values))
                found[array.name] = counts->cast<double>();
    return found;
}

FindArray find_in(const std::map<std::string, Rows>& arrays)
{
    return [&arrays](const char* name) -> std::optional<Rows> {
        const auto found = arrays.find(name);
        return found == arrays.end() ? std::nullopt : std::optional(found->second);
    };
}

struct SceneArrays : testing::Test {
    const Positions own = capsule_person().mesh.positions;
    const Rig rig = rig_on(simple_rig(capsule_person()), own);
    std::map<std::string, Rows> arrays = by_name(arrays_of(rig, { 0.01, Vec3::UnitZ() }));
};

TEST_F(SceneArrays, GiveARigBackWithTheVeryBitsItWasWrittenWith)
{
    const Rig back = rig_from(find_in(arrays), own);
    EXPECT_EQ(back.weights.bones, rig.weights.bones);
    EXPECT_EQ(back.weights.weights, rig.weights.weights);
    EXPECT_EQ(back.skeleton.tails, rig.skeleton.tails);
    EXPECT_EQ(back.radii, rig.radii);
    const Frame frame = body_frame_from(find_in(arrays));
    EXPECT_EQ(frame.metres_per_unit, 0.01);
    EXPECT_EQ(frame.up, Vec3::UnitZ());
}

TEST_F(SceneArrays, NameWhatIsMissingMangledOrAnotherBodys)
{
    expect_invalid([&] { rig_from(find_in(arrays), own.topRows(7)); }, "belongs to a body of");
    arrays["RigRadii"].conservativeResize(3, 1);
    expect_invalid([&] { rig_from(find_in(arrays), own); }, "RigRadii");
    arrays.erase("RigJoints");
    expect_invalid([&] { rig_from(find_in(arrays), own); }, "RigJoints");
    arrays["BodyFrame"](0, 0) = -1;
    expect_invalid([&] { body_frame_from(find_in(arrays)); }, "BodyFrame");
    expect_invalid([&] { fits_from(find_in(arrays)); }, "Fit Skeleton");
    expect_invalid([&] { dressed_pose_from(find_in(arrays)); }, "Drape Garment");
    EXPECT_FALSE(garment_frame_from(find_in(arrays)));
}

TEST_F(SceneArrays, KeepTheUnitOfAGarmentOrThatItHasNone)
{
    for (const bool has_unit : { true, false }) {
        arrays = by_name(arrays_of(Frame { 0.3, Vec3::UnitZ(), has_unit, 2.5 }));
        const Frame back = garment_frame_from(find_in(arrays)).value();
        EXPECT_EQ(back.metres_per_unit, 0.3);
        EXPECT_EQ(back.up, Vec3::UnitZ());
        EXPECT_EQ(back.has_unit, has_unit);
        EXPECT_EQ(back.size_in_unit, 2.5);
    }
    arrays.erase("GarmentHasUnit");  // as in older files
    arrays.erase("GarmentSizeInUnit");
    EXPECT_TRUE(garment_frame_from(find_in(arrays))->has_unit);
}

TEST_F(SceneArrays, HaveOneNameForEachJointAndOneLineForEachBoneAndTip)
{
    const MeshArrays skeleton = arrays_of_skeleton();
    EXPECT_EQ(std::get<Texts>(skeleton.points[0].values).size(), std::size_t(k_joint_rows));
    EXPECT_EQ(std::get<Texts>(skeleton.cells[0].values).size(), skeleton_lines().size());
    for (const auto& [from, to] : skeleton_lines())
        EXPECT_LT(from, to);
}

TEST_F(SceneArrays, SayWhyNoOnePoseServesTheGarments)
{
    Scene scene;
    scene.fits.resize(2);
    EXPECT_EQ(arrays_of_fits(scene).field.size(), 2u);
    scene.one_pose = false;
    scene.conflicts.push_back({ lhumerus, { 1, 0 }, 0.5 });
    std::map<std::string, NamedArray> field;
    for (const NamedArray& array : arrays_of_fits(scene).field)
        field[array.name] = array;
    EXPECT_EQ(std::get<Texts>(field.at("ConflictBone").values), Texts { "lhumerus" });
    EXPECT_EQ(std::get<Counts>(field.at("ConflictGarments").values)(0, 0), 1);
    EXPECT_NEAR(std::get<Rows>(field.at("ConflictAngle").values)(0, 0), 28.6, 0.1);
}

}  // namespace
}  // namespace garmentfit
