// SPDX-License-Identifier: GPL-3.0-or-later
#include "joints_by_tree.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace {

using namespace garmentfit;

/// What skeletons have beside the joints of a human.
struct Extras {
    bool fingers = false, twists = false, halves = false, leaves = false, floor_root = false, hips_apart = false,
         clavicles_on_neck = false, hair_and_skirt = false, tail = false, no_clavicles = false, face = false;
    double arm_angle = 45;  ///< degrees below the horizon
};

/// A human's joints with what each is meant to be.
class Builder {
public:
    explicit Builder(const Extras& extras) : extras_(extras) { build(); }

    UnnamedJoints joints;
    std::vector<std::string> meant;  ///< "left knee", or empty

private:
    int add(int parent, const Vec3& place, double mass, const Vec3& centre, const std::string& what = "")
    {
        joints.parents.push_back(parent);
        joints.places.push_back(place);
        joints.masses.push_back(mass);
        joints.centres.push_back(centre);
        meant.push_back(what);
        return int(meant.size()) - 1;
    }

    int add(int parent, const Vec3& place, double mass, const std::string& what = "")
    {
        return add(parent, place, mass, place, what);
    }

    /// Between two joints of a limb: a joint in the middle of the bone, a twist bone beside it.
    int bone(int joint, const Vec3& to)
    {
        const Vec3 middle = 0.5 * (joints.places[std::size_t(joint)] + to);
        if (extras_.twists)
            add(joint, middle, 50);
        return extras_.halves ? add(joint, middle, 50) : joint;
    }

    void add_leg(int hips, double side, const std::string& name)
    {
        const Vec3 hip(0.095 * side, 0.9, 0), knee(0.1 * side, 0.48, 0.01), ankle(0.1 * side, 0.08, -0.02),
            toe(0.11 * side, 0.02, 0.12);
        int at = hips;
        if (extras_.hips_apart)
            at = add(at, Vec3(0.02 * side, 0.93, 0), 20);
        at = bone(add(at, hip, 300, name + "hip"), knee);
        at = bone(add(at, knee, 250, name + "knee"), ankle);
        at = add(at, ankle, 120, ankle + Vec3(0, -0.05, 0.06), name + "ankle");
        at = add(at, toe, 60, toe + Vec3(0, 0, 0.03));
        if (extras_.leaves)
            add(at, toe + Vec3(0, 0, 0.06), 0);
    }

    void add_arm(int chest, double side, const std::string& name)
    {
        const double angle = extras_.arm_angle * EIGEN_PI / 180;
        const Vec3 along(side * std::cos(angle), -std::sin(angle), 0), shoulder(0.18 * side, 1.4, -0.01),
            elbow = shoulder + 0.28 * along, wrist = elbow + 0.26 * along;
        int at = chest;
        if (!extras_.no_clavicles)
            at = add(at, Vec3(0.03 * side, 1.42, 0), 80, name + "clavicle");
        at = bone(add(at, shoulder, 200, name + "shoulder"), elbow);
        at = bone(add(at, elbow, 180, name + "elbow"), wrist);
        at = add(at, wrist, 150, name + "wrist");
        for (int finger = 0; finger < (extras_.fingers ? 5 : 0); ++finger) {
            int tip = at;
            for (int joint = 0; joint < 3; ++joint)
                tip = add(tip, wrist + (0.07 + 0.03 * joint) * along + Vec3(0, 0, 0.02 * (finger - 2)), 40);
            if (extras_.leaves)
                add(tip, wrist + 0.16 * along + Vec3(0, 0, 0.02 * (finger - 2)), 0);
        }
    }

    void add_head(int neck)
    {
        const int head = add(neck, Vec3(0, 1.55, 0.01), 900, Vec3(0, 1.65, 0.02), "head");
        if (extras_.leaves)
            add(head, Vec3(0, 1.75, 0.01), 0);
        for (int i = 0; i < (extras_.face ? 20 : 0); ++i)
            add(head, Vec3(0.01 * (i - 10), 1.6, 0.1), 15);
        for (int i = 0; i < (extras_.hair_and_skirt ? 8 : 0); ++i) {
            int strand = head;
            for (int joint = 0; joint < 6; ++joint)
                strand = add(strand, Vec3(0.03 * (i - 3.5), 1.7 - 0.15 * joint, -0.1), 60);
        }
    }

