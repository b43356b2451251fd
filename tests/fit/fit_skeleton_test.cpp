// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/fit_skeleton.h"
#include "garmentfit/io.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/error.h"
#include "hypotheses.h"
#include "outward_cloth.h"
#include "shoulder_lids.h"
#include "tuning.h"
#include "winding_number.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

constexpr double k_degree = std::numbers::pi / 180;

Rig rig_of(const PersonOptions& options)
{
    Rig rig;
    rig.skeleton = person_skeleton(options);
    return rig;
}

double along(const Vec3& p, const Vec3& from, const Vec3& to)
{
    return (p - from).dot(to - from) / (to - from).squaredNorm();
}

// Cut off at neck, wrists and ankles.
GarmentMesh jumpsuit(const PersonOptions& options, double ease = 0.02)
{
    const Skeleton s = person_skeleton(options);
    const TriangleMesh mesh = garment_round(s, ease, [&](const Vec3& p) {
        for (const int arm : { lradius, rradius })
            if (along(p, s.head(arm), s.tail(arm)) > 0.85 && std::abs(p.x()) > 0.3)
                return false;
        return p.y() > 0.15 && p.y() < 1.45;
    });
    return make_garment(mesh.positions, mesh.triangles);
}

GarmentMesh trousers(const PersonOptions& options = {})
{
    const Skeleton s = person_skeleton(options);
    const TriangleMesh mesh
        = garment_round(s, 0.02, [](const Vec3& p) { return p.y() > 0.15 && p.y() < 1.0 && std::abs(p.x()) < 0.26; });
    return make_garment(mesh.positions, mesh.triangles);
}

// Sleeves end at `sleeve` of the way from the shoulder (0) over the elbow (1) to the wrist (2).
GarmentMesh shirt(const PersonOptions& options, double sleeve, double ease = 0.02)
{
    const Skeleton s = person_skeleton(options);
    const TriangleMesh mesh = garment_round(s, ease, [&](const Vec3& p) {
        const bool arm = std::abs(p.x()) > 0.24;
        const double upper
            = std::max(along(p, s.head(lhumerus), s.tail(lhumerus)), along(p, s.head(rhumerus), s.tail(rhumerus)));
        const double lower
            = std::max(along(p, s.head(lradius), s.tail(lradius)), along(p, s.head(rradius), s.tail(rradius)));
        if (arm)
            return sleeve > 1 ? lower < sleeve - 1 : upper < sleeve;
        return p.y() > 0.85 && p.y() < 1.46;
    });
    return make_garment(mesh.positions, mesh.triangles);
}

GarmentMesh cut(const GarmentMesh& garment, const std::function<bool(const Vec3&)>& keep)
{
    std::vector<Eigen::Index> rows;
    for (Eigen::Index f = 0; f < garment.triangles.rows(); ++f)
        if (keep(garment.positions(garment.triangles.row(f), Eigen::all).colwise().mean().transpose()))
            rows.push_back(f);
    return make_garment(garment.positions, garment.triangles(rows, Eigen::all));
}

GarmentMesh with_left_sleeve_only(const GarmentMesh& shirt)
{
    return cut(shirt, [](const Vec3& p) { return p.x() > -0.3; });  // beyond the shoulder
}

// The hood is up, with an opening for the face.
GarmentMesh hoodie(const PersonOptions& options)
{
    const Skeleton s = person_skeleton(options);
    const TriangleMesh mesh = garment_round(s, 0.02, [&](const Vec3& p) {
        const bool arm = std::abs(p.x()) > 0.24, face = p.z() > 0.04 && p.y() > 1.5;
        const double lower
            = std::max(along(p, s.head(lradius), s.tail(lradius)), along(p, s.head(rradius), s.tail(rradius)));
        return arm ? lower < 0.9 : p.y() > 0.85 && !face;
    });
    return make_garment(mesh.positions, mesh.triangles);
}

GarmentMesh with_open_front(const GarmentMesh& shirt)
{
    return cut(shirt, [](const Vec3& p) { return std::abs(p.x()) > 0.05 || p.z() < 0; });
}

// 24 facets, rings 2 cm apart; along y.
GarmentMesh skirt(double waist, double hips, double hem, double length)
{
    constexpr int facets = 24;
    const int rings = int(length / 0.02) + 1;
    Positions positions(facets * rings, 3);
    Triangles triangles(2 * facets * (rings - 1), 3);
    for (int r = 0; r < rings; ++r) {
        const double t = double(r) / (rings - 1);  // of the way down
        const double radius = t < 0.3 ? waist + t / 0.3 * (hips - waist) : hips + (t - 0.3) / 0.7 * (hem - hips);
        for (int k = 0; k < facets; ++k) {
            const double a = 2 * std::numbers::pi * k / facets;
            positions.row(r * facets + k) << radius * std::cos(a), 1 - t * length, 0.7 * radius * std::sin(a);
        }
    }
    for (int r = 0, f = 0; r + 1 < rings; ++r)
        for (int k = 0; k < facets; ++k, f += 2) {
            const int a = r * facets + k, b = r * facets + (k + 1) % facets;
            triangles.row(f) << a, b, a + facets;
            triangles.row(f + 1) << b, b + facets, a + facets;
        }
    return make_garment(positions, triangles);
}

// Sleeveless, from the shoulders to the ankles.
GarmentMesh long_dress()
{
    const auto radius = [](double y) { return 0.18 + 0.14 * std::clamp(1.1 - y, 0.0, 1.0); };
    const auto beyond = [&](const Vec3& p) { return std::hypot(p.x(), p.z() / 0.65) - radius(p.y()); };
    const TriangleMesh mesh = polygonise([&](const Vec3& p) { return std::max(beyond(p), p.y() - 1.44); },
                                         Vec3(-0.5, 0, -0.4), Vec3(0.5, 1.6, 0.4), 0.02);
    return cut(make_garment(mesh.positions, mesh.triangles), [&](const Vec3& p) {
        const bool neck = p.y() > 1.4 && std::hypot(p.x(), p.z()) < 0.08;
        const bool arm = std::abs(p.x()) > 0.9 * radius(p.y()) && p.y() > 1.2 && p.y() < 1.4;
        return p.y() > 0.2 && !neck && !arm;
    });
}

// A tube below the arms, and a strap between two facets of its rim. `bow` is how far, m, it is off the straight line at
// a place from 0 to pi along it.
GarmentMesh with_strap(const GarmentMesh& tube, int from, int to, const std::function<Vec3(double)>& bow)
{
    constexpr int steps = 12;
    TriangleMesh strap { Positions(2 * (steps + 1), 3), Triangles(2 * steps, 3) };
    for (int i = 0; i <= steps; ++i)
        for (int k = 0; k < 2; ++k) {
            const double t = double(i) / steps;
            strap.positions.row(2 * i + k) = (1 - t) * tube.positions.row(from + k) + t * tube.positions.row(to + 1 - k)
                + bow(std::numbers::pi * t).transpose();
        }
    for (int i = 0; i < steps; ++i) {
        strap.triangles.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 1;
        strap.triangles.row(2 * i + 1) << 2 * i + 1, 2 * i + 2, 2 * i + 3;
    }
    const TriangleMesh both = joined({ tube.positions, tube.triangles }, strap);  // welded where they touch
    return make_garment(both.positions, both.triangles);
}

