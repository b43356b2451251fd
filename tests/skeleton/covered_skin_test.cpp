// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/covered_skin.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include "fixtures.h"
#include "garmentfit/garment_weights.h"
#include "garmentfit/rig_body.h"
#include "keyframes.h"
#include "views.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

SkinWeights rigid(Eigen::Index rows, Bone bone)
{
    SkinWeights weights;
    weights.bones.setConstant(rows, 4, bone);
    weights.weights.setZero(rows, 4);
    weights.weights.col(0).setOnes();
    return weights;
}

constexpr double k_spacing = 0.025;  // m; faces are seen as wholes, so they must be smaller than what covers them

Person fine_person()
{
    PersonOptions options;
    options.spacing = k_spacing;
    return capsule_person(options);
}

/// A body that moves as a whole, so that its clothes cover in all poses what they cover at rest.
struct Clothed {
    Person person = fine_person();
    Rig rig = simple_rig(person);

    Clothed() { rig.weights = rigid(person.mesh.positions.rows(), thorax); }

    /// A garment round all skin with `keep`.
    SkinnedCloth cloth(const std::function<bool(const Vec3&)>& keep) const
    {
        const TriangleMesh mesh = garment_round(person.skeleton, 0.012, keep, k_spacing);
        return { mesh, rigid(mesh.positions.rows(), thorax) };
    }
    Vec3 place(std::size_t v) const { return person.mesh.positions.row(Eigen::Index(v)); }
};

bool is_shirt(const Vec3& p) { return p.y() > 0.6 && p.y() < 1.5; }

TEST(CoveredSkin, IsUnderClothAwayFromItsBorders)
{
    const Clothed clothed;
    const std::vector<char> is_covered
        = find_covered_skin(clothed.person.mesh, clothed.rig, { clothed.cloth(is_shirt) });
    ASSERT_EQ(Eigen::Index(is_covered.size()), clothed.person.mesh.positions.rows());
    int covered = 0, at_the_belly = 0, belly = 0;
    for (std::size_t v = 0; v < is_covered.size(); ++v) {
        covered += is_covered[v];
        EXPECT_FALSE(is_covered[v] && !is_shirt(clothed.place(v))) << clothed.place(v).transpose();
        if (std::abs(clothed.place(v).y() - 1.05) < 0.05 && std::abs(clothed.place(v).x()) < 0.2) {
            ++belly;
            at_the_belly += is_covered[v];
        }
    }
    EXPECT_GT(covered, 100);
    EXPECT_GT(at_the_belly, 0.9 * belly);
}

TEST(CoveredSkin, IsNoneWithoutClothOrUnderOpenCloth)
{
    const Clothed clothed;
    const auto count = [&](const std::vector<SkinnedCloth>& clothes) {
        const auto is_covered = find_covered_skin(clothed.person.mesh, clothed.rig, clothes);
        return std::count(is_covered.begin(), is_covered.end(), 1);
    };
    EXPECT_EQ(count({}), 0) << "skin that only skin hides stays";
    EXPECT_EQ(count({ clothed.cloth([](const Vec3& p) { return p.y() > 1.1 && p.y() < 1.16; }) }), 0) << "a belt";
}

TEST(CoveredSkin, IsSeenWhereAPoseOpensTheCloth)
{
    const Clothed clothed;
    SkinnedCloth shirt = clothed.cloth(is_shirt);
    const auto count = [&] {
        const auto is_covered = find_covered_skin(clothed.person.mesh, clothed.rig, { shirt });
        return std::count(is_covered.begin(), is_covered.end(), 1);
    };
    const auto worn = count();
    shirt.weights.bones.setConstant(lradius);  // all of it follows the left forearm, and leaves the trunk
    EXPECT_LT(count(), worn / 10);
}