    void build()
    {
        int root = -1;
        if (extras_.floor_root)
            root = add(-1, Vec3::Zero(), 0);
        const int hips = add(root, Vec3(0, 0.95, 0), 300, "pelvis");
        const int back = add(hips, Vec3(0, 1.08, -0.01), 150, "spine");
        const int chest = add(add(back, Vec3(0, 1.2, -0.01), 150, "spine"), Vec3(0, 1.32, -0.01), 200, "spine");
        const int neck = add(chest, Vec3(0, 1.46, 0), 120, "neck");
        add_head(neck);
        for (const double side : { 1.0, -1.0 }) {
            const std::string name = side > 0 ? "left " : "right ";
            add_arm(extras_.clavicles_on_neck ? neck : chest, side, name);
            add_leg(hips, side, name);
            for (int i = 0; i < (extras_.hair_and_skirt ? 3 : 0); ++i) {
                int hem = hips;
                for (int joint = 0; joint < 4; ++joint)
                    hem = add(hem, Vec3(side * (0.08 + 0.03 * joint), 0.9 - 0.12 * joint, 0.1 * (i - 1)), 70);
            }
        }
        int tail = hips;
        for (int joint = 0; joint < (extras_.tail ? 6 : 0); ++joint)
            tail = add(tail, Vec3(0, 0.9 - 0.1 * joint, -0.1 - 0.1 * joint), 60);
    }

    Extras extras_;
};

std::string text_of(const std::optional<NamedJoint>& joint)
{
    static const std::map<JointKind, std::string> kinds {
        { JointKind::pelvis, "pelvis" }, { JointKind::spine, "spine" },       { JointKind::neck, "neck" },
        { JointKind::head, "head" },     { JointKind::clavicle, "clavicle" }, { JointKind::shoulder, "shoulder" },
        { JointKind::elbow, "elbow" },   { JointKind::wrist, "wrist" },       { JointKind::hip, "hip" },
        { JointKind::knee, "knee" },     { JointKind::ankle, "ankle" }
    };
    if (!joint)
        return "";
    return (joint->side == 0 ? "" : joint->side == 1 ? "left " : "right ") + kinds.at(joint->kind);
}

void expect_found(const Builder& given, const std::string& what)
{
    const auto found = joints_by_tree(given.joints);
    ASSERT_EQ(found.size(), given.meant.size()) << what;
    for (std::size_t j = 0; j < found.size(); ++j)
        EXPECT_EQ(text_of(found[j]), given.meant[j]) << what << ", joint " << j;
}

std::vector<std::pair<std::string, Extras>> skeletons()
{
    return {
        { "plain", {} },
        { "without clavicles", { .no_clavicles = true } },
        { "fingers", { .fingers = true } },
        { "fingers and leaves", { .fingers = true, .leaves = true } },
        { "twist bones", { .fingers = true, .twists = true } },
        { "limbs in halves", { .fingers = true, .halves = true, .hips_apart = true } },
        { "root on the floor", { .floor_root = true } },
        { "clavicles on the neck", { .fingers = true, .clavicles_on_neck = true } },
        { "hair and skirt", { .fingers = true, .hair_and_skirt = true } },
        { "tail and face", { .tail = true, .face = true } },
        { "arms out", { .fingers = true, .leaves = true, .arm_angle = 0 } },
        { "arms out, without fingers", { .leaves = true, .arm_angle = 0 } },
        { "arms down",
          { .fingers = true, .twists = true, .leaves = true, .floor_root = true, .face = true, .arm_angle = 85 } }
    };
}

TEST(JointsByTree, FindsHumansWithAllThatSkeletonsHaveBeside)
{
    for (const auto& [what, extras] : skeletons())
        expect_found(Builder(extras), what);
}