GarmentMesh tube_dress(double length)
{
    GarmentMesh dress = skirt(0.17, 0.18, 0.25, length);
    dress.positions.col(1).array() += 0.2;
    return dress;
}

// Straps, 24 cm high, from front to back.
GarmentMesh strap_dress(double length)
{
    const auto up = [](double t) { return Vec3(0, 0.24 * std::sin(t), 0); };
    return with_strap(with_strap(tube_dress(length), 3, 20, up), 8, 15, up);
}

// A strap from one side of the front to the other, up over the chest and behind the neck.
GarmentMesh halter_dress(double length)
{
    return with_strap(tube_dress(length), 4, 7, [](double t) {
        const double up = std::sin(t);
        return Vec3(0, 0.33 * std::sqrt(std::abs(up)), -0.2 * std::pow(up, 4));
    });
}

// Two sheets, sewn together along every edge: a closed surface.
GarmentMesh with_thickness(const GarmentMesh& garment, double thickness)
{
    const Eigen::Index n = garment.positions.rows(), m = garment.triangles.rows();
    Positions normals = Positions::Zero(n, 3);
    std::map<std::pair<int, int>, int> edges;
    for (Eigen::Index f = 0; f < m; ++f) {
        const auto corner = [&](int k) { return Vec3(garment.positions.row(garment.triangles(f, k % 3))); };
        const Vec3 area = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        for (int k = 0; k < 3; ++k) {
            normals.row(garment.triangles(f, k)) += area;
            ++edges[{ garment.triangles(f, k), garment.triangles(f, (k + 1) % 3) }];
        }
    }
    for (Eigen::Index v = 0; v < n; ++v)
        normals.row(v).stableNormalize();  // those of no face stay where they are
    Positions positions(2 * n, 3);
    positions << garment.positions, garment.positions - thickness * normals;
    std::vector<Eigen::RowVector3i> faces;
    for (Eigen::Index f = 0; f < m; ++f) {
        const Eigen::RowVector3i t = garment.triangles.row(f), inner = t.array() + int(n);
        faces.insert(faces.end(), { t, { inner[0], inner[2], inner[1] } });
    }
    for (const auto& [edge, count] : edges) {
        const auto [a, b] = edge;
        if (!edges.count({ b, a }))
            faces.insert(faces.end(), { { b, a, a + int(n) }, { b, a + int(n), b + int(n) } });
    }
    Triangles triangles(faces.size(), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        triangles.row(f) = faces[f];
    return make_garment(positions, triangles);
}

GarmentMesh rotate(GarmentMesh garment, const Eigen::Quaterniond& turn)
{
    garment.positions = (garment.positions * turn.toRotationMatrix().transpose()).eval();
    return garment;
}

bool meets(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c)
{
    const auto side
        = [](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) { return (q - p).cross(r - p).dot(s - p); };
    if (side(a, b, c, from) * side(a, b, c, to) > 0)
        return false;
    const double u = side(from, to, a, b), v = side(from, to, b, c), w = side(from, to, c, a);
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

void expect_clear(const Skeleton& joints, const GarmentMesh& garment)
{
    const auto expect = [&](const std::string& name, const Vec3& from, const Vec3& to) {
        int count = 0;
        for (Eigen::Index f = 0; f < garment.triangles.rows(); ++f) {
            const auto corner = [&](int k) { return Vec3(garment.positions.row(garment.triangles(f, k))); };
            count += meets(from, to, corner(0), corner(1), corner(2));
        }
        EXPECT_EQ(count, 0) << name << " passes through the garment";
    };
    for (int b = 0; b < bone_count; ++b)
        expect(std::string(bone_name(b)), joints.head(b), joints.tail(b));
    for (int e = 0; e < extremity_count; ++e)
        expect("extremity " + std::to_string(e), joints.tail(bone_before(Extremity(e))), joints.tips[e]);
}

double angle(const Vec3& a, const Vec3& b) { return std::acos(std::clamp(a.dot(b), -1.0, 1.0)) / k_degree; }

void expect_directions(const Skeleton& joints, const Skeleton& wanted, const std::vector<Bone>& bones, double degrees)
{
    for (const Bone b : bones)
        EXPECT_LT(angle(joints.direction(b), wanted.direction(b)), degrees) << bone_name(b);
}

double largest_difference(const Skeleton& a, const Skeleton& b)
{
    double largest = (a.root - b.root).norm();
    for (int j = 0; j < bone_count; ++j)
        largest = std::max(largest, (a.tails[j] - b.tails[j]).norm());
    return largest;
}

TEST(FitSkeleton, ABodyOffsetAsGarmentGivesTheRestPose)
{
    const PersonOptions input { .arm_angle = 45 };
    const Rig rig = rig_of(input);
    const FitResult result = fit_skeleton(rig, jumpsuit(input, 0.01), { .type = GarmentType::jumpsuit });
    EXPECT_LT(largest_difference(pose_skeleton(rig.skeleton, result.pose), rig.skeleton), 0.05);
    EXPECT_GT(result.score_after, result.score_before);
}

TEST(FitSkeleton, ArmsGoIntoTheSleevesAndHandsOutOfTheCuffs)
{
    const PersonOptions input { .arm_angle = 80 }, made_on { .arm_angle = 10 };
    const Rig rig = rig_of(input);
    const GarmentMesh garment = shirt(made_on, 1.9);
    const FitResult result = fit_skeleton(rig, garment, { .type = GarmentType::longsleeve });
    const Skeleton joints = pose_skeleton(rig.skeleton, result.pose);
    expect_directions(joints, person_skeleton(made_on), { lhumerus, lradius, rhumerus, rradius }, 12);
    EXPECT_GT(joints.tail(lradius).x(), 0.5) << "the left arm is in the left sleeve";
    expect_clear(joints, garment);
}

TEST(FitSkeleton, ASittingBodyStandsUpInTrousers)
{
    const Rig rig = rig_of({ .arm_angle = 60, .knee_angle = 85, .hip_angle = 85 });
    const GarmentMesh garment = trousers();
    const FitResult result = fit_skeleton(rig, garment, { .type = GarmentType::trousers });
    const Skeleton joints = pose_skeleton(rig.skeleton, result.pose);
    expect_directions(joints, person_skeleton({}), { lfemur, ltibia, rfemur, rtibia }, 12);
    expect_clear(joints, garment);
}

TEST(FitSkeleton, ThighsOfASittingBodyLeaveAShirtThroughItsHem)
{
    const Rig rig = rig_of({ .arm_angle = 60, .knee_angle = 85, .hip_angle = 85 });
    const GarmentMesh garment = shirt({ .arm_angle = 45 }, 0.6);
    const FitResult result = fit_skeleton(rig, garment, { .type = GarmentType::tshirt });
    expect_clear(pose_skeleton(rig.skeleton, result.pose), garment);
}

TEST(FitSkeleton, UncoveredForearmsStayAsInTheInputPose)
{
    const PersonOptions input { .arm_angle = 45, .elbow_angle = 60 };
    const Rig rig = rig_of(input);
    const FitResult result = fit_skeleton(rig, shirt(input, 0.6), { .type = GarmentType::tshirt });
    const Skeleton joints = pose_skeleton(rig.skeleton, result.pose);
    for (const int b : { lradius, rradius })
        EXPECT_NEAR(angle(joints.direction(b), joints.direction(parent_of(b))), 60, 10);
    EXPECT_EQ(std::count(result.covered.begin(), result.covered.end(), lradius), 0);
}

// The trunk offers an arm more clearance than a short sleeve: with forearms to cover, one of them would stay there.
TEST(FitSkeleton, ShortSleevesHaveBothArmsWhateverTheType)
{
    const PersonOptions made_on { .arm_angle = 45 };
    const Rig rig = rig_of({ .arm_angle = 20 });
    for (const GarmentType type : { GarmentType::longsleeve, GarmentType::jacket }) {
        const FitResult result = fit_skeleton(rig, shirt(made_on, 0.6, 0.05), { .type = type });
        const Skeleton joints = pose_skeleton(rig.skeleton, result.pose);
        EXPECT_GT(joints.tail(lhumerus).x(), 0.25);
        EXPECT_LT(joints.tail(rhumerus).x(), -0.25);
        for (const Bone forearm : { lradius, rradius })
            EXPECT_EQ(std::count(result.covered.begin(), result.covered.end(), forearm), 0);
    }
}

// Cuffs near the middle of the forearms: one arm must not count as covered and the other as bare.
TEST(FitSkeleton, ForearmsAreCoveredOnBothSidesOrOnNone)
{
    for (const double sleeve : { 1.4, 1.45 })
        for (const double arm_angle : { 20, 80 }) {
            const Rig rig = rig_of({ .arm_angle = arm_angle });
            const FitResult result
                = fit_skeleton(rig, shirt({ .arm_angle = 45 }, sleeve), { .type = GarmentType::longsleeve });
            const auto covers = [&](Bone b) { return std::count(result.covered.begin(), result.covered.end(), b); };
            EXPECT_EQ(covers(lradius), covers(rradius)) << "sleeve " << sleeve << ", arms " << arm_angle;
        }
}

TEST(FitSkeleton, TheGarmentMayLieAnywhere)
{
    const PersonOptions input { .arm_angle = 45 };
    const Rig rig = rig_of(input);
    GarmentMesh garment = jumpsuit(input);
    garment.positions.rowwise() += Vec3(3, -2, 5).transpose();
    Skeleton wanted = rig.skeleton;
    const FitResult result = fit_skeleton(rig, garment, { .type = GarmentType::jumpsuit });
    const Skeleton joints = pose_skeleton(rig.skeleton, result.pose);
    EXPECT_LT((joints.root - wanted.root - Vec3(3, -2, 5)).norm(), 0.05);
}

TEST(FitSkeleton, FlippedNormalsAndShuffledVerticesChangeNothing)
{
    const PersonOptions input { .arm_angle = 70 };
    const Rig rig = rig_of(input);
    const GarmentMesh garment = shirt({ .arm_angle = 40 }, 1.9);
    const FitOptions options { .type = GarmentType::longsleeve };
    const Skeleton expected = pose_skeleton(rig.skeleton, fit_skeleton(rig, garment, options).pose);

    GarmentMesh mixed = garment;
    mixed.triangles.col(1).swap(mixed.triangles.col(2));
    for (Eigen::Index f = 0; f < mixed.triangles.rows(); f += 3)
        std::swap(mixed.triangles(f, 1), mixed.triangles(f, 2));
    EXPECT_LT(largest_difference(pose_skeleton(rig.skeleton, fit_skeleton(rig, mixed, options).pose), expected), 0.01);

    GarmentMesh reversed = garment;
    const int last = int(garment.positions.rows()) - 1;
    reversed.positions = garment.positions.colwise().reverse();
    reversed.triangles = garment.triangles.unaryExpr([&](int v) { return last - v; });
    EXPECT_LT(largest_difference(pose_skeleton(rig.skeleton, fit_skeleton(rig, reversed, options).pose), expected),
              0.01);
}

TEST(FitSkeleton, TheSameInputGivesTheSameBits)
{
    const Rig rig = rig_of({ .arm_angle = 70 });
    const GarmentMesh garment = shirt({ .arm_angle = 40 }, 0.6);
    const FitOptions options {};
    const Pose a = fit_skeleton(rig, garment, options).pose, b = fit_skeleton(rig, garment, options).pose;
    EXPECT_EQ(a.root_translation, b.root_translation);
    for (int j = 0; j < bone_count; ++j)
        EXPECT_EQ(a.rotations[j].coeffs(), b.rotations[j].coeffs());
}

TEST(FitSkeleton, ABodyThatFacesAwayTurnsToTheGarmentsFront)
{
    const PersonOptions made_on { .arm_angle = 40, .elbow_angle = 40 };  // sleeves bend forwards, which tells the front
    Rig rig = rig_of({ .arm_angle = 70 });
    const auto turned = [](const Vec3& p) { return Vec3(-p.x(), p.y(), -p.z()); };
    rig.skeleton.root = turned(rig.skeleton.root);
    std::transform(rig.skeleton.tails.begin(), rig.skeleton.tails.end(), rig.skeleton.tails.begin(), turned);
    std::transform(rig.skeleton.tips.begin(), rig.skeleton.tips.end(), rig.skeleton.tips.begin(), turned);
    rig.front = -rig.front;
    const FitResult result = fit_skeleton(rig, shirt(made_on, 1.9), { .type = GarmentType::longsleeve });
    EXPECT_GT((result.pose.root_rotation * rig.front).z(), 0.8);
    EXPECT_GT(pose_skeleton(rig.skeleton, result.pose).tail(lradius).x(), 0.3) << "the left arm is in the left sleeve";
}

TEST(FitSkeleton, AGarmentThatLiesRoundTheBodyIsWornThere)
{
    const PersonOptions options { .arm_angle = 45, .elbow_angle = 20 };
    const Person person = capsule_person(options);
    const Rig rig = simple_rig(person);
    const FitResult result = fit_skeleton(rig, person.mesh, shirt(options, 1.9, 0.03));
    EXPECT_EQ(result.type, GarmentType::longsleeve);
    EXPECT_EQ(largest_difference(pose_skeleton(rig.skeleton, result.pose), rig.skeleton), 0) << "nothing moves";
    EXPECT_GT(result.front_probability, 0.9);
}

Person moved_up(Person person, double height)
{
    const Vec3 shift(0, height, 0);
    person.mesh.positions.rowwise() += shift.transpose();
    person.skeleton.root += shift;
    for (Vec3& tail : person.skeleton.tails)
        tail += shift;
    for (Vec3& tip : person.skeleton.tips)
        tip += shift;
    return person;
}

// Avatars and clothes have the floor or the pelvis at the origin: two files need not agree.
TEST(FitSkeleton, AGarmentOfAFileWithAnotherFloorIsWornThere)
{
    const PersonOptions options { .arm_angle = 45, .elbow_angle = 20 };
    const Person on_floor = capsule_person(options);
    const double pelvis = on_floor.skeleton.root.y();
    ASSERT_GT(pelvis, 0.5);
    for (const double up : { 0.0, -pelvis }) {
        const Person person = moved_up(on_floor, up);
        const Rig rig = simple_rig(person);
        GarmentMesh garment = shirt(options, 1.9, 0.03);
        const double garment_up = up == 0 ? -pelvis : 0;
        garment.positions.col(1).array() += garment_up;
        const Skeleton worn = pose_skeleton(rig.skeleton, fit_skeleton(rig, person.mesh, garment).pose);
        EXPECT_LT(largest_difference(worn, moved_up(person, garment_up - up).skeleton), 0.02) << up;  // m, of the soles
        FitOptions as_placed;
        as_placed.as_placed = true;
        expect_invalid([&] { fit_skeleton(rig, person.mesh, garment, as_placed); }, "place");
    }
}

TEST(FitSkeleton, AsPlacedRefusesAGarmentThatLiesElsewhere)
{
    const PersonOptions options { .arm_angle = 45 };
    const Person person = capsule_person(options);
    const Rig rig = simple_rig(person);
    GarmentMesh garment = shirt(options, 1.9, 0.03);
    FitOptions as_placed;
    as_placed.as_placed = true;
    EXPECT_EQ(largest_difference(pose_skeleton(rig.skeleton, fit_skeleton(rig, person.mesh, garment, as_placed).pose),
                                 rig.skeleton),
              0);
    garment.positions.rowwise() += Vec3(3, 0, 0).transpose();
    expect_invalid([&] { fit_skeleton(rig, person.mesh, garment, as_placed); }, "does not lie round the body");
    expect_invalid([&] { fit_skeleton(rig, garment, as_placed); }, "give the body");
}

// Its openings could be those of a skirt, a top, or either upside down.
TEST(FitSkeleton, ABandIsWornWhereItLies)
{
    const Person person = capsule_person({ .arm_angle = 45 });
    const Rig rig = simple_rig(person);
    for (const auto& [low, high, bone] : { std::tuple(1.22, 1.34, upperback), std::tuple(0.82, 0.94, lhipjoint) }) {
        const TriangleMesh band = garment_round(person.skeleton, 0.02, [&](const Vec3& p) {
            return p.y() > low && p.y() < high && std::abs(p.x()) < 0.25;
        });
        const FitResult result = fit_skeleton(rig, person.mesh, make_garment(band.positions, band.triangles));
        EXPECT_EQ(largest_difference(pose_skeleton(rig.skeleton, result.pose), rig.skeleton), 0) << low;
        EXPECT_NE(std::find(result.covered.begin(), result.covered.end(), bone), result.covered.end()) << low;
    }
}

TEST(FitSkeleton, AGivenFrontIsTheFront)
{
    const Rig rig = rig_of({ .arm_angle = 70 });
    const GarmentMesh garment = shirt({ .arm_angle = 40, .elbow_angle = 40 }, 1.9);
    for (const double z : { 1.0, -1.0 }) {
        FitOptions options;
        options.front = z * Vec3::UnitZ();
        const FitResult result = fit_skeleton(rig, garment, options);
        EXPECT_GT((result.pose.root_rotation * rig.front).z() * z, 0.8);
        EXPECT_NEAR(result.front_probability, 1, 1e-9);
    }
}

TEST(FitSkeleton, AGivenFrontHoldsWhereTheClothWouldTurnTheBody)
{
    const Rig rig = rig_of({ .arm_angle = 70 });
    GarmentMesh oval = skirt(0.15, 0.2, 0.2, 0.5);
    oval.positions.col(2) *= 0.7;
    for (const Vec3& front : { Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1) }) {
        FitOptions options;
        options.type = GarmentType::skirt;
        options.front = front;
        const FitResult result = fit_skeleton(rig, oval, options);
        EXPECT_GT((result.pose.root_rotation * rig.front).dot(front), 0.8) << front.transpose();
    }
}

TEST(FitSkeleton, TheNextProbableWayIsAnotherOne)
{
    const Rig rig = rig_of({ .arm_angle = 70 });
    const GarmentMesh garment = shirt({ .arm_angle = 40 }, 1.9);
    FitOptions second;
    second.skipped = 1;
    const FitResult first = fit_skeleton(rig, garment), next = fit_skeleton(rig, garment, second);
    EXPECT_LE(next.probability, first.probability);
    EXPECT_TRUE(next.type != first.type || next.front.dot(first.front) < 0.5
                || largest_difference(pose_skeleton(rig.skeleton, next.pose), pose_skeleton(rig.skeleton, first.pose))
                    > 1e-6);
}

TEST(FitSkeleton, TheMostProbableWaysSumToOneAndOthersStandInForOneOfThem)
{
    const Rig rig = rig_of({ .arm_angle = 70 });
    for (const GarmentMesh& garment : { skirt(0.15, 0.2, 0.2, 0.5), shirt({ .arm_angle = 40 }, 1.9), trousers() }) {
        double sum = 0;
        const std::vector<Hypothesis> all = find_hypotheses(rig, {}, outward_cloth(garment), {}, {});
        for (const Hypothesis& one : all) {
            sum += one.wearing.rank == 0 ? one.probability : 0;
            EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                                    [&](const Hypothesis& other) {
                                        return other.wearing.rank == 0 && is_same_way(one, other)
                                            && one.probability == other.probability;
                                    }))
                << one.wearing.rank << ", " << one.probability;
        }
        EXPECT_NEAR(sum, 1, 1e-9);
    }
}

