// SPDX-License-Identifier: GPL-3.0-or-later
#include "outward_cloth.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "surface_measures.h"

namespace {

using namespace garmentfit;

TriangleMesh ball(double radius)
{
    return fixtures::polygonise([&](const Vec3& p) { return p.norm() - radius; }, Vec3::Constant(-0.5),
                                Vec3::Constant(0.5), 0.05);
}

/// The surface of a torus, two sheets `thickness` apart of a wide tube about the y axis.
TriangleMesh thick_tube(double radius, double height, double thickness)
{
    return fixtures::polygonise(
        [=](const Vec3& p) {
            const double across = std::abs(std::hypot(p.x(), p.z()) - radius) - 0.5 * thickness;
            return std::max(across, std::abs(p.y()) - 0.5 * height);
        },
        Vec3(-0.4, -0.4, -0.4), Vec3(0.4, 0.4, 0.4), 0.012);
}

GarmentMesh garment_of(const TriangleMesh& mesh) { return make_garment(mesh.positions, mesh.triangles); }

TEST(OutwardCloth, FacesInAnyOrientationAreTurnedOutwards)
{
    const TriangleMesh sphere = ball(0.3);
    TriangleMesh mixed = sphere;
    for (Eigen::Index f = 0; f < mixed.triangles.rows(); f += 3)
        std::swap(mixed.triangles(f, 1), mixed.triangles(f, 2));
    const TriangleMesh cloth = outward_cloth(garment_of(mixed));
    EXPECT_EQ(cloth.triangles.rows(), sphere.triangles.rows());
    EXPECT_NEAR(volume(cloth), volume(sphere), 1e-9);
}

TEST(OutwardCloth, EqualVerticesAndFacesAreMerged)
{
    const TriangleMesh sphere = ball(0.3);
    const TriangleMesh cloth = outward_cloth(garment_of(fixtures::joined(sphere, sphere)));
    EXPECT_EQ(cloth.positions.rows(), sphere.positions.rows());
    EXPECT_EQ(cloth.triangles.rows(), sphere.triangles.rows());
}

TEST(OutwardCloth, OfThickClothTheOuterSheetRemains)
{
    constexpr double radius = 0.25, thickness = 0.018;
    const TriangleMesh thick = thick_tube(radius, 0.4, thickness);
    const TriangleMesh cloth = outward_cloth(garment_of(thick));
    EXPECT_LT(area(cloth), 0.6 * area(thick));
    double inner = 0;
    for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f) {
        const Vec3 middle = cloth.positions(cloth.triangles.row(f), Eigen::all).colwise().mean();
        if (std::hypot(middle.x(), middle.z()) < radius - 0.25 * thickness)
            inner += area_vector(cloth.positions, cloth.triangles, f).norm();
    }
    EXPECT_LT(inner, 0.05 * area(cloth));
}

}  // namespace
