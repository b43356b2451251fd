// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/outfit.h"

#include <numeric>

#include "fixtures.h"
#include "garmentfit/error.h"
#include "garmentfit/filters/snapshot.h"
#include "temporary_folder.h"

namespace garmentfit {
namespace {

using namespace fixtures;

/// A person from a skinned file, with a cuff round one forearm.
struct OutfitOnAnAvatar : TemporaryFolder {
    void SetUp() override
    {
        TemporaryFolder::SetUp();
        write_skinned_glb(folder / "woman.glb", person.mesh, simple_rig(person));
    }

    /// @param order  of the vertices of the person that the body has, ascending or descending
    Scene dressed(const std::vector<int>& order) const
    {
        Scene scene;
        Triangles triangles = person.mesh.triangles;
        if (order.front() > order.back())
            triangles = (int(order.size()) - 1 - triangles.array()).matrix();
        scene.body = make_body(person.mesh.positions(order, Eigen::all), triangles);
        scene.rig = simple_rig(person);
        const GarmentMesh cuff = sleeve_round(person.skeleton, lradius, 0.07, 0.05, 0.2);
        scene.garments.push_back({ make_garment(cuff.positions, cuff.triangles), {} });
        scene.recovered = dressing_from(scene, {}, scene.body->surface.positions, { cuff.positions }, { "cuff" });
        return scene;
    }

    /// All weights of the outfit, those of the body first.
    Eigen::MatrixXd weights_of_outfit(const Scene& scene, const std::string& name,
                                      const std::optional<BoneNames>& bones = {},
                                      int influences = k_few_influences) const
    {
        OutfitRequest request { folder / name, bones, false,
                                avatar_of_body(folder / "woman.glb", scene.body->surface.positions, {}) };
        request.influences = influences;
        write_outfit(scene, { "body" }, { { "cuff" } }, request);
        return read_joint_weights(folder / name);
    }

    const Person person = capsule_person();
    const int n = int(person.mesh.positions.rows());
};

TEST_F(OutfitOnAnAvatar, IsTheSameInWhateverOrderTheBodyHasItsVertices)
{
    std::vector<int> ascending(std::size_t(n), 0);
    std::iota(ascending.begin(), ascending.end(), 0);
    const std::vector<int> descending(ascending.rbegin(), ascending.rend());
    const Scene scene = dressed(ascending), turned = dressed(descending);
    ASSERT_TRUE(scene.recovered->certified);
    const Eigen::MatrixXd expected = weights_of_outfit(scene, "outfit.glb"),
                          weights = weights_of_outfit(turned, "turned.glb");
    ASSERT_EQ(weights.rows(), n + scene.garments[0].mesh.positions.rows());
    ASSERT_EQ(weights.cols(), expected.cols());
    EXPECT_LT((weights - expected).cwiseAbs().maxCoeff(), 1e-6);
    const Eigen::MatrixXd given = read_joint_weights(folder / "woman.glb");
    EXPECT_LT((weights.topRows(n) - given).cwiseAbs().maxCoeff(), 1e-6) << "the file's body stays as it is";
}

TEST_F(OutfitOnAnAvatar, HasAsManyInfluencesAsAsked)
{
    std::vector<int> all(std::size_t(n), 0);
    std::iota(all.begin(), all.end(), 0);
    const Scene scene = dressed(all);  // the skin under the cuff hangs on all bones, each vertex on others
    const auto most_joints = [&](const std::optional<BoneNames>& bones, int influences) {
        const Eigen::MatrixXd weights = weights_of_outfit(scene, "outfit.glb", bones, influences);
        return (weights.bottomRows(weights.rows() - n).array() > 0).rowwise().count().maxCoeff();
    };
    for (const std::optional<BoneNames>& bones : { std::optional<BoneNames>(), std::optional(BoneNames::unreal) }) {
        EXPECT_EQ(most_joints(bones, k_few_influences), 4);
        EXPECT_EQ(most_joints(bones, k_many_influences), 8);
    }
}

TEST(Influences, AreCalledByWords)
{
    EXPECT_EQ(influences_called("four"), 4);
    EXPECT_EQ(influences_called("eight"), 8);
    EXPECT_THROW(influences_called("8 "), InvalidInput);
}

}  // namespace
}  // namespace garmentfit
