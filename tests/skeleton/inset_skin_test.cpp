// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/inset_skin.h"

#include <gtest/gtest.h>

#include "fixtures.h"
#include "surface_measures.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

bool is_shirt(const Vec3& p) { return p.y() > 0.6 && p.y() < 1.5; }

struct InsetPerson {
    Person person = capsule_person();
    Eigen::VectorXd depths;  // m, of each vertex along its normal

    explicit InsetPerson(double ease)
    {
        const TriangleMesh shirt = garment_round(person.skeleton, ease, is_shirt);
        const Positions motion = inset_skin(person.mesh, { shirt }) - person.mesh.positions;
        const Positions normals = vertex_normals(person.mesh.positions, person.mesh.triangles);
        depths = -(motion.array() * normals.array()).rowwise().sum();
    }
    Vec3 place(Eigen::Index v) const { return person.mesh.positions.row(v); }
};

TEST(InsetSkin, GoesInUnderClothAndStaysWhereItIsBare)
{
    const InsetPerson inset(0.02);
    const double most = 0.031 * diagonal(inset.person.mesh.positions);
    int belly = 0;
    for (Eigen::Index v = 0; v < inset.depths.size(); ++v) {
        EXPECT_LE(inset.depths[v], most);
        EXPECT_GE(inset.depths[v], 0);
        if (inset.place(v).y() < 0.55 || inset.place(v).y() > 1.55) {
            EXPECT_EQ(inset.depths[v], 0) << inset.place(v).transpose();
        }
        if (std::abs(inset.place(v).y() - 1.05) < 0.05 && std::abs(inset.place(v).x()) < 0.2) {
            ++belly;
            EXPECT_GT(inset.depths[v], 0.6 * most);
        }
    }
    EXPECT_GT(belly, 10);
}

TEST(InsetSkin, LeavesLimbsAThickness)
{
    // capsule_person has arms 9 cm thick
    const InsetPerson inset(0.02);
    int arms = 0;
    for (Eigen::Index v = 0; v < inset.depths.size(); ++v)
        if (std::abs(inset.place(v).x()) > 0.4) {
            EXPECT_LT(inset.depths[v], 0.45 * 0.1);
            ++arms;
        }
    EXPECT_GT(arms, 10);
}

TEST(InsetSkin, GoesInUnderATent)
{
    EXPECT_GT(InsetPerson(0.12).depths.maxCoeff(), 0.03) << "cloth that stands off hides skin, too";
}

TEST(InsetSkin, StaysWhereMostViewersSeeIt)
{
    const Person person = capsule_person();
    EXPECT_EQ(inset_skin(person.mesh, {}), person.mesh.positions);
    TriangleMesh board { Positions(3, 3), Triangles(1, 3) };  // before the belly
    board.positions << -0.5, 0.8, 0.4, 0.5, 0.8, 0.4, 0, 1.6, 0.4;
    board.triangles << 0, 1, 2;
    EXPECT_EQ(inset_skin(person.mesh, { board }), person.mesh.positions);
}

}  // namespace
