// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/widen_garment.h"

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/rig_body.h"

namespace garmentfit {
namespace {

using namespace fixtures;

struct Dressing {
    BodyMesh body;
    Rig rig;
    GarmentMesh trousers;

    Dressing()
    {
        PersonOptions options;
        options.arm_angle = 20;
        const TriangleMesh mesh = capsule_person(options).mesh;
        body = make_body(mesh.positions, mesh.triangles);
        rig = rig_body(body);
        const TriangleMesh cloth = garment_round(person_skeleton({}), 0.02, [](const Vec3& p) {
            return p.y() > 0.2 && p.y() < 1.0 && std::abs(p.x()) < 0.26;
        });
        trousers = make_garment(cloth.positions, cloth.triangles);
    }
};

/// m, mean distance of the cloth half way down a thigh from its bone.
double radius_at_thigh(const GarmentMesh& garment, const Skeleton& skeleton, double shift)
{
    double sum = 0;
    int count = 0;
    for (const auto& row : garment.positions.rowwise()) {
        const Vec3 p = row.transpose() - shift * Vec3::UnitX(), out = p - skeleton.head(lfemur),
                   axis = skeleton.direction(lfemur);
        const double along = out.dot(axis) / skeleton.length(lfemur), across = (out - out.dot(axis) * axis).norm();
        if (along > 0.4 && along < 0.7 && across < 0.15) {
            sum += across;
            ++count;
        }
    }
    return sum / count;
}

double height(const GarmentMesh& garment)
{
    return garment.positions.col(1).maxCoeff() - garment.positions.col(1).minCoeff();
}

TEST(WidenGarment, WidensGirthsAndKeepsLengths)
{
    const Dressing d;
    const Widening widening { { "left thigh", 1.3 }, { "right thigh", 1.3 } };
    const GarmentMesh wider = widen_garment(d.rig, d.body, {}, d.trousers, widening);
    EXPECT_EQ(wider.triangles, d.trousers.triangles);
    const double before = radius_at_thigh(d.trousers, d.rig.skeleton, 0);
    EXPECT_NEAR(radius_at_thigh(wider, d.rig.skeleton, 0) / before, 1.3, 0.02);
    EXPECT_NEAR(height(wider), height(d.trousers), 0.02);
    EXPECT_EQ(largest_factor(widening), 1.3);
    EXPECT_EQ(largest_factor({}), 1);
}

TEST(WidenGarment, LegsMoveApartWithTheHips)
{
    const Dressing d;
    const GarmentMesh wider = widen_garment(d.rig, d.body, {}, d.trousers, { { "hips", 1.4 } });
    const double apart = 0.4 * std::abs(d.rig.skeleton.tail(lhipjoint).x() - d.rig.skeleton.root.x());
    const double side = d.rig.skeleton.tail(lhipjoint).x() > d.rig.skeleton.root.x() ? 1 : -1;
    EXPECT_NEAR(radius_at_thigh(wider, d.rig.skeleton, side * apart), radius_at_thigh(d.trousers, d.rig.skeleton, 0),
                0.01);
    EXPECT_NEAR(height(wider), height(d.trousers), 0.02);
}

TEST(WidenGarment, NothingChangesWhereNothingIsWider)
{
    const Dressing d;
    const GarmentMesh same = widen_garment(d.rig, d.body, {}, d.trousers, {});
    EXPECT_LT((same.positions - d.trousers.positions).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Widening, IsAlikeOnBothSides)
{
    Widening widening { { "right calf", 1.4 } };
    widen_both_sides(widening, "left calf", 1.2);
    widen_both_sides(widening, "waist", 1.1);
    EXPECT_EQ(widening, (Widening { { "left calf", 1.2 }, { "right calf", 1.4 }, { "waist", 1.1 } }));
    EXPECT_EQ(factor_of(widening, "neck"), 1);
}

}  // namespace
}  // namespace garmentfit
