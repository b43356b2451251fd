// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/worn_clothes.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "edited_glb.h"
#include "fixtures.h"
#include "garmentfit/skinned_gltf.h"
#include "temporary_folder.h"

namespace {

using namespace garmentfit;

/// A person of capsules in a shirt, trousers and hair, each a mesh of its own.
class WornClothes : public fixtures::TemporaryFolder {
protected:
    const fixtures::Person person = fixtures::capsule_person();

    /// Skin of some bones only.
    TriangleMesh skin_of(const std::vector<Bone>& left_out) const
    {
        std::vector<int> rows;
        for (Eigen::Index f = 0; f < person.mesh.triangles.rows(); ++f)
            if (std::find(left_out.begin(), left_out.end(),
                          nearest_bone(person.mesh.positions.row(person.mesh.triangles(f, 0))))
                == left_out.end())
                rows.push_back(int(f));
        return { person.mesh.positions, person.mesh.triangles(rows, Eigen::all) };
    }

    Bone nearest_bone(const Vec3& place) const
    {
        const auto distance = [&](int b) {
            return fixtures::segment_distance(place, person.skeleton.head(b), person.skeleton.tail(b));
        };
        int nearest = 0;
        for (int b = 1; b < bone_count; ++b)
            if (distance(b) < distance(nearest))
                nearest = b;
        return Bone(nearest);
    }

    SkinnedMesh part(const std::string& name, const TriangleMesh& mesh) const
    {
        SkinWeights weights = fixtures::on_bone(lowerback, mesh.positions.rows());
        for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
            weights.bones(v, 0) = nearest_bone(mesh.positions.row(v));
        return { name, mesh, weights };
    }

    SkinnedMesh sleeve(const std::string& name, Bone bone) const
    {
        const GarmentMesh tube = fixtures::sleeve_round(person.skeleton, bone, 0.12, 0.03, 0.2);
        return part(name, { tube.positions, tube.triangles });
    }

    /// @param names  of the two sleeves and of a tuft of hair
    MeshFile write(const TriangleMesh& skin, const std::vector<std::string>& names) const
    {
        write_skinned_glb(
            folder / "avatar.glb", person.skeleton,
            { part("Body", skin), sleeve(names[0], lhumerus), sleeve(names[1], lfemur), sleeve(names[2], upperneck) });
        return MeshFile::read(folder / "avatar.glb");
    }