TEST(FitSkeleton, AGarmentUpsideDownOrLyingIsFound)
{
    const PersonOptions input { .arm_angle = 45 };
    const Rig rig = rig_of(input);
    const GarmentMesh upright = shirt({ .arm_angle = 30 }, 1.9);
    const FitResult expected = fit_skeleton(rig, upright);
    EXPECT_EQ(expected.up, Vec3::UnitY());
    for (const double half_or_quarter : { std::numbers::pi, std::numbers::pi / 2 }) {
        const Eigen::Quaterniond turn(Eigen::AngleAxisd(half_or_quarter, Vec3::UnitX()));
        GarmentMesh garment = upright;
        garment.positions = garment.positions * turn.toRotationMatrix().transpose();
        const FitResult result = fit_skeleton(rig, garment);
        EXPECT_EQ(result.type, GarmentType::longsleeve);
        EXPECT_LT((result.up - turn * Vec3::UnitY()).norm(), 1e-6);
        const Skeleton joints = pose_skeleton(rig.skeleton, result.pose),
                       wanted = pose_skeleton(rig.skeleton, expected.pose);
        for (const int b : { thorax, lhumerus, rhumerus, lradius, rradius })
            EXPECT_LT(angle(joints.direction(b), turn * wanted.direction(b)), 10) << bone_name(b);
    }
}

