// SPDX-License-Identifier: GPL-3.0-or-later
#include "preconditioned_cg.h"

#include <gtest/gtest.h>

#include <random>

#include "fixtures.h"
#include "surface_measures.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

MeshTopology topology_of(const GarmentMesh& mesh) { return { mesh.triangles, int(mesh.positions.rows()) }; }

GarmentMesh flat_sheet()
{
    const TriangleMesh mesh = sheet(6, 0.02, [](double, double) { return 0; });
    return { mesh.positions, mesh.triangles };
}

Positions shaken(Positions x, double by)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shake(-by, by);
    for (double& value : x.reshaped())
        value += shake(random);
    return x;
}

TEST(ClothEnergy, IsNothingAtRestAndNothingPullsThere)
{
    const GarmentMesh rest = flat_sheet();
    const ClothEnergy energy(rest, topology_of(rest), {}, {});
    EXPECT_NEAR(energy.elastic_energy(rest.positions), 0, 1e-15);
    EXPECT_LT(energy.elastic_forces(rest.positions).cwiseAbs().maxCoeff(), 1e-12);
}

void expect_forces_are_minus_the_gradient(const ClothEnergy& energy, Positions x)
{
    const Positions forces = energy.elastic_forces(x);
    constexpr double h = 1e-7;
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        for (int k = 0; k < 3; ++k) {
            const double here = x(v, k);
            x(v, k) = here + h;
            const double after = energy.elastic_energy(x);
            x(v, k) = here - h;
            const double before = energy.elastic_energy(x);
            x(v, k) = here;
            EXPECT_NEAR(forces(v, k), -(after - before) / (2 * h), 1e-5 * forces.cwiseAbs().maxCoeff())
                << v << ' ' << k;
        }
}

TEST(ClothEnergy, ForcesAreMinusItsGradient)
{
    const GarmentMesh rest = flat_sheet();
    ClothOptions cloth;
    cloth.bend_stiffness = 1e-2;  // large enough to matter beside stretch
    const ClothEnergy energy(rest, topology_of(rest), {}, cloth);
    expect_forces_are_minus_the_gradient(energy, shaken(rest.positions, 4e-3));
}

/// Warp along x + z / 2.
GarmentMesh with_warp(const GarmentMesh& mesh)
{
    const auto uv_at = [](const Vec3& at) { return Eigen::RowVector2d(at.z() - 0.5 * at.x(), at.x() + 0.5 * at.z()); };
    return make_garment(mesh.positions, mesh.triangles, uvs_of(mesh, uv_at));
}

TEST(ClothEnergy, ForcesOfWovenClothAreMinusItsGradient)
{
    const GarmentMesh rest = with_warp(flat_sheet());
    ASSERT_GT(rest.warps.rows(), 0);
    ClothOptions denim;
    denim.fabric = Fabric::denim;
    denim.bend_stiffness = 0;
    const ClothEnergy energy(rest, topology_of(rest), {}, denim);
    EXPECT_NEAR(energy.elastic_energy(rest.positions), 0, 1e-15);
    const Positions x = shaken(rest.positions, 4e-3);
    EXPECT_GT(energy.elastic_energy(x), 0);
    expect_forces_are_minus_the_gradient(energy, x);
}

TEST(ClothEnergy, TheQuadraticFormMinusTheLoadsIsTheForceOfWovenCloth)
{
    const GarmentMesh rest = with_warp(flat_sheet());
    ClothOptions denim;
    denim.fabric = Fabric::denim;
    ClothEnergy energy(rest, topology_of(rest), {}, denim);
    energy.set_time_step(0.02);
    const Positions x = shaken(rest.positions, 4e-3);
    Positions inertia = x;
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        inertia.row(v) *= energy.masses()[v] * energy.inertia();
    const Positions forces
        = energy.spring_loads(x) + energy.frame_loads(x) - (energy.apply_quadratic_form(x) - inertia);
    EXPECT_LT((forces - energy.elastic_forces(x)).cwiseAbs().maxCoeff(), 1e-9);
}