TEST(JointsByTree, KnowsNoAxesAndNoUnits)
{
    const Eigen::Matrix3d turn = (Eigen::AngleAxisd(2.1, Vec3(1, 2, -0.5).normalized())).toRotationMatrix();
    for (const auto& [what, extras] : skeletons()) {
        Builder turned(extras);
        for (std::vector<Vec3>* places : { &turned.joints.places, &turned.joints.centres })
            for (Vec3& place : *places)
                place = 100 * turn * place + Vec3(1e3, 5, -70);
        expect_found(turned, what + ", turned");
    }
}

TEST(JointsByTree, TellsArmsThatBeginAtOnePlaceByTheirElbows)
{
    for (const bool is_turned : { false, true }) {
        Builder given({ .no_clavicles = true });
        for (std::size_t j = 0; j < given.meant.size(); ++j)
            if (given.meant[j] == "left shoulder" || given.meant[j] == "right shoulder")
                given.joints.places[j].x() = 0;
        if (is_turned)
            for (std::vector<Vec3>* places : { &given.joints.places, &given.joints.centres })
                for (Vec3& place : *places)
                    place = Vec3(-place.x(), place.y(), -place.z());
        expect_found(given, is_turned ? "facing back" : "facing front");
    }
}

TEST(JointsByTree, TellsElbowsFromWristsWhereClaviclesBeginAtOnePlaceFarAboveTheJointBefore)
{
    Builder given({});
    for (std::size_t j = 0; j < given.meant.size(); ++j) {
        const std::string& what = given.meant[j];
        Vec3& place = given.joints.places[j];
        if (what == "left clavicle" || what == "right clavicle")
            place.x() = 0;
        else if (what == "left shoulder" || what == "left elbow" || what == "left wrist")
            place.x() += 0.1;
        else if (what == "right shoulder" || what == "right elbow" || what == "right wrist")
            place.x() -= 0.1;
        else if (what == "spine")
            place.y() = 0.95 + 0.3 * (place.y() - 0.95);
    }
    expect_found(given, "clavicles as long as upper arms");
}

TEST(JointsByTree, DoesNotMindTheOrderOfJoints)
{
    std::mt19937 random(3);
    for (const auto& [what, extras] : skeletons()) {
        const Builder given(extras);
        Builder shuffled(given);
        std::vector<int> row_of(given.meant.size());
        std::iota(row_of.begin(), row_of.end(), 0);
        std::shuffle(row_of.begin(), row_of.end(), random);
        for (std::size_t j = 0; j < row_of.size(); ++j) {
            const auto to = std::size_t(row_of[j]);
            const int parent = given.joints.parents[j];
            shuffled.joints.parents[to] = parent < 0 ? -1 : row_of[std::size_t(parent)];
            shuffled.joints.places[to] = given.joints.places[j];
            shuffled.joints.masses[to] = given.joints.masses[j];
            shuffled.joints.centres[to] = given.joints.centres[j];
            shuffled.meant[to] = given.meant[j];
        }
        expect_found(shuffled, what + ", shuffled");
    }
}

TEST(JointsByTree, FindsNothingInWhatIsNoHuman)
{
    EXPECT_TRUE(joints_by_tree({}).empty());
    UnnamedJoints chain, star;
    for (int j = 0; j < 20; ++j) {
        const Vec3 place(0, j, 0);
        chain.parents.push_back(j - 1);
        star.parents.push_back(j == 0 ? -1 : 0);
        for (UnnamedJoints* joints : { &chain, &star }) {
            joints->places.push_back(place);
            joints->masses.push_back(1);
            joints->centres.push_back(place);
        }
    }
    EXPECT_TRUE(joints_by_tree(chain).empty());
    EXPECT_TRUE(joints_by_tree(star).empty());

    Builder without_feet({});  // nothing tells front from back
    for (std::size_t j = 0; j < without_feet.meant.size(); ++j)
        without_feet.joints.places[j].z() = without_feet.joints.centres[j].z() = 0;
    EXPECT_TRUE(joints_by_tree(without_feet.joints).empty());
}

}  // namespace