TEST(FitSkeleton, AGarmentAtAnyAngleIsFound)
{
    const PersonOptions made_on { .arm_angle = 40 };
    const Rig rig = rig_of({ .arm_angle = 70 });
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(30 * k_degree, Vec3(1, 0.4, 1).normalized()));
    for (const GarmentMesh& garment : { shirt(made_on, 1.9), trousers(made_on), jumpsuit(made_on) }) {
        const FitResult expected = fit_skeleton(rig, garment), result = fit_skeleton(rig, rotate(garment, turn));
        EXPECT_EQ(result.type, expected.type);
        EXPECT_LT(angle(result.up, turn * Vec3::UnitY()), 8) << name_of(expected.type);
        EXPECT_GT(result.up_probability, 0.5);
        const Skeleton joints = pose_skeleton(rig.skeleton, result.pose),
                       wanted = pose_skeleton(rig.skeleton, expected.pose);
        for (const Bone b : expected.covered)
            EXPECT_LT(angle(joints.direction(b), turn * wanted.direction(b)), 25)
                << bone_name(b) << " in " << name_of(expected.type);
    }
}

TEST(FitSkeleton, ASkirtsWaistIsUp)
{
    const Rig rig = rig_of({ .arm_angle = 45 });
    const GarmentMesh garment = skirt(0.15, 0.2, 0.2, 0.5);
    const FitResult upright = fit_skeleton(rig, garment);
    EXPECT_EQ(upright.type, GarmentType::skirt);
    EXPECT_EQ(upright.up, Vec3::UnitY());
    const Eigen::Quaterniond over(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()));
    EXPECT_LT(angle(fit_skeleton(rig, rotate(garment, over)).up, -Vec3::UnitY()), 1);
}