TEST(CoveredSkin, LeavesNoHoleThatAViewOfAPoseShows)
{
    const Person person = fine_person();
    const Rig rig = rig_body(make_body(person.mesh.positions, person.mesh.triangles));
    const TriangleMesh mesh = garment_round(person.skeleton, 0.012, is_shirt, k_spacing);
    const SkinnedCloth shirt {
        mesh, garment_weights(person.mesh, rig.weights, make_garment(mesh.positions, mesh.triangles), mesh.positions)
    };
    std::vector<char> is_covered = find_covered_skin(person.mesh, rig, { shirt });
    const auto count = [&] {
        const Triangles shown = uncovered_faces(person.mesh.triangles, is_covered);
        Holes holes;
        int view = 0;
        for (const Keyframe& key : keyframes_of(rig)) {
            const BoneTransforms transforms = bone_transforms(rig.skeleton, key.pose);
            const Worn posed { blend_linearly(person.mesh.positions, rig.weights, transforms),
                               blend_linearly(mesh.positions, shirt.weights, transforms), person.mesh.triangles, shown,
                               mesh.triangles };
            for (int k = 0; k < 2; ++k)
                holes += holes_seen(posed, direction_of(view++, 72), 120);
        }
        return holes;
    };
    const Holes holes = count();
    EXPECT_GT(std::count(is_covered.begin(), is_covered.end(), 1), 5);
    EXPECT_GT(holes.skin, 10000);
    EXPECT_EQ(holes.through, 0);
    EXPECT_EQ(holes.deep, 0);
    for (std::size_t v = 0; v < is_covered.size(); ++v)
        is_covered[v] = is_covered[v] || is_shirt(person.mesh.positions.row(Eigen::Index(v)));
    const Holes wrong = count();
    EXPECT_GT(wrong.through + wrong.deep, 100) << "all skin below the shirt, up to its borders";
}

TEST(CoveredSkin, IsSeenThroughANarrowTubeAlongItsAxisOnly)
{
    Clothed clothed;
    const auto is_leg = [](const Vec3& p) { return p.x() > 0.02 && p.y() > 0.12 && p.y() < 0.75; };
    const auto covered_leg = [&](const SkinnedCloth& leg) {
        const auto is_covered = find_covered_skin(clothed.person.mesh, clothed.rig, { leg });
        int count = 0;
        for (std::size_t v = 0; v < is_covered.size(); ++v)
            count += is_covered[v] && is_leg(clothed.place(v));
        return count;
    };
    const TriangleMesh tight = garment_round(clothed.person.skeleton, 0.01, is_leg, k_spacing),
                       wide = garment_round(clothed.person.skeleton, 0.06, is_leg, k_spacing);
    const int under_tight = covered_leg({ tight, rigid(tight.positions.rows(), thorax) }),
              under_wide = covered_leg({ wide, rigid(wide.positions.rows(), thorax) });
    EXPECT_GT(under_tight, 10);
    EXPECT_LT(under_wide, under_tight / 2);
}

TEST(CoveredSkin, IsTheSameForAnyNumberOfThreads)
{
    const Clothed clothed;
    const std::vector<SkinnedCloth> clothes { clothed.cloth(is_shirt) };
    std::vector<char> alone;
    tbb::task_arena(1).execute([&] { alone = find_covered_skin(clothed.person.mesh, clothed.rig, clothes); });
    EXPECT_EQ(find_covered_skin(clothed.person.mesh, clothed.rig, clothes), alone);
}

TEST(CoveredSkin, LeavesOutFacesOfWhichAllCornersAreCovered)
{
    Triangles triangles(3, 3);
    triangles << 0, 1, 2, 1, 2, 3, 2, 3, 4;
    const Triangles shown = uncovered_faces(triangles, { 0, 1, 1, 1, 1 });
    ASSERT_EQ(shown.rows(), 1);
    EXPECT_EQ(shown(0, 0), 0);
    EXPECT_EQ(uncovered_faces(triangles, { 0, 0, 0, 0, 0 }), triangles);
}

TEST(CoveredSkin, RefusesWeightsOfOtherMeshes)
{
    const Clothed clothed;
    SkinnedCloth shirt = clothed.cloth(is_shirt);
    shirt.weights.weights.conservativeResize(3, 4);
    expect_invalid([&] { find_covered_skin(clothed.person.mesh, clothed.rig, { shirt }); }, "a garment");
}

}  // namespace
