// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/garment_weights.h"

#include <gtest/gtest.h>

#include "fixtures.h"
#include "skin_weights.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

constexpr int k_around = 48, k_rows = 40;
constexpr double k_length = 0.8;

/// An open upright tube, its normals outwards.
TriangleMesh tube(double x, double radius, int around = k_around)
{
    TriangleMesh mesh { Positions(around * k_rows, 3), Triangles(2 * around * (k_rows - 1), 3) };
    for (int i = 0; i < k_rows; ++i)
        for (int k = 0; k < around; ++k) {
            const int here = i * around + k, right = i * around + (k + 1) % around;
            const double angle = 2 * M_PI * k / around;
            mesh.positions.row(here) << x + radius * std::cos(angle), k_length * i / (k_rows - 1),
                radius * std::sin(angle);
            if (i + 1 < k_rows) {
                mesh.triangles.row(2 * here) << here, here + around, right;
                mesh.triangles.row(2 * here + 1) << right, here + around, right + around;
            }
        }
    return mesh;
}

TriangleMesh turned_over(TriangleMesh mesh)
{
    mesh.triangles.col(1).swap(mesh.triangles.col(2));
    return mesh;
}

GarmentMesh garment_of(const TriangleMesh& mesh) { return { mesh.positions, mesh.triangles }; }

/// Each vertex of the first `split` has all weight on one bone, the others on the other.
SkinWeights two_bones(Eigen::Index rows, Eigen::Index split, int first, int second)
{
    SkinWeights weights { Eigen::Matrix<int, Eigen::Dynamic, 4, Eigen::RowMajor>::Zero(rows, 4),
                          Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>::Zero(rows, 4) };
    weights.bones.col(0).head(split).setConstant(first);
    weights.bones.col(0).tail(rows - split).setConstant(second);
    weights.weights.col(0).setOnes();
    return weights;
}

/// Thighs 18 cm thick and 3 cm apart.
struct Legs {
    TriangleMesh skin = joined(tube(-0.105, 0.09), tube(0.105, 0.09));
    SkinWeights weights = two_bones(skin.positions.rows(), skin.positions.rows() / 2, rfemur, lfemur);
};

double weight_of(const SkinWeights& weights, Eigen::Index vertex, int bone)
{
    double sum = 0;
    for (int k = 0; k < 4; ++k)
        sum += weights.bones(vertex, k) == bone ? weights.weights(vertex, k) : 0;
    return sum;
}

double largest_weight(const SkinWeights& weights, int bone)
{
    double largest = 0;
    for (Eigen::Index v = 0; v < weights.bones.rows(); ++v)
        largest = std::max(largest, weight_of(weights, v, bone));
    return largest;
}

/// Weights that go over from one bone to the other along the height.
SkinWeights graded(const Positions& positions)
{
    SkinWeights weights = two_bones(positions.rows(), positions.rows(), lfemur, lfemur);
    weights.bones.col(1).setConstant(ltibia);
    weights.weights.col(1) = positions.col(1) / k_length;
    weights.weights.col(0) = 1 - weights.weights.col(1).array();
    return weights;
}

void expect_rows_of_weights(const SkinWeights& weights)
{
    for (Eigen::Index v = 0; v < weights.weights.rows(); ++v)
        ASSERT_NEAR(weights.weights.row(v).sum(), 1, 1e-12) << v;
    EXPECT_GE(weights.weights.minCoeff(), 0);
}

TEST(GarmentWeights, ATrouserLegNextToTheOtherLegKeepsItsOwn)
{
    const Legs legs;
    const GarmentMesh trouser = garment_of(tube(-0.105, 0.118));  // its inner side is next to the left thigh
    const SkinWeights nearest = weights_of_nearest(trouser.positions, legs.skin.positions, legs.weights);
    ASSERT_GT(largest_weight(nearest, lfemur), 0.9);  // what is to be avoided
    const SkinWeights weights = garment_weights(legs.skin, legs.weights, trouser, trouser.positions);
    expect_rows_of_weights(weights);
    EXPECT_LT(largest_weight(weights, lfemur), 0.01);
}