TEST(FitSkeleton, TheGirthAtTheTopTellsSkirtsFromStraplessDresses)
{
    const Rig rig = rig_of({ .arm_angle = 45 });
    for (const double length : { 0.8, 0.9 }) {
        EXPECT_EQ(fit_skeleton(rig, skirt(0.13, 0.2, 0.26, length)).type, GarmentType::skirt) << length;
        const FitResult dress = fit_skeleton(rig, skirt(0.19, 0.18, 0.26, length));
        EXPECT_EQ(dress.type, GarmentType::dress) << length;
        EXPECT_EQ(std::count(dress.covered.begin(), dress.covered.end(), lclavicle), 0) << "no strap holds it";
    }
}

TEST(FitSkeleton, AShortTubeWithANarrowWaistIsAStraplessTop)
{
    const Rig rig = rig_of({ .arm_angle = 45 });
    for (const double waist : { 0.11, 0.13 }) {
        const FitResult top = fit_skeleton(rig, skirt(0.16, waist, 0.17, 0.38));
        EXPECT_EQ(top.type, GarmentType::strapless) << waist;
        EXPECT_EQ(std::count(top.covered.begin(), top.covered.end(), lfemur), 0) << waist;
        EXPECT_EQ(fit_skeleton(rig, skirt(waist, 0.16, 0.17, 0.38)).type, GarmentType::skirt) << waist;
    }
}

// Its length draws the body down until the collarbones lie across the rim at the top; by its openings it is a skirt.
TEST(FitSkeleton, AStraplessGownDownToTheFloorIsFoundAWay)
{
    const Rig rig = rig_of({ .arm_angle = 45 });
    for (const double length : { 1.2, 1.35 }) {
        const GarmentMesh gown = skirt(0.17, 0.14, 0.35, length);
        const FitResult result = fit_skeleton(rig, gown);
        EXPECT_EQ(result.type, GarmentType::dress) << length;
        expect_clear(pose_skeleton(rig.skeleton, result.pose), gown);
    }
}

// Above the bodice the cloth encloses next to nothing.
TEST(FitSkeleton, StrapsLieBetweenNeckAndShoulders)
{
    const Rig rig = rig_of({ .arm_angle = 45 });
    for (const double length : { 0.4, 0.7 }) {
        const GarmentMesh dress = strap_dress(length);
        const FitResult result = fit_skeleton(rig, dress);
        const Skeleton joints = pose_skeleton(rig.skeleton, result.pose);
        expect_clear(joints, dress);
        for (const Bone clavicle : { lclavicle, rclavicle }) {
            EXPECT_TRUE(std::count(result.covered.begin(), result.covered.end(), clavicle)) << length;
            const Vec3 shoulder = joints.tail(clavicle);
            EXPECT_GT(std::abs(shoulder.x()), 0.1) << length;
            EXPECT_GT(shoulder.y(), 1.25) << length;
            EXPECT_LT(shoulder.y(), 1.46) << length;
        }
        EXPECT_LT(std::abs(joints.tail(lclavicle).x() + joints.tail(rclavicle).x()), 0.04) << length;
    }
}

// Above its bodice, the cloth of a halter encloses next to nothing.
TEST(FitSkeleton, TheLidsOfAHalterEncloseTheChest)
{
    const GarmentMesh dress = halter_dress(0.7);
    const TriangleMesh outward = outward_cloth(dress), lids = lids_at_shoulders(outward, openings_of(outward));
    const TriangleMesh closed = joined(outward, lids);
    const Vec3 chest(0, 1.32, 0.02);
    EXPECT_LT(winding_number(outward, chest), 0.3);
    EXPECT_GT(winding_number(closed, chest), k_winding_inside);
}

// Its largest opening is behind, where that of other clothes is deeper in front.
TEST(FitSkeleton, AHalterIsBareBehind)
{
    const GarmentCues cues = cues_of(openings_of(outward_cloth(halter_dress(0.7))));
    EXPECT_TRUE(cues.is_halter);
    EXPECT_GT(cues.front.dot(Vec3::UnitZ()), 0.99);
    for (const GarmentMesh& garment : { strap_dress(0.7), tube_dress(0.7), shirt({ .arm_angle = 40 }, 1.9) })
        EXPECT_FALSE(cues_of(openings_of(outward_cloth(garment))).is_halter);
}

TEST(FitSkeleton, ClothesWithSleevesAndSkirtsHaveNoLids)
{
    for (const GarmentMesh& garment : { shirt({ .arm_angle = 40 }, 1.9), skirt(0.15, 0.2, 0.2, 0.5), trousers() }) {
        const TriangleMesh outward = outward_cloth(garment);
        EXPECT_EQ(lids_at_shoulders(outward, openings_of(outward)).triangles.rows(), 0);
    }
}

TEST(FitSkeleton, WithoutClothBetweenTheLegsALongDressIsNoJumpsuit)
{
    const Rig rig = rig_of({ .arm_angle = 45 });
    EXPECT_EQ(fit_skeleton(rig, long_dress()).type, GarmentType::dress);
    EXPECT_EQ(fit_skeleton(rig, jumpsuit({ .arm_angle = 45 })).type, GarmentType::jumpsuit);
}

