// SPDX-License-Identifier: GPL-3.0-or-later
// People in random poses put on random crumpled garments and go to a random pose: nothing may cross.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "fixtures.h"
#include "garmentfit/recover_pose.h"
#include "garmentfit/rig_body.h"

namespace garmentfit {
namespace {

class RandomChoice {
public:
    explicit RandomChoice(unsigned seed) : random_(seed) { }
    double between(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    bool one_in(int count) { return std::uniform_int_distribution(1, count)(random_) == 1; }
    Vec3 direction() { return Vec3(between(-1, 1), between(-1, 1), between(-1, 1)).normalized(); }

private:
    std::mt19937 random_;
};

fixtures::Person random_person(RandomChoice& random)
{
    fixtures::PersonOptions options;
    options.arm_angle = random.between(-50, 70);
    options.elbow_angle = random.between(0, 60);
    options.wrist_angle = random.between(0, 40);
    options.hip_angle = random.between(0, 60);
    options.knee_angle = random.between(0, 60);
    return fixtures::capsule_person(options);
}

/// A shirt or trousers, of some length, as far off the skin as that, each vertex out of its place by up to `crumpled`.
GarmentMesh random_garment(RandomChoice& random, const Skeleton& skeleton, double ease, double crumpled)
{
    const bool shirt = random.one_in(2);
    const double bone_end = random.between(0.1, 0.35);  // m, of sleeves and legs from shoulders and hips
    const Vec3 waist = skeleton.tail(lowerback), neck = skeleton.tail(thorax);
    const auto beyond = [&](const Vec3& p, Bone bone) {
        return skeleton.direction(bone).dot(p - skeleton.head(bone)) > bone_end
            && (p - skeleton.head(bone)).norm() < (p - waist).norm();
    };
    const TriangleMesh mesh = fixtures::garment_round(skeleton, ease, [&](const Vec3& p) {
        const double above_waist = p.y() - waist.y();
        return shirt ? above_waist > -0.15 && p.y() < neck.y() && !beyond(p, lhumerus) && !beyond(p, rhumerus)
                     : above_waist < 0.05 && (p - skeleton.tail(ltibia)).norm() > 0.15
                && (p - skeleton.tail(rtibia)).norm() > 0.15 && std::abs(p.x()) < 0.25;
    });
    GarmentMesh garment = make_garment(mesh.positions, mesh.triangles);
    for (auto p : garment.positions.rowwise())
        p += crumpled * random.between(0, 1) * random.direction().transpose();
    return garment;
}

Pose random_pose(RandomChoice& random, double most_degrees)
{
    Pose pose;
    for (Eigen::Quaterniond& turn : pose.rotations)
        turn = Eigen::AngleAxisd(random.between(0, most_degrees) * M_PI / 180, random.direction());
    return pose;
}

void expect_no_crossing(const std::vector<WornGarment>& garments, const std::vector<Positions>& at,
                        const TriangleMesh& body)
{
    for (std::size_t i = 0; i < garments.size(); ++i) {
        const TriangleMesh cloth { at[i], garments[i].rest.triangles };
        EXPECT_TRUE(cloth.positions.allFinite());
        EXPECT_EQ(crossing_count(cloth, body), 0);
        const std::vector<Crossing> now = self_crossings(cloth),
                                    given = self_crossings({ garments[i].rest.positions, garments[i].rest.triangles });
        for (const Crossing& crossing : now)
            EXPECT_EQ(std::count(given.begin(), given.end(), crossing), 1) << "a crossing that was not given";
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_EQ(crossing_count(cloth, { at[j], garments[j].rest.triangles }), 0);
    }
}

std::vector<Positions> places(const std::vector<WornGarment>& garments)
{
    std::vector<Positions> result;
    for (const WornGarment& garment : garments)
        result.push_back(garment.positions);
    return result;
}

class RandomDressing : public testing::TestWithParam<unsigned> { };

TEST_P(RandomDressing, NothingCrosses)
{
    RandomChoice random(GetParam());
    const fixtures::Person person = random_person(random);
    const BodyMesh body = make_body(person.mesh.positions, person.mesh.triangles);
    const Triangles& skin = body.surface.triangles;
    const Rig rig = rig_body(body);
    DrapeOptions drape;
    drape.settling_steps = 5;
    DrapeResult dressed;
    const int layers = random.one_in(3) ? 2 : 1;
    double ease = random.between(-0.01, 0.03);
    for (int layer = 0; layer < layers; ++layer, ease += random.between(0.01, 0.04)) {
        const GarmentMesh garment = random_garment(random, person.skeleton, ease, random.between(0, 0.01));
        dressed = drape_garment(rig, body, dressed, garment, drape);
        expect_no_crossing(dressed.garments, places(dressed.garments), { dressed.body, skin });
        if (dressed.scale_reached < 1)
            return;  // too small, and returned as it is
    }
    RecoverOptions recover;
    recover.settling_steps = 5;
    recover.frames = 4;
    recover.quality = random.between(0, 1) < 0.5 ? Quality::draft : Quality::standard;
    const RecoverResult moved = recover_pose(rig, body, dressed, random_pose(random, 35), recover);
    for (const RecoverFrame& frame : moved.frames)
        expect_no_crossing(dressed.garments, frame.garments, { frame.body, skin });
    expect_no_crossing(moved.garments, places(moved.garments), { moved.body, skin });
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomDressing, testing::Range(0u, 12u));

}  // namespace
}  // namespace garmentfit