TEST(GarmentWeights, TheOrientationOfFacesDoesNotMatter)
{
    const Legs legs;
    const GarmentMesh trouser = garment_of(turned_over(tube(-0.105, 0.118)));
    EXPECT_LT(largest_weight(garment_weights(legs.skin, legs.weights, trouser, trouser.positions), lfemur), 0.01);
}

TEST(GarmentWeights, CloseClothHasTheWeightsOfTheSkin)
{
    const TriangleMesh skin = tube(0, 0.09);
    const SkinWeights on_skin = graded(skin.positions);
    const GarmentMesh sleeve = garment_of(tube(0, 0.1, 31));
    const SkinWeights weights = garment_weights(skin, on_skin, sleeve, sleeve.positions);
    expect_rows_of_weights(weights);
    for (Eigen::Index v = 0; v < sleeve.positions.rows(); ++v)
        EXPECT_NEAR(weight_of(weights, v, ltibia), sleeve.positions(v, 1) / k_length, 0.004) << v;
}

TEST(GarmentWeights, ClothFarFromSkinContinuesTheClothAround)
{
    const TriangleMesh skin = tube(0, 0.09);
    const SkinWeights on_skin = graded(skin.positions);
    TriangleMesh bell = tube(0, 0.1);  // wide in the middle, out of reach
    for (Eigen::Index v = 0; v < bell.positions.rows(); ++v) {
        const double height = bell.positions(v, 1) / k_length, wide = 1 + 2 * std::pow(std::sin(M_PI * height), 4);
        bell.positions(v, 0) *= wide;
        bell.positions(v, 2) *= wide;
    }
    const SkinWeights weights = garment_weights(skin, on_skin, garment_of(bell), bell.positions);
    expect_rows_of_weights(weights);
    for (Eigen::Index v = k_around; v < bell.positions.rows(); ++v) {
        EXPECT_NEAR(weight_of(weights, v, ltibia), bell.positions(v, 1) / k_length, 0.15) << v;
        EXPECT_GE(weight_of(weights, v, ltibia), weight_of(weights, v - k_around, ltibia) - 0.01) << v;
    }
}

/// Round both legs, close to them at the waist and wide at the hem.
TriangleMesh skirt()
{
    TriangleMesh mesh = tube(0, 1, 4 * k_around);
    for (auto p : mesh.positions.rowwise()) {
        const double wide = 0.12 * (1 - p[1] / k_length);
        p[0] *= 0.205 + wide;
        p[2] *= 0.1 + wide;
    }
    return mesh;
}

TEST(GarmentWeights, ASkirtFollowsTheThighsBelowItAndNotTheHipsThatItTouches)
{
    Legs legs;
    for (Eigen::Index v = 0; v < legs.skin.positions.rows(); ++v)
        if (legs.skin.positions(v, 1) > 0.7 * k_length)
            legs.weights.bones(v, 0) = lowerback;
    const TriangleMesh cloth = skirt();
    const SkinWeights weights = garment_weights(legs.skin, legs.weights, garment_of(cloth), cloth.positions);
    expect_rows_of_weights(weights);
    const int around = 4 * k_around;
    for (Eigen::Index v = 0; v < 5 * around; ++v) {  // the hem, 7 to 12 cm off the skin
        const double x = cloth.positions(v, 0), right = weight_of(weights, v, rfemur);
        EXPECT_LT(weight_of(weights, v, lowerback), 0.05) << v;
        if (std::abs(x) > 0.15) {
            EXPECT_NEAR(right, x < 0 ? 1 : 0, 0.05) << x;
        }
        const double next = weight_of(weights, v / around * around + (v + 1) % around, rfemur);
        EXPECT_LT(std::abs(next - right), 0.25) << x << ": from one thigh to the other within 1 cm";
    }
}