TEST(FitSkeleton, OneSleeveHoldsOneArm)
{
    const PersonOptions made_on { .arm_angle = 40 };
    const Rig rig = rig_of({ .arm_angle = 70 });
    const GarmentMesh garment = with_left_sleeve_only(shirt(made_on, 1.9));
    const FitResult result = fit_skeleton(rig, garment);
    EXPECT_EQ(result.type, GarmentType::longsleeve);
    const Skeleton joints = pose_skeleton(rig.skeleton, result.pose);
    expect_directions(joints, person_skeleton(made_on), { lhumerus, lradius }, 12);
    expect_clear(joints, garment);
    const auto covers = [&](Bone b) { return std::count(result.covered.begin(), result.covered.end(), b) > 0; };
    EXPECT_TRUE(covers(lhumerus) && covers(lradius));
    EXPECT_FALSE(covers(rradius));
}

// Where a cuff is folded, a forearm in its sleeve passes through cloth sooner than an arm beside the spine.
TEST(FitSkeleton, NoArmHangsInTheTrunkBesideAnEmptySleeve)
{
    const Rig rig = rig_of({ .arm_angle = 45 });
    const MeshFile file = MeshFile::read(std::filesystem::path(GARMENTFIT_GARMENTS) / "turtleneck.ply");
    const GarmentMesh garment = make_garment(file.positions(), file.triangles());
    const FitResult result = fit_skeleton(rig, garment);
    const Skeleton joints = pose_skeleton(rig.skeleton, result.pose);
    expect_clear(joints, garment);
    EXPECT_GT(joints.tail(lhumerus).x(), 0.3);
    EXPECT_LT(joints.tail(rhumerus).x(), -0.3);
}

TEST(FitSkeleton, ClosedClothWithThicknessIsFittedLikeItsOuterSheet)
{
    const Rig rig = rig_of({ .arm_angle = 70 });
    const GarmentMesh thin = skirt(0.15, 0.2, 0.2, 0.5), thick = with_thickness(thin, 0.004);
    const FitResult expected = fit_skeleton(rig, thin), result = fit_skeleton(rig, thick);
    EXPECT_EQ(result.type, GarmentType::skirt);
    EXPECT_EQ(result.covered, expected.covered);
    expect_clear(pose_skeleton(rig.skeleton, result.pose), thick);
}

// At wrinkles sharper than 3 mm the two sheets pass through each other.
TEST(FitSkeleton, AThickTShirtIsFittedLikeItsOuterSheet)
{
    const Rig rig = rig_of({ .arm_angle = 70 });
    const MeshFile file = MeshFile::read(GARMENTFIT_DOCS "/samples/tshirt.ply");
    const GarmentMesh thin = make_garment(1.15 * file.positions(), file.triangles()),
                      thick = with_thickness(thin, 0.003);
    const FitResult expected = fit_skeleton(rig, thin), result = fit_skeleton(rig, thick);
    EXPECT_EQ(result.type, GarmentType::tshirt);
    const Skeleton joints = pose_skeleton(rig.skeleton, result.pose);
    expect_directions(joints, pose_skeleton(rig.skeleton, expected.pose), { thorax, lhumerus, rhumerus }, 35);
    expect_clear(joints, thick);
}

TEST(FitSkeleton, ASmallBodyDoesNotSlideIntoOneTrouserLeg)
{
    const Rig rig = rig_of({ .arm_angle = 60 });
    GarmentMesh garment = trousers();
    garment.positions *= 1.5;
    const FitResult result = fit_skeleton(rig, garment);
    const Skeleton joints = pose_skeleton(rig.skeleton, result.pose);
    for (const int b : { ltibia, rtibia })
        EXPECT_GT(joints.head(b).x() * (b == ltibia ? 1 : -1), 0.02) << bone_name(b);
    expect_clear(joints, garment);
}

/// Trousers whose legs are cones side by side, narrow at the ankles.
GarmentMesh slim_trousers(double height, double waist)
{
    constexpr double crotch = 0.78, apart = 0.09, thigh = 0.083, ankle = 0.05;
    const auto distance = [&](const Vec3& p) {
        const double along = std::clamp(p.y() / crotch, 0., 1.2),
                     rise = std::clamp((p.y() - crotch) / (height - crotch), 0., 1.);
        const double leg = std::max(std::hypot(std::abs(p.x()) - apart, p.z()) - std::lerp(ankle, thigh, along),
                                    p.y() - crotch - 0.15);
        const double half_width = std::lerp(apart + thigh, 1.15 * waist, rise),
                     half_depth = std::lerp(1.25 * thigh, 0.85 * waist, rise),
                     round = std::hypot(p.x() / half_width, p.z() / half_depth) - 1;
        return std::min(leg, std::max(round * half_depth, crotch - p.y()));
    };
    const TriangleMesh whole = polygonise(distance, Vec3(-0.35, -0.06, -0.25), Vec3(0.35, height + 0.06, 0.25), 0.025);
    std::vector<Eigen::Index> rows;
    for (Eigen::Index f = 0; f < whole.triangles.rows(); ++f) {
        const double y = whole.positions(whole.triangles.row(f), 1).mean();
        if (y > 0.01 && y < height - 0.01)
            rows.push_back(f);
    }
    return make_garment(whole.positions, whole.triangles(rows, Eigen::all));
}

// On the grid that places are found by, no leg finds its way into these.
TEST(FitSkeleton, SlimTrousersThatReachAboveTheWaistAreNoJumpsuit)
{
    const Rig rig = rig_of({ .arm_angle = 60 });
    for (const auto& [height, waist] : { std::pair(1.1, 0.146), std::pair(1.1, 0.17), std::pair(1.2, 0.17) }) {
        const GarmentMesh garment = slim_trousers(height, waist);
        const FitResult result = fit_skeleton(rig, garment);
        EXPECT_EQ(result.type, GarmentType::trousers) << height << ", " << waist;
        expect_clear(pose_skeleton(rig.skeleton, result.pose), garment);
    }
}

// As of a figure with a large head: legs of a share of a human's length.
Rig with_short_legs(const PersonOptions& options, double share)
{
    Rig rig = rig_of(options);
    Skeleton& s = rig.skeleton;
    for (const auto& [hip, knee, ankle, tip] :
         { std::array<int, 4> { lhipjoint, lfemur, ltibia, lfoot_tip }, { rhipjoint, rfemur, rtibia, rfoot_tip } }) {
        const Vec3 top = s.tail(hip), old = s.tail(ankle);
        s.tails[knee] = top + share * (s.tail(knee) - top);
        s.tails[ankle] = top + share * (old - top);
        s.tips[tip] += s.tail(ankle) - old;
    }
    return rig;
}

TEST(FitSkeleton, LegsThatAreMuchTooShortForTrousersAreFoundAWay)
{
    const GarmentMesh garment = trousers();
    for (const double share : { 0.3, 0.4, 0.5, 0.6 }) {
        const Rig rig = with_short_legs({ .arm_angle = 60 }, share);
        const FitResult result = fit_skeleton(rig, garment, { .type = GarmentType::trousers });
        const Skeleton joints = pose_skeleton(rig.skeleton, result.pose);
        expect_clear(joints, garment);
        EXPECT_LT(joints.tail(lfemur).x() * joints.tail(rfemur).x(), 0) << share << ": both in one leg";
    }
}