/// The derivative of the energy along a direction, J/m, by central differences.
double slope(const ClothEnergy& energy, const Positions& x, const Positions& way)
{
    constexpr double h = 1e-7;
    return (energy.elastic_energy(x + h * way) - energy.elastic_energy(x - h * way)) / (2 * h);
}

GarmentMesh crumpled_sheet()
{
    const TriangleMesh mesh
        = sheet(6, 0.02, [](double x, double z) { return 0.02 * std::sin(60 * x) + 0.015 * std::cos(45 * z); });
    return { mesh.positions, mesh.triangles };
}

// The forces neglect that the axes of a hinge turn. Turning changes the energy by the work of the difference between
// the hinge's curvature and that at rest. A fold of its own shape, enlarged and turned, differs along the fold only,
// where turning changes nothing. So there the forces are the whole gradient.
TEST(ClothEnergy, ForcesAreMinusItsGradientWhereFoldsHaveTheirShape)
{
    const GarmentMesh rest = crumpled_sheet();
    ClothOptions cloth;
    cloth.bend_stiffness = 1e-2;
    const ClothEnergy energy(rest, topology_of(rest), {}, cloth);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Positions x = 1.15 * rest.positions * turn.transpose(), forces = energy.elastic_forces(x);
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        for (int k = 0; k < 3; ++k) {
            Positions way = Positions::Zero(x.rows(), 3);
            way(v, k) = 1;
            EXPECT_NEAR(forces(v, k), -slope(energy, x, way), 1e-5 * forces.cwiseAbs().maxCoeff()) << v << ' ' << k;
        }
}

// For a fold of another shape the forces are the gradient along all directions in which the axes stay: of the corners
// in the planes of their triangles, and of the edge along itself.
TEST(ClothEnergy, ForcesOfAnOpenedFoldAreMinusItsGradientWhileItsAxesHold)
{
    GarmentMesh rest { Positions(4, 3), (Triangles(2, 3) << 0, 1, 2, 1, 0, 3).finished() };
    rest.positions << 0, 0, 0, 0.02, 0, 0, 0.01, 0.008, 0.016, 0.008, 0.01, -0.015;
    ClothOptions cloth;
    cloth.bend_stiffness = 1e-2;
    const ClothEnergy energy(rest, topology_of(rest), {}, cloth);
    Positions x = rest.positions;
    x.row(2) << 0.012, 0.002, 0.019;
    x.row(3) << 0.009, 0.004, -0.017;
    const Positions forces = energy.elastic_forces(x);
    const auto beside = [&](int v, const Eigen::RowVector3d& direction) {
        Positions way = Positions::Zero(4, 3);
        way.row(v) = direction.normalized();
        return forces.row(v).dot(way.row(v)) + slope(energy, x, way);
    };
    const double close = 1e-5 * forces.cwiseAbs().maxCoeff();
    const Eigen::RowVector3d edge = x.row(1) - x.row(0);
    for (const int corner : { 2, 3 }) {
        const Eigen::RowVector3d up = x.row(corner) - x.row(0);
        EXPECT_NEAR(beside(corner, edge), 0, close);
        EXPECT_NEAR(beside(corner, up), 0, close);
        EXPECT_GT(std::abs(beside(corner, edge.cross(up))), 100 * close)
            << "the axes turn: not held, this shows nothing";
    }
    for (const int end : { 0, 1 })
        EXPECT_NEAR(beside(end, edge), 0, close);
}

