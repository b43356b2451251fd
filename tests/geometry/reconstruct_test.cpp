// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/reconstruct.h"

#include <random>
#include <string>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/error.h"
#include "garmentfit/rig_body.h"

namespace {

using namespace garmentfit;

TEST(ReconstructSurface, LaysASurfaceThroughTheScanOfAPerson)
{
    const fixtures::Person person = fixtures::capsule_person({ .spacing = 0.02 });
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.001);
    Positions points = person.mesh.positions.unaryExpr([&](double x) { return x + noise(random); });
    const BodyMesh body = make_body(points, reconstruct_surface(points));
    const Rig rig = rig_body(body);
    for (const int bone : { lfemur, rfemur, ltibia, rtibia, lhumerus, rhumerus, lradius, rradius })
        EXPECT_LT((rig.skeleton.tail(bone) - person.skeleton.tail(bone)).norm(), 0.1) << bone_name(bone);
}

TEST(ReconstructSurface, LeavesOutliersOut)
{
    const fixtures::Person person = fixtures::capsule_person({ .spacing = 0.03 });
    const Eigen::Index n = person.mesh.positions.rows();
    Positions points(n + 3, 3);
    points.topRows(n) = person.mesh.positions;
    points.bottomRows(3) << 1, 1, 1, -1, 0.5, 1, 0.3, 1.9, 0.8;
    EXPECT_LT(reconstruct_surface(points).maxCoeff(), n);
}

TEST(ReconstructSurface, RefusesAFewPoints)
{
    try {
        reconstruct_surface(Positions::Random(20, 3));
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_NE(std::string(error.what()).find("20 points"), std::string::npos);
    }
}

}  // namespace