TEST(FitSkeleton, TrousersWhoseLegsStayEmptyAreRefused)
{
    int refused = 0;
    for (const double apart : { 0.05, 0.1, 0.15, 0.2 }) {  // wider than the waist in the end
        Rig rig = with_short_legs({ .arm_angle = 60 }, 0.4);
        for (const int bone : { lhipjoint, lfemur, ltibia }) {
            rig.skeleton.tails[bone].x() += apart;
            rig.skeleton.tails[mirror_of(bone)].x() -= apart;
        }
        rig.skeleton.tips[lfoot_tip].x() += apart;
        rig.skeleton.tips[rfoot_tip].x() -= apart;
        try {
            const std::vector<Bone> covered = fit_skeleton(rig, trousers(), { .type = GarmentType::trousers }).covered;
            EXPECT_TRUE(std::find(covered.begin(), covered.end(), lfemur) != covered.end()) << apart;
            EXPECT_TRUE(std::find(covered.begin(), covered.end(), rfemur) != covered.end()) << apart;
        } catch (const InvalidInput&) {
            ++refused;
        } catch (const SolverFailure&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 0);
}

TEST(FitSkeleton, TipsAreShortenedUntilTheyAreClear)
{
    const Skeleton joints = person_skeleton({});
    const GarmentMesh wall = make_garment((Positions(3, 3) << -1, -1, 0.1, 1, -1, 0.1, 0, 3, 0.1).finished(),
                                          (Triangles(1, 3) << 0, 1, 2).finished());
    const Skeleton clear = retract_tips(joints, wall);
    EXPECT_LT(clear.tips[lfoot_tip].z(), 0.1);
    EXPECT_GT(clear.tips[lfoot_tip].z(), joints.tail(ltibia).z());
    EXPECT_EQ(clear.tips[head_top], joints.tips[head_top]);
}

TEST(FitSkeleton, TypesFollowFromTheOpenings)
{
    const PersonOptions a_pose { .arm_angle = 40 };
    EXPECT_EQ(guess_garment_type(shirt(a_pose, 0.6)).type, GarmentType::tshirt);
    EXPECT_EQ(guess_garment_type(shirt(a_pose, 1.9)).type, GarmentType::longsleeve);
    EXPECT_EQ(guess_garment_type(trousers(a_pose)).type, GarmentType::trousers);
    EXPECT_EQ(guess_garment_type(jumpsuit(a_pose)).type, GarmentType::jumpsuit);
    EXPECT_EQ(guess_garment_type(hoodie(a_pose)).type, GarmentType::hoodie);
    EXPECT_EQ(guess_garment_type(with_open_front(shirt(a_pose, 1.9))).type, GarmentType::jacket);
    EXPECT_EQ(guess_garment_type(with_open_front(shirt(a_pose, 0.95))).type, GarmentType::jacket);
    EXPECT_EQ(guess_garment_type(shirt(a_pose, 0.1)).type, GarmentType::vest);
    EXPECT_EQ(guess_garment_type(skirt(0.15, 0.2, 0.2, 0.5)).type, GarmentType::skirt);
    EXPECT_EQ(guess_garment_type(with_left_sleeve_only(shirt(a_pose, 1.9))).type, GarmentType::longsleeve);
}

TEST(FitSkeleton, ACoarseTypeIsReportedAsTheTypeFound)
{
    const PersonOptions a_pose { .arm_angle = 40 };
    const Rig rig = rig_of(a_pose);
    EXPECT_EQ(fit_skeleton(rig, shirt(a_pose, 1.9), { .type = GarmentType::top }).type, GarmentType::longsleeve);
    EXPECT_EQ(fit_skeleton(rig, trousers(a_pose), { .type = GarmentType::bottom }).type, GarmentType::trousers);
}

TEST(FitSkeleton, TypeNamesRoundTrip)
{
    for (const auto name : garment_type_names())
        EXPECT_EQ(name_of(garment_type_of(name)), name);
    try {
        garment_type_of("toga");
        FAIL();
    } catch (const InvalidInput& e) {
        EXPECT_NE(std::string(e.what()).find("toga"), std::string::npos);
        EXPECT_NE(std::string(e.what()).find("trousers"), std::string::npos);
    }
}

TEST(FitSkeleton, AGarmentThatFitsNoBodyIsRefused)
{
    const Rig rig = rig_of({});
    const TriangleMesh sphere
        = polygonise([](const Vec3& p) { return p.norm() - 0.4; }, Vec3::Constant(-0.5), Vec3::Constant(0.5), 0.05);
    const GarmentMesh closed = make_garment(sphere.positions, sphere.triangles);
    EXPECT_THROW(fit_skeleton(rig, closed), InvalidInput);
    EXPECT_THROW(fit_skeleton(rig, closed, { .type = GarmentType::tshirt }), InvalidInput);

    GarmentMesh plate = closed;
    plate.positions.col(2).setZero();
    EXPECT_THROW(fit_skeleton(rig, plate), InvalidInput);
}

TEST(FitSkeleton, ARefusalSaysWhatToDo)
{
    const Rig rig = rig_of({ .arm_angle = 40 });
    const GarmentMesh garment = shirt({ .arm_angle = 40 }, 1.9);
    const auto of_size = [&](double scale) {
        GarmentMesh scaled = garment;
        scaled.positions *= scale;
        return scaled;
    };
    for (const double scale : { 0.05, 0.15 })
        expect_invalid([&] { fit_skeleton(rig, of_size(scale), { .type = GarmentType::longsleeve }); }, "garment_unit");
    const GarmentMesh belt = skirt(0.15, 0.2, 0.2, 0.25);
    expect_invalid([&] { fit_skeleton(rig, belt, { .type = GarmentType::suit }); },
                   "as a garment of type suit; check the type");
    expect_invalid([&] { fit_skeleton(rig, belt, { .type = GarmentType::suit, .front = Vec3(0, 0, 1) }); },
                   "check garment_front");
}

TEST(FitSkeleton, AGarmentInAWrongUnitIsRefused)
{
    const Rig rig = rig_of({});
    GarmentMesh garment = trousers();
    for (const double unit : { 1000.0, 30.0, 0.01 }) {
        GarmentMesh scaled = garment;
        scaled.positions *= unit;
        for (const FitMethod method : { FitMethod::fast, FitMethod::paper })
            expect_invalid([&] { fit_skeleton(rig, scaled, { .method = method }); }, "garment_unit");
    }
    garment.positions.conservativeResize(garment.positions.rows() + 1, 3);
    garment.positions.bottomRows(1) << 0, 1e6, 0;  // in no face
    EXPECT_NO_THROW(require_wearable_size(rig, garment));
}

TEST(FitSkeleton, ScrapsOfClothAreRefused)
{
    const Rig rig = rig_of({});
    const auto expect_refused = [&](const TriangleMesh& mesh, const std::string& what, const std::string& word = "") {
        try {
            fit_skeleton(rig, make_garment(mesh.positions, mesh.triangles));
            ADD_FAILURE() << what << " is accepted";
        } catch (const InvalidInput& e) {
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << what;
            EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
        }
    };
    const Vec3 low(-0.3, 0.8, -0.1), high(0.3, 1.4, 0.5);
    const TriangleMesh slab
        = polygonise([](const Vec3& p) { return (p - Vec3(0, 1.1, 0.2)).norm() - 0.25; }, low, high, 0.05);
    TriangleMesh square = slab;
    square.positions.col(2).setZero();
    expect_refused(square, "a square of cloth");

    const TriangleMesh tube = polygonise(
        [](const Vec3& p) { return Vec3(p.x(), 0.2 * (p.y() - 1.1), p.z() - 0.2).norm() - 0.045; }, low, high, 0.02);
    TriangleMesh sock = tube;
    std::vector<Eigen::Index> rows;
    for (Eigen::Index f = 0; f < tube.triangles.rows(); ++f)
        if (tube.positions(tube.triangles(f, 0), 1) < 1.3)
            rows.push_back(f);
    sock.triangles = tube.triangles(rows, Eigen::all);
    expect_refused(sock, "a sock");

    TriangleMesh ten { Positions(30, 3), Triangles(10, 3) }, buttons { Positions(3000, 3), Triangles(1000, 3) };
    for (int i = 0; i < 30; ++i)
        ten.positions.row(i) << std::sin(7.0 * i), 1 + std::sin(11.0 * i), std::sin(13.0 * i);
    for (int i = 0; i < 3000; ++i)
        buttons.positions.row(i) << std::sin(7.0 * (i / 3)) + 0.01 * (i % 3),
            1 + std::sin(11.0 * (i / 3)) + 0.01 * (i % 2), std::sin(13.0 * (i / 3));
    for (TriangleMesh* scraps : { &ten, &buttons })
        for (Eigen::Index f = 0; f < scraps->triangles.rows(); ++f)
            scraps->triangles.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
    expect_refused(ten, "ten triangles");
    expect_refused(buttons, "a thousand loose buttons", " loose pieces, the largest");
}

CommonFit fit_together(const Rig& rig, const std::vector<GarmentMesh>& garments)
{
    std::vector<FitResult> fits;
    for (const GarmentMesh& garment : garments)
        fits.push_back(fit_skeleton(rig, garment));
    return fit_common_pose(rig, garments, fits);
}

void expect_same_rotations(const Pose& a, const Pose& b)
{
    for (int j = 0; j < bone_count; ++j)
        EXPECT_EQ(a.rotations[j].coeffs(), b.rotations[j].coeffs()) << bone_name(j);
}

TEST(CommonFit, OnePoseFitsAShirtAndTrousers)
{
    const PersonOptions made_on { .arm_angle = 40 };
    const Rig rig = rig_of({ .arm_angle = 75, .knee_angle = 70, .hip_angle = 70 });
    const std::vector<GarmentMesh> garments { shirt(made_on, 1.9), trousers(made_on) };
    const CommonFit common = fit_together(rig, garments);
    ASSERT_TRUE(common.one_pose);
    EXPECT_TRUE(common.conflicts.empty());
    expect_same_rotations(common.fits[0].pose, common.fits[1].pose);
    for (std::size_t i = 0; i < garments.size(); ++i) {
        const Skeleton joints = pose_skeleton(rig.skeleton, common.fits[i].pose);
        expect_directions(joints, person_skeleton(made_on),
                          { lhumerus, lradius, rhumerus, rradius, lfemur, ltibia, rfemur, rtibia }, 15);
        expect_clear(joints, garments[i]);
    }
}

TEST(CommonFit, AGarmentThatLiesElsewhereIsOnlyMoved)
{
    const PersonOptions made_on { .arm_angle = 40 };
    const Rig rig = rig_of({ .arm_angle = 75 });
    std::vector<GarmentMesh> garments { shirt(made_on, 1.9), trousers(made_on) };
    garments[1].positions.rowwise() += Vec3(2, 0.5, -1).transpose();
    const CommonFit common = fit_together(rig, garments);
    ASSERT_TRUE(common.one_pose);
    expect_same_rotations(common.fits[0].pose, common.fits[1].pose);
    const Vec3 apart = common.fits[1].pose.root_translation - common.fits[0].pose.root_translation;
    EXPECT_LT((apart - Vec3(2, 0.5, -1)).norm(), 0.15);
    for (std::size_t i = 0; i < garments.size(); ++i)
        expect_clear(pose_skeleton(rig.skeleton, common.fits[i].pose), garments[i]);
}

TEST(CommonFit, ConflictingSleevesAreReportedAndEachGarmentKeepsItsFit)
{
    const Rig rig = rig_of({ .arm_angle = 45 });
    const std::vector<GarmentMesh> garments { shirt({ .arm_angle = 5 }, 1.9), trousers(),
                                              shirt({ .arm_angle = 65 }, 1.9) };
    const CommonFit common = fit_together(rig, garments);
    EXPECT_FALSE(common.one_pose);
    ASSERT_FALSE(common.conflicts.empty());
    const FitConflict& widest = common.conflicts.front();
    EXPECT_TRUE(is_arm(widest.bone)) << bone_name(widest.bone);
    EXPECT_EQ(widest.garments[0] + widest.garments[1], 0 + 2) << "the conflict is between the shirts";
    EXPECT_NEAR(widest.angle / k_degree, 60, 15);
    for (std::size_t i = 0; i < garments.size(); ++i)
        expect_same_rotations(common.fits[i].pose, fit_skeleton(rig, garments[i]).pose);
}

TEST(CommonFit, AGivenFrontHoldsAmongOthers)
{
    const Rig rig = rig_of({ .arm_angle = 70 });
    GarmentMesh oval = skirt(0.15, 0.2, 0.2, 0.5);
    oval.positions.col(2) *= 0.7;  // the cloth would turn the body by a right angle
    for (const Vec3& front : { Vec3(1, 0, 0), Vec3(-1, 0, 0) }) {
        FitOptions options;
        options.type = GarmentType::skirt;
        options.front = front;
        const FitResult own = fit_skeleton(rig, oval, options);
        const CommonFit common = fit_common_pose(rig, { oval, oval }, { own, own });
        for (const FitResult& fit : common.fits)
            EXPECT_GT((fit.pose.root_rotation * rig.front).dot(front), 0.8) << front.transpose();
    }
}

TEST(CommonFit, OneGarmentKeepsItsFit)
{
    const Rig rig = rig_of({ .arm_angle = 45 });
    const std::vector<GarmentMesh> garments { trousers() };
    const FitResult single = fit_skeleton(rig, garments[0]);
    const CommonFit common = fit_common_pose(rig, garments, { single });
    EXPECT_TRUE(common.one_pose);
    expect_same_rotations(common.fits[0].pose, single.pose);
    EXPECT_EQ(common.fits[0].pose.root_translation, single.pose.root_translation);
    EXPECT_THROW(fit_common_pose(rig, garments, {}), InvalidInput);
}

TEST(FitSkeleton, StopsWhenCancelled)
{
    const Rig rig = rig_of({ .arm_angle = 70 });
    const GarmentMesh garment = shirt({ .arm_angle = 40 }, 0.6);
    int reports = 0;
    const Progress stop([&](double, std::string_view) { return ++reports < 3; });
    EXPECT_THROW(fit_skeleton(rig, garment, {}, stop), Cancelled);
    EXPECT_EQ(reports, 3);
}

}  // namespace