TEST(ClothEnergy, OfSeveralGarmentsIsThatOfEachInItsOwnFabric)
{
    const TriangleMesh sheet = flat(6, 0.02, Vec3::Zero()), both = joined(sheet, flat(6, 0.02, Vec3(1, 0, 0)));
    const int n = int(sheet.positions.rows());
    std::vector<int> garments(2 * n, 1);
    std::fill_n(garments.begin(), n, 0);
    const auto energy_in = [](const TriangleMesh& mesh, const Materials& materials) {
        const GarmentMesh rest { mesh.positions, mesh.triangles };
        const ClothEnergy energy(rest, topology_of(rest), {}, materials);
        return std::pair { energy.elastic_energy(1.05 * rest.positions), energy.masses().back() };
    };
    ClothOptions denim;
    denim.fabric = Fabric::denim;
    const auto [first, light] = energy_in(sheet, Materials(ClothOptions()));
    const auto [second, heavy] = energy_in(sheet, Materials(denim));
    const auto [whole, last] = energy_in(both, { {}, { Fabric::cotton, Fabric::denim }, garments });
    EXPECT_NEAR(whole, first + second, 1e-9 * whole);
    EXPECT_NEAR(last, heavy, 1e-12);
    EXPECT_GT(heavy, light);
}

TEST(ClothEnergy, StiffensWhereAnEdgeIsOverstretched)
{
    constexpr double k_edge = 0.02, k_time_step = 0.02;
    const GarmentMesh rest { (Positions(3, 3) << 0, 0, 0, k_edge, 0, 0, k_edge / 2, 0, k_edge).finished(),
                             (Triangles(1, 3) << 0, 1, 2).finished() };
    ClothEnergy energy(rest, topology_of(rest), {}, {});
    energy.set_time_step(k_time_step);
    const auto stretch_when_drawn_by = [&](double force) {
        Positions inertial = rest.positions;
        for (int end : { 0, 1 })
            inertial(end, 0) += (end == 0 ? -1 : 1) * force * k_time_step * k_time_step / energy.masses()[end];
        PreconditionedCG solver(energy, rest.positions, inertial);
        for (int i = 0; i < 300; ++i) {
            if (i % 3 == 0)
                solver.set_constraints({});
            solver.iterate();
        }
        return (solver.positions().row(1) - solver.positions().row(0)).norm() / k_edge - 1;
    };
    double force = 0.01;
    while (stretch_when_drawn_by(force) < 0.3)
        force *= 1.1;
    const double four_times = stretch_when_drawn_by(4 * force);
    EXPECT_GT(four_times, 0.4);
    EXPECT_LT(four_times, 0.7) << "it would be 1.2 were it not to stiffen";
}

TEST(ClothEnergy, DoesNotChangeWhenTheClothIsMovedAsAWhole)
{
    GarmentMesh rest = flat_sheet();
    rest.positions.col(1) = 0.05 * (20 * rest.positions.col(0)).array().sin();  // with folds of its own
    const ClothEnergy energy(rest, topology_of(rest), {}, {});
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(3, 1, 2).normalized()).toRotationMatrix();
    EXPECT_NEAR(energy.elastic_energy((rest.positions * turn.transpose()).rowwise() + Eigen::RowVector3d(1, 2, 3)), 0,
                1e-15);
    const Positions x = shaken(rest.positions, 2e-3);
    EXPECT_NEAR(energy.elastic_energy(x * turn.transpose()) / energy.elastic_energy(x), 1, 1e-9);
}

TEST(ClothEnergy, OfATieGrowsAlikeInAllDirections)
{
    const TriangleMesh button = sheet(2, 0.01, [](double, double) { return 0.004; });
    const GarmentMesh cloth = flat_sheet();
    const TriangleMesh both = joined({ cloth.positions, cloth.triangles }, button);
    const GarmentMesh rest { both.positions, both.triangles };
    std::vector<Tie> ties;
    for (int v = 36; v < 40; ++v)
        ties.push_back({ v, { 0, 6, 1 }, { 0.2, 0.5, 0.3 } });
    const ClothEnergy energy(rest, topology_of(rest), {}, {}, ties), loose(rest, topology_of(rest), {}, {});
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (const Vec3& way : { Vec3(1e-3, 0, 0), Vec3(0, 1e-3, 0), Vec3(0, 0, 1e-3) }) {
        Positions x = rest.positions;
        x.bottomRows(4).rowwise() += way.transpose();
        x *= turn.transpose();
        EXPECT_NEAR(loose.elastic_energy(x), 0, 1e-15) << "the pieces moved as wholes";
        EXPECT_NEAR(energy.elastic_energy(x), 0.5 * 400 * 1e-6, 1e-9) << "of 1 cm^2, by vertices with 1/6 to 1/3 of it";
        EXPECT_LT((energy.elastic_forces(x).bottomRows(4).colwise().sum().transpose() + 400 * turn * way).norm(), 1e-9);
        EXPECT_LT(energy.elastic_forces(x).colwise().sum().norm(), 1e-12);
    }
}

