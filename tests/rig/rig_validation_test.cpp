// SPDX-License-Identifier: GPL-3.0-or-later
#include "rig_validation.h"

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/rig_body.h"

namespace {

using namespace garmentfit;
using fixtures::capsule_person;
using fixtures::expect_invalid;
using fixtures::Person;

TEST(RigValidation, APersonPasses)
{
    const Person person = capsule_person();
    EXPECT_NO_THROW(check_shape(person.mesh, Humanlike::strict));
    EXPECT_NO_THROW(check_rig(person.mesh, person.skeleton));
}

TEST(RigValidation, ASkeletonBesideItsBodyIsRefused)
{
    Person person = capsule_person();
    person.mesh.positions.col(2).array() += 1;
    expect_invalid([&] { check_rig(person.mesh, person.skeleton); }, "0.00 of the skeleton lies inside");
}

TEST(RigValidation, UnequalSidesAreRefusedWithBothLengths)
{
    Person person = capsule_person();
    Skeleton& s = person.skeleton;
    const Vec3 shift = 0.25 * (s.tail(rradius) - s.tail(rhumerus));
    s.tails[rradius] -= shift;
    expect_invalid([&] { check_rig(person.mesh, s); }, "rradius");
}

TEST(RigValidation, APersonWithShortLegsIsRefused)
{
    Person person = capsule_person();
    for (const int bone : { lfemur, ltibia, rfemur, rtibia })
        person.skeleton.tails[bone].y() = 0.93 + 0.4 * (person.skeleton.tails[bone].y() - 0.93);
    expect_invalid([&] { check_rig(person.mesh, person.skeleton); }, "arm to leg");
}

TEST(RigValidation, AFootBackwardsIsRefusedAndUnlikely)
{
    Person person = capsule_person();
    Skeleton& s = person.skeleton;
    EXPECT_NO_THROW(check_feet(s));
    EXPECT_EQ(human_likeness(person.mesh, s).squares, 0);
    const Vec3 foot = s.tips[lfoot_tip] - s.tail(ltibia);
    s.tips[lfoot_tip] -= 2 * Vec3(0, 0, foot.z());
    expect_invalid([&] { check_feet(s); }, "a foot points backwards");
    const HumanLikeness likeness = human_likeness(person.mesh, s);
    EXPECT_GT(likeness.squares, 1);
    EXPECT_NE(likeness.furthest.find("a foot"), std::string::npos) << likeness.furthest;
}

TEST(RigValidation, ABallIsRefused)
{
    const TriangleMesh ball = fixtures::polygonise([](const Vec3& p) { return p.norm() - 0.5; }, Vec3::Constant(-0.7),
                                                   Vec3::Constant(0.7), 0.1);
    expect_invalid([&] { check_shape(ball, Humanlike::any); }, "isoperimetric quotient");
}

TEST(RigValidation, ACompactFigureIsRefusedWhereItIsNotLikeAHuman)
{
    const auto out_of_box = [](const Vec3& p) { return (p.cwiseAbs() - Vec3(0.25, 0.75, 0.25)).maxCoeff(); };
    const TriangleMesh box
        = fixtures::polygonise(out_of_box, Vec3(-0.4, -0.9, -0.4), Vec3(0.4, 0.9, 0.4), 0.06);  // quotient 0.37
    expect_invalid([&] { check_shape(box, Humanlike::strict); }, "isoperimetric quotient");
    EXPECT_NO_THROW(check_shape(box, Humanlike::any));
    Rig rig;
    rig.human_probability = 1e-5;
    EXPECT_NO_THROW(check_figure(box, rig));
    rig.human_probability = 1e-9;
    expect_invalid([&] { check_figure(box, rig); }, "isoperimetric quotient");
    EXPECT_NO_THROW(check_figure(capsule_person().mesh, rig)) << "only where it is compact";
}

// A skeleton by another program

BodyMesh body_of(const Person& person) { return make_body(person.mesh.positions, person.mesh.triangles); }

TEST(RigValidation, ASkeletonMayHaveACartoonsProportions)
{
    const Person person = capsule_person();
    EXPECT_NO_THROW(check_skeleton(body_of(person), person.skeleton));
    Person chibi = person;
    const auto shorten = [](double y) { return y > 0.93 ? y : 0.93 + 0.4 * (y - 0.93); };
    for (Eigen::Index v = 0; v < chibi.mesh.positions.rows(); ++v)
        if (std::abs(chibi.mesh.positions(v, 0)) < 0.25)
            chibi.mesh.positions(v, 1) = shorten(chibi.mesh.positions(v, 1));
    for (const int bone : { lfemur, ltibia, rfemur, rtibia })
        chibi.skeleton.tails[bone].y() = shorten(chibi.skeleton.tails[bone].y());
    EXPECT_NO_THROW(check_skeleton(body_of(chibi), chibi.skeleton));
}

TEST(RigValidation, AJointThatIsNotReadButPlacedMayLieFartherOutsideOfTheBody)
{
    const Person person = capsule_person();
    const BodyMesh body = body_of(person);
    const double height = body.surface.positions.col(1).maxCoeff() - body.surface.positions.col(1).minCoeff();
    double behind = 0;  // of the back, at the height of that joint
    for (const auto& skin : body.surface.positions.rowwise())
        if (std::abs(skin.y() - person.skeleton.tail(lowerback).y()) < 0.05 && std::abs(skin.x()) < 0.05)
            behind = std::min(behind, skin.z());
    Person bent = person;
    bent.skeleton.tails[lowerback].z() = behind - 0.07 * height;
    EXPECT_NO_THROW(check_skeleton(body, bent.skeleton));
    bent.skeleton.tails[lowerback].z() = behind - 0.2 * height;
    expect_invalid([&] { check_skeleton(body, bent.skeleton); }, "the end of lowerback");
    Person beside = person;
    beside.skeleton.tails[thorax].z() = behind - 0.07 * height;
    expect_invalid([&] { check_skeleton(body, beside.skeleton); }, "the end of thorax");
}

TEST(RigValidation, ASkeletonOfAnotherBodyIsRefused)
{
    const Person person = capsule_person();
    const BodyMesh body = body_of(person);
    Person aside = person;
    aside.skeleton.root.z() += 0.6;
    for (Vec3& tail : aside.skeleton.tails)
        tail.z() += 0.6;
    for (Vec3& tip : aside.skeleton.tips)
        tip.z() += 0.6;
    expect_invalid([&] { check_skeleton(body, aside.skeleton); }, "outside of the body");
    Person crossed = person;
    std::swap(crossed.skeleton.tails[lhipjoint], crossed.skeleton.tails[rhipjoint]);
    std::swap(crossed.skeleton.tails[lfemur], crossed.skeleton.tails[rfemur]);
    std::swap(crossed.skeleton.tails[ltibia], crossed.skeleton.tails[rtibia]);
    expect_invalid([&] { check_skeleton(body, crossed.skeleton); }, "different sides");
    for (Person* one_shoulder : { &crossed, &aside }) {
        *one_shoulder = person;
        one_shoulder->skeleton.tails[lclavicle] = one_shoulder->skeleton.tails[rclavicle]
            = person.skeleton.tail(thorax);
    }
    EXPECT_NO_THROW(check_skeleton(body, aside.skeleton));
    std::swap(crossed.skeleton.tails[lhumerus], crossed.skeleton.tails[rhumerus]);
    std::swap(crossed.skeleton.tails[lradius], crossed.skeleton.tails[rradius]);
    expect_invalid([&] { check_skeleton(body, crossed.skeleton); }, "different sides");
    Person mirrored = person;
    for (const int left : { lhipjoint, lfemur, ltibia, lclavicle, lhumerus, lradius })
        std::swap(mirrored.skeleton.tails[left], mirrored.skeleton.tails[mirror_of(left)]);
    std::swap(mirrored.skeleton.tips[lfoot_tip], mirrored.skeleton.tips[rfoot_tip]);
    expect_invalid([&] { check_skeleton(body, mirrored.skeleton); }, "exchanged");
    Person heel = person;
    heel.skeleton.tips[lfoot_tip] -= 2 * Vec3(0, 0, (heel.skeleton.tips[lfoot_tip] - heel.skeleton.tail(ltibia)).z());
    expect_invalid([&] { check_skeleton(body, heel.skeleton); }, "a foot points backwards");
    Person early = person;  // upper arm to forearm 0.4, and all that follows is a hand
    for (const auto& [upper, lower] : { std::pair(lhumerus, lradius), { rhumerus, rradius } }) {
        const Vec3 shoulder = person.skeleton.head(upper), elbow = person.skeleton.tail(upper);
        early.skeleton.tails[upper] = shoulder + 0.25 * (elbow - shoulder);
        early.skeleton.tails[lower] = shoulder + 0.85 * (elbow - shoulder);
    }
    const SkinWeights of_early = fixtures::nearest_rig(early).weights,
                      of_person = fixtures::nearest_rig(person).weights;
    EXPECT_NO_THROW(check_skeleton(body, early.skeleton));
    expect_invalid([&] { check_skeleton(body, early.skeleton, of_early); }, "elbows");
    EXPECT_NO_THROW(check_skeleton(body, person.skeleton, of_person));
    Person in_chest = person;
    in_chest.skeleton.root = person.skeleton.tail(upperback);
    expect_invalid([&] { check_skeleton(body, in_chest.skeleton); }, "pelvis");
    Person folded = person;
    folded.skeleton.tails[lradius] = folded.skeleton.tails[lhumerus];
    expect_invalid([&] { check_skeleton(body, folded.skeleton); }, "hardly any length");
}

/// As in files without a joint for the toes: what goes on beyond the ankle says nothing of the front.
Person without_toes(Person person)
{
    Skeleton& s = person.skeleton;
    for (const auto& [shin, tip] : { std::pair(ltibia, lfoot_tip), { rtibia, rfoot_tip } })
        s.tips[tip] = s.tail(shin) + 0.5 * (s.tail(shin) - s.head(shin));
    return person;
}

TEST(RigValidation, SidesAreExchangedWhereTheSkinOfBothFeetLiesBehindTheShins)
{
    const Person person = without_toes(capsule_person());
    const BodyMesh body = body_of(person);
    EXPECT_NO_THROW(check_skeleton(body, person.skeleton, fixtures::nearest_rig(person).weights));
    Person exchanged = person;
    for (const int left : { lhipjoint, lfemur, ltibia, lclavicle, lhumerus, lradius })
        std::swap(exchanged.skeleton.tails[left], exchanged.skeleton.tails[mirror_of(left)]);
    exchanged = without_toes(exchanged);
    EXPECT_NO_THROW(check_skeleton(body, exchanged.skeleton)) << "without weights nothing tells";
    expect_invalid([&] { check_skeleton(body, exchanged.skeleton, fixtures::nearest_rig(exchanged).weights); },
                   "exchanged");
}

}  // namespace
