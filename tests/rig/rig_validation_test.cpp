// SPDX-License-Identifier: GPL-3.0-or-later
#include "rig_validation.h"

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;
using fixtures::capsule_person;
using fixtures::expect_invalid;
using fixtures::Person;

TEST(RigValidation, APersonPasses)
{
    const Person person = capsule_person();
    EXPECT_NO_THROW(check_shape(person.mesh));
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

TEST(RigValidation, ABallIsRefused)
{
    const TriangleMesh ball = fixtures::polygonise([](const Vec3& p) { return p.norm() - 0.5; }, Vec3::Constant(-0.7),
                                                   Vec3::Constant(0.7), 0.1);
    expect_invalid([&] { check_shape(ball); }, "isoperimetric quotient");
}

}  // namespace