TEST(ClothEnergy, FreeFallIsThatOfImplicitEuler)
{
    const GarmentMesh rest = flat_sheet();
    ClothEnergy energy(rest, topology_of(rest), {}, {});
    constexpr double h = 0.01, g = 9.81;
    energy.set_time_step(h);
    Positions x = rest.positions, velocity = Positions::Zero(x.rows(), 3);
    constexpr int steps = 20;
    for (int i = 0; i < steps; ++i) {
        Positions inertial = x + h * velocity;
        inertial.col(1).array() -= g * h * h;
        PreconditionedCG solver(energy, x, inertial);
        for (int k = 0; k < 4; ++k)
            solver.iterate();
        velocity = (solver.positions() - x) / h;
        x = solver.positions();
    }
    const double fallen = g * h * h * steps * (steps + 1) / 2;
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        EXPECT_NEAR(rest.positions(v, 1) - x(v, 1), fallen, 1e-3 * fallen);
}

// What is minimised: energy of inertia, springs, hinges and constraints, J.
double total_energy(const ClothEnergy& energy, const Positions& x, const Positions& inertial, double h,
                    const std::vector<SoftConstraint>& constraints)
{
    double sum = energy.elastic_energy(x);
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        sum += 0.5 * energy.masses()[v] / (h * h) * (x.row(v) - inertial.row(v)).squaredNorm();
    for (const SoftConstraint& constraint : constraints) {
        const Vec3 off = Vec3(x.row(constraint.vertices[0])) - constraint.target;
        sum += 0.5 * off.dot(constraint.stiffness_times(off));
    }
    return sum;
}

TEST(ClothEnergy, TheSolverNeverRaisesItAndSoonComesNearTheMinimum)
{
    const GarmentMesh rest = flat_sheet();
    ClothEnergy energy(rest, topology_of(rest), {}, {});
    constexpr double h = 0.02;
    energy.set_time_step(h);
    const Positions start = 1.1 * rest.positions, inertial = rest.positions;
    std::vector<SoftConstraint> constraints;
    for (int v : { 0, 3, 7 })
        constraints.push_back({ { v, -1, -1, -1 },
                                { 1, 0, 0, 0 },
                                Vec3(rest.positions.row(v)) + Vec3(0, 0.01, 0),
                                Vec3::UnitY(),
                                500,
                                100 });
    PreconditionedCG solver(energy, start, inertial);
    solver.set_constraints(constraints);
    const auto energy_now = [&] { return total_energy(energy, solver.positions(), inertial, h, constraints); };
    std::vector<double> energies { energy_now() };
    for (int i = 0; i < 1000; ++i) {
        if (i % 3 == 0)
            solver.set_constraints(constraints);
        solver.iterate();
        energies.push_back(energy_now());
        ASSERT_LE(energies.back(), energies[i] * (1 + 1e-9)) << "step " << i;
    }
    EXPECT_LT(energies[20] - energies.back(), 0.01 * (energies.front() - energies.back()));
}