    static bool warns(const StrippedBody& body, const std::string& words)
    {
        return std::any_of(body.warnings.begin(), body.warnings.end(),
                           [&](const std::string& text) { return text.find(words) != std::string::npos; });
    }
};

using Names = std::vector<std::string>;

TEST_F(WornClothes, AreLeftOutWhereSkinIsUnderThem)
{
    const MeshFile avatar = write(person.mesh, { "Wolf3D_Outfit_Top", "Bottoms01", "HatHair" });
    const StrippedBody body = find_body(avatar, Wears::strip).value();
    EXPECT_EQ(body.stripped, (Names { "Wolf3D_Outfit_Top", "Bottoms01" }));
    EXPECT_TRUE(body.warnings.empty());
    const Eigen::Index sleeve_triangles = fixtures::sleeve_round(person.skeleton, lfemur, 0.1, 0, 0.2).triangles.rows();
    ASSERT_EQ(Eigen::Index(body.kept.size()), person.mesh.triangles.rows() + sleeve_triangles);
    EXPECT_EQ(triangles_of(avatar, body).topRows(person.mesh.triangles.rows()), person.mesh.triangles);
    EXPECT_EQ(body.kept.back(), int(avatar.triangles().rows()) - 1) << "the hair stays";
}

TEST_F(WornClothes, StayWhereTheFileHasNoSkinUnderThemAndAWarningSaysWhere)
{
    const MeshFile avatar = write(skin_of({ lhumerus }), { "Shirt", "Trousers", "Hair" });
    const StrippedBody body = find_body(avatar, Wears::strip).value();
    EXPECT_EQ(body.stripped, Names { "Trousers" });
    EXPECT_TRUE(warns(body, "Shirt is not left out, as the file has no skin under it at lhumerus"));
}

TEST_F(WornClothes, AreNotGuessedAtWithoutNamesOrJoints)
{
    const StrippedBody unnamed
        = find_body(write(person.mesh, { "part1", "eye_socket", "Headband_Hair" }), Wears::strip).value();
    EXPECT_TRUE(unnamed.stripped.empty());
    EXPECT_TRUE(warns(unnamed, "no part of the file is named as clothes"));

    write_ply(folder / "body.ply", person.mesh.positions, person.mesh.triangles);
    const StrippedBody ply = find_body(MeshFile::read(folder / "body.ply"), Wears::strip).value();
    EXPECT_EQ(Eigen::Index(ply.kept.size()), person.mesh.triangles.rows());
    EXPECT_EQ(ply.warnings.size(), 1u);
}

/// A file with a ball that no joint moves.
class Scenery : public WornClothes {
protected:
    /// @param centre  m
    MeshFile write_with_ball(const Vec3& centre, double radius) const
    {
        const Vec3 corner = Vec3::Constant(1.2 * radius);
        const TriangleMesh ball = fixtures::polygonise([&](const Vec3& p) { return (p - centre).norm() - radius; },
                                                       centre - corner, centre + corner, 0.2 * radius);
        write_skinned_glb(folder / "avatar.glb", person.skeleton,
                          { part("Body", person.mesh), part("Ball", ball), sleeve("Shirt", lhumerus) });
        save("avatar.glb", fixtures::edited(load(folder / "avatar.glb"), [](nlohmann::json& document) {
                 document["nodes"][std::size_t(fixtures::node_called(document, "Ball"))].erase("skin");
             }));
        return MeshFile::read(folder / "avatar.glb");
    }
};

TEST_F(Scenery, IsLeftOutWhereverItLies)
{
    const Vec3 chest = person.skeleton.tail(upperback);
    for (const Vec3& centre : { Vec3(1.5, 0.5, 0), chest })  // beside the body, and round it
        for (const Wears wears : { Wears::keep, Wears::strip }) {
            const MeshFile avatar = write_with_ball(centre, 1);
            const std::optional<StrippedBody> body = find_body(avatar, wears);
            ASSERT_TRUE(body);
            EXPECT_EQ(body->scenery, Names { "Ball" });
            EXPECT_EQ(body->stripped, wears == Wears::strip ? Names { "Shirt" } : Names());
            EXPECT_EQ(triangles_of(avatar, *body).topRows(person.mesh.triangles.rows()), person.mesh.triangles);
            EXPECT_NE(notes_on(*body).back().find("Ball"), std::string::npos);
        }
}

TEST_F(Scenery, IsNotWhatLiesOnTheSkin)
{
    EXPECT_FALSE(find_body(write_with_ball(person.skeleton.tips[head_top], 0.08), Wears::keep)) << "a hat";
}

TEST_F(Scenery, IsNotWhatRestsOnTheBody)
{
    const double radius = 0.2;  // most of it is far from the skin
    const Vec3 crown = person.skeleton.tips[head_top], beside(1, 0, 0);
    EXPECT_FALSE(find_body(write_with_ball(crown + Vec3(0, 0.9 * radius, 0), radius), Wears::keep)) << "a head";
    for (const Vec3& elsewhere : { Vec3(crown + Vec3(0, 3 * radius, 0)), Vec3(crown + beside) })
        EXPECT_TRUE(find_body(write_with_ball(elsewhere, radius), Wears::keep)) << elsewhere.transpose();
}

/// A square in any plane.
TriangleMesh panel(const Vec3& centre, const Vec3& side, const Vec3& other)
{
    TriangleMesh result { Positions(4, 3), Triangles(2, 3) };
    result.positions << (centre - side - other).transpose(), (centre + side - other).transpose(),
        (centre + side + other).transpose(), (centre - side + other).transpose();
    result.triangles << 0, 1, 2, 0, 2, 3;
    return result;
}

TEST_F(Scenery, IsWhatIsFlatAndLargeWhereThereIsNoSkin)
{
    const TriangleMesh backdrop = panel({ 1, 1.5, -1 }, { 0.6, 0.1, 0.5 }, { -0.2, 0.9, 0.1 }),
                       brow = panel(person.skeleton.tips[head_top], { 0.05, 0, 0 }, { 0, 0.01, 0 });
    write_skinned_glb(folder / "figure.glb", person.skeleton,
                      { part("Body", person.mesh), part("Brow", brow), part("Lamp", backdrop) });
    const MeshFile skinned = MeshFile::read(folder / "figure.glb");
    EXPECT_FALSE(find_body(skinned, Wears::keep)) << "joints move all of it";
    save("figure.glb", fixtures::edited(load(folder / "figure.glb"), [](nlohmann::json& document) {
             for (nlohmann::json& node : document["nodes"])
                 node.erase("skin");
         }));
    const MeshFile figure = MeshFile::read(folder / "figure.glb");
    const std::optional<StrippedBody> body = find_body(figure, Wears::keep);
    ASSERT_TRUE(body);
    EXPECT_EQ(body->scenery, Names { "Lamp" });
    EXPECT_EQ(Eigen::Index(body->kept.size()), person.mesh.triangles.rows() + 2);
}

TEST_F(WornClothes, TakeTheirMaterialsWithThem)
{
    Appearance look;
    look.material_of = { 0, 1, 2 };
    look.uv_corners = Triangles::Zero(3, 3);
    look.uv_corners.row(2).setConstant(7);
    StrippedBody body;
    body.kept = { 0, 2 };
    const Appearance left = appearance_of(look, body);
    EXPECT_EQ(left.material_of, (std::vector<int> { 0, 2 }));
    ASSERT_EQ(left.uv_corners.rows(), 2);
    EXPECT_EQ(left.uv_corners(1, 0), 7);
    EXPECT_TRUE(appearance_of({}, body).material_of.empty());
}

}  // namespace