TEST(GarmentWeights, VerticesAtOnePlaceHaveTheSameWeights)
{
    const TriangleMesh skin = tube(0, 0.09), cloth = tube(0, 0.1);
    GarmentMesh cut { Positions(3 * cloth.triangles.rows(), 3), Triangles(cloth.triangles.rows(), 3) };
    for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            cut.positions.row(3 * f + k) = cloth.positions.row(cloth.triangles(f, k));
            cut.triangles(f, k) = int(3 * f + k);
        }
    const SkinWeights on_skin = graded(skin.positions);
    const SkinWeights whole = garment_weights(skin, on_skin, garment_of(cloth), cloth.positions);
    const SkinWeights weights = garment_weights(skin, on_skin, cut, cut.positions);
    for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(weight_of(weights, 3 * f + k, ltibia), weight_of(whole, cloth.triangles(f, k), ltibia), 1e-9);
    for (Eigen::Index a = 0; a < cut.positions.rows(); a += 97)
        for (Eigen::Index b = 0; b < cut.positions.rows(); ++b)
            if (cut.positions.row(a) == cut.positions.row(b)) {
                EXPECT_EQ(weights.weights.row(a), weights.weights.row(b));
            }
}

TEST(GarmentWeights, APatchFollowsTheClothThatItLiesOn)
{
    const Legs legs;
    const TriangleMesh trouser = tube(-0.105, 0.112);
    // On the inner side of the right leg, nearer to the left thigh: 4 by 4 cm, 1 mm off the cloth.
    TriangleMesh patch = sheet(5, 0.01, [](double, double) { return 0; });
    for (auto row : patch.positions.rowwise())
        row = Eigen::RowVector3d(0.008, 0.4 + row[0], row[2] - 0.02);
    for (auto row : patch.positions.rowwise())
        row[0] = -0.105 + std::sqrt(0.113 * 0.113 - row[2] * row[2]);
    const GarmentMesh both = garment_of(joined(trouser, patch));
    const SkinWeights weights = garment_weights(legs.skin, legs.weights, both, both.positions);
    expect_rows_of_weights(weights);
    EXPECT_LT(largest_weight(weights, lfemur), 0.01);
}

TEST(GarmentWeights, ClothWithoutAnyMatchFollowsTheNearestSkin)
{
    const Legs legs;
    const GarmentMesh far = garment_of(flat(4, 0.02, { 1.5, 0.4, 0 }));
    const SkinWeights weights = garment_weights(legs.skin, legs.weights, far, far.positions);
    for (Eigen::Index v = 0; v < far.positions.rows(); ++v)
        EXPECT_NEAR(weight_of(weights, v, lfemur), 1, 1e-9);
}

TEST(GarmentWeights, WorksOverAnyJointsAndKeepsAsManyAsAsked)
{
    constexpr int joints = 120, blended = 12;
    const TriangleMesh skin = tube(0, 0.09), cloth = tube(0, 0.095);
    JointWeights on_skin(skin.positions.rows(), joints);
    for (int v = 0; v < int(skin.positions.rows()); ++v)
        for (int k = 0; k < blended; ++k)
            on_skin.insert(v, 100 + k) = (k + 1) * 2.0 / (blended * (blended + 1));
    for (const int most : { 1, 4, 8 }) {
        const JointWeights weights
            = garment_weights(skin, on_skin, garment_of(cloth), cloth.positions, { .joints_per_vertex = most });
        ASSERT_EQ(weights.cols(), joints);
        for (int v = 0; v < int(weights.rows()); ++v) {
            ASSERT_EQ(weights.row(v).nonZeros(), most);
            ASSERT_NEAR(weights.row(v).sum(), 1, 1e-12);
            ASSERT_GT(weights.coeff(v, 111), 0);  // the largest
        }
    }
}

TEST(GarmentWeights, RefusesWhatDoesNotGoTogether)
{
    const Legs legs;
    const GarmentMesh trouser = garment_of(tube(-0.105, 0.118));
    const Positions fewer = trouser.positions.topRows(5);
    expect_invalid([&] { garment_weights(legs.skin, legs.weights, trouser, fewer); }, "5 vertices");
    SkinWeights halved = legs.weights;
    halved.weights *= 0.5;
    expect_invalid([&] { garment_weights(legs.skin, halved, trouser, trouser.positions); }, "vertex 0");
    expect_invalid([&] { garment_weights(tube(0, 1, 5), legs.weights, trouser, trouser.positions); }, "rows");
    expect_invalid(
        [&] { garment_weights(legs.skin, legs.weights, trouser, trouser.positions, { .joints_per_vertex = 9 }); }, "8");
}

}  // namespace