/// How far the lower hem of a square sheet of half a metre sinks when it hangs by its upper hem, m.
double sag_of_hanging_sheet(int n, const ClothOptions& cloth)
{
    const TriangleMesh mesh = sheet(n, 0.5 / (n - 1), [](double, double) { return 0; });
    const GarmentMesh rest { mesh.positions, mesh.triangles };
    ClothEnergy energy(rest, topology_of(rest), {}, cloth);
    constexpr double h = 0.2, pin = 4e3;  // s, N/m: close enough to the cloth's own for the solver to converge fast
    energy.set_time_step(h);
    std::vector<SoftConstraint> pins;
    for (int v = 0; v < n; ++v)
        pins.push_back({ { v, -1, -1, -1 }, { 1, 0, 0, 0 }, rest.positions.row(v), Vec3::UnitY(), pin, pin });
    Positions x = rest.positions;
    for (int i = 0; i < 3000; ++i) {
        Positions inertial = x;
        inertial.col(2).array() += 9.81 * h * h;
        PreconditionedCG solver(energy, x, inertial);
        solver.set_constraints(pins);
        for (int k = 0; k < 3; ++k)
            solver.iterate();
        x = solver.positions();
    }
    const Eigen::VectorXd sunk = (x - rest.positions).col(2);
    return sunk.tail(n).mean() - sunk.head(n).mean();
}

/// An even sheet of equilateral triangles, a row of corners above the other, in the plane z = 0.
GarmentMesh even_sheet(int across, int up)
{
    Positions positions(across * up, 3);
    Triangles triangles(2 * (across - 1) * (up - 1), 3);
    for (int j = 0; j < up; ++j)
        for (int i = 0; i < across; ++i)
            positions.row(j * across + i) << 0.02 * (i + 0.5 * j), 0.02 * std::sqrt(0.75) * j, 0;
    Eigen::Index f = 0;
    for (int j = 0; j + 1 < up; ++j)
        for (int i = 0; i + 1 < across; ++i) {
            const int a = j * across + i, b = a + 1, c = a + across, d = c + 1;
            triangles.row(f++) << a, b, c;
            triangles.row(f++) << b, d, c;
        }
    return { positions, triangles };
}

// A triangular lattice of springs is an isotropic sheet with Poisson's ratio 1/3. Stretched in one direction and held
// in the other, its modulus is 9/8 of Young's modulus; sheared, 3/8.
TEST(ClothEnergy, StretchesAndShearsAsAnIsotropicSheet)
{
    const ClothOptions cloth;
    const GarmentMesh rest = even_sheet(9, 7);
    const ClothEnergy energy(rest, topology_of(rest), {}, cloth);
    const auto modulus = [&](const Eigen::Matrix2d& strain) {
        Positions x = rest.positions;
        x.leftCols(2) += x.leftCols(2) * strain.transpose();
        return 2 * energy.elastic_energy(x) / (area({ rest.positions, rest.triangles }) * 1e-6)
            / material_of(cloth).stretch_stiffness;
    };
    Eigen::Matrix2d along, across, shear, turned_shear;
    along << 1e-3, 0, 0, 0;
    across << 0, 0, 0, 1e-3;
    shear << 0, 1e-3, 0, 0;
    turned_shear << 5e-4, 0, 0, -5e-4;
    EXPECT_NEAR(modulus(along), 9. / 8, 0.01);
    EXPECT_NEAR(modulus(across), 9. / 8, 0.01);
    EXPECT_NEAR(modulus(shear), 3. / 8, 0.01);
    EXPECT_NEAR(modulus(turned_shear), 3. / 8, 0.01);
}

// Tension at a distance s from the lower hem is density g s, so the hem sinks by density g L^2 / 2k. The springs of a
// grid resist between 1 and 1.2 times as much as their k, as shear and narrowing go along or not.
TEST(ClothEnergy, AHangingSheetGivesAsMuchAsItsStiffnessSays)
{
    const ClothOptions cloth;
    const Material material = material_of(cloth);
    const double expected = material.density * 9.81 * 0.5 * 0.5 / (2 * material.stretch_stiffness);
    const double coarse = sag_of_hanging_sheet(6, cloth), fine = sag_of_hanging_sheet(11, cloth);
    EXPECT_GT(fine, expected / 1.25);
    EXPECT_LT(fine, expected * 1.02);
    EXPECT_NEAR(coarse / fine, 1, 0.05);
}

}  // namespace
