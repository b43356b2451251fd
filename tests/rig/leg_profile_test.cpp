// SPDX-License-Identifier: GPL-3.0-or-later
#include "leg_profile.h"

#include <string>

#include <gtest/gtest.h>

#include "garmentfit/io.h"
#include "garmentfit/mesh.h"
#include "garmentfit/rig_body.h"
#include "proxy_surface.h"

namespace {

using namespace garmentfit;

BodyMesh body_of(const std::string& name)
{
    const MeshFile file = MeshFile::read(GARMENTFIT_BODIES "/" + name + ".ply");
    return make_body(file.positions(), file.triangles());
}

BodyJoints joints_of(const BodyMesh& body)
{
    const TriangleMesh proxy = proxy_surface(body.closed, RigOptions().proxy_vertices);
    const CurveSkeleton curves = curve_skeleton(proxy, {});
    return label_joints(proxy, curves, body_graph(curves));
}

TEST(LegProfile, ShowsTheFrontOfBodiesThatStand)
{
    for (const char* name : { "child_a_pose", "heavy_man_arms_down", "man_a_pose", "woman_t_pose" })
        EXPECT_GT(joints_of(body_of(name)).legs_front.z(), 0.5) << name;
}

TEST(LegProfile, TurnsWithTheBody)
{
    BodyMesh body = body_of("woman_t_pose");
    body.closed.positions.col(0) *= -1;
    body.closed.positions.col(2) *= -1;
    EXPECT_LT(joints_of(body).legs_front.z(), -0.5);
}

TEST(LegProfile, BentLegsSayNothing) { EXPECT_LT(joints_of(body_of("old_woman_sitting")).legs_front.norm(), 0.1); }

TEST(LegProfile, CertaintyChangesItsSignWithTheBows)
{
    const std::array<LegBows, 2> none {}, forwards { { { 0.05, -0.05 }, { 0.05, -0.05 } } },
        backwards { { { -0.05, 0.05 }, { -0.05, 0.05 } } };
    EXPECT_EQ(certainty_of_front(none), 0);
    EXPECT_GT(certainty_of_front(forwards), 0.9);
    EXPECT_DOUBLE_EQ(certainty_of_front(backwards), -certainty_of_front(forwards));
}

/// Cut off below a share of the height and above another one, without the triangles that cross.
TriangleMesh middle_of(const TriangleMesh& mesh, double from, double to)
{
    const double low = mesh.positions.col(1).minCoeff(), high = mesh.positions.col(1).maxCoeff();
    TriangleMesh middle { mesh.positions, Triangles(mesh.triangles.rows(), 3) };
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        bool inside = true;
        for (const int v : mesh.triangles.row(f)) {
            const double share = (mesh.positions(v, 1) - low) / (high - low);
            inside = inside && share > from && share < to;
        }
        if (inside)
            middle.triangles.row(kept++) = mesh.triangles.row(f);
    }
    middle.triangles.conservativeResize(kept, 3);
    return middle;
}

TEST(LegProfile, TellsTheSidesOfAWomanWithoutHeadAndFeet)
{
    const MeshFile file = MeshFile::read(GARMENTFIT_BODIES "/woman_t_pose.ply");
    TriangleMesh mannequin = middle_of({ file.positions(), file.triangles() }, 0.06, 0.86);
    for (const int sign : { 1, -1 }) {
        const Rig rig = rig_body(make_body(mannequin.positions, mannequin.triangles));
        EXPECT_GT(sign * rig.front.z(), 0.9);
        mannequin.positions.col(0) *= -1;
        mannequin.positions.col(2) *= -1;
    }
}

}  // namespace
