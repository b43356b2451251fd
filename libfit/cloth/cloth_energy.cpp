// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloth_energy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "garmentfit/error.h"
#include "parallel.h"
#include "surface_measures.h"

namespace garmentfit {
namespace {

// Slivers have cotangents without bound; past this they only say "this angle is small".
constexpr double k_largest_cotangent = 10;
// Vertices without area get the mass of a square millimetre of cotton, so that the system stays definite.
constexpr double k_least_mass = 2e-7;

// Hinges smaller than this share of the mean one bend as it does. Their stiffness goes with 1 / area: on details of a millimetre, they would hold
// their vertices in whatever place they had turned to, against the springs.
constexpr double k_least_hinge = 0.5;

// Threads lock: what an edge is stretched by more than this share pulls so many times as hard. Ten times holds fast what lies in a
// trouser leg or a cuff.
constexpr double k_locked = 0.4, k_locked_stiffness = 5;

// Vertices, springs or hinges that are worth handing to another thread.
constexpr Eigen::Index k_grain = 512;

double cotangent(const Vec3& apex, const Vec3& a, const Vec3& b)
{
    const Vec3 u = a - apex, v = b - apex;
    const double sine = u.cross(v).norm(), cosine = u.dot(v);
    if (sine <= std::abs(cosine) / k_largest_cotangent)
        return cosine < 0 ? -k_largest_cotangent : k_largest_cotangent;
    return cosine / sine;
}

// Axes of a hinge as columns: its edge, the mean of its two normals, and what is across both.
template <class P>
Eigen::Matrix3d hinge_frame(const P& x, const std::array<int, 4>& v)
{
    const Vec3 a = x.row(v[0]), b = x.row(v[1]), c = x.row(v[2]), d = x.row(v[3]);
    const Vec3 edge = (b - a).normalized();
    Vec3 normal = (b - a).cross(c - a).normalized() + (d - a).cross(b - a).normalized();
    normal = (normal - normal.dot(edge) * edge).normalized();
    Eigen::Matrix3d frame;
    frame << edge, normal, edge.cross(normal);
    return frame;
}

template <class P>
Vec3 weighted_sum(const P& x, const std::array<int, 4>& v, const std::array<double, 4>& w)
{
    return (w[0] * x.row(v[0]) + w[1] * x.row(v[1]) + w[2] * x.row(v[2]) + w[3] * x.row(v[3])).transpose();
}

void pull(const Press& press, const Vec3& force, Positions& forces)
{
    for (int k = 0; k < 4; ++k)
        if (press.vertices[k] >= 0)
            forces.row(press.vertices[k]) += press.weights[k] * force;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> sparse(Eigen::Index rows, Eigen::Index columns,
                                                    const std::vector<Eigen::Triplet<double>>& entries)
{
    Eigen::SparseMatrix<double, Eigen::RowMajor> result(rows, columns);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

}  // namespace

ClothEnergy::ClothEnergy(const GarmentMesh& rest, const std::vector<std::pair<int, int>>& ties,
                         const ClothOptions& options) :
    masses_(rest.positions.rows(), k_least_mass)
{
    const Material material = material_of(options);
    std::map<std::pair<int, int>, double> area_at_edge;
    for (Eigen::Index f = 0; f < rest.triangles.rows(); ++f) {
        const Vec3 a = rest.positions.row(rest.triangles(f, 0)), b = rest.positions.row(rest.triangles(f, 1)),
                   c = rest.positions.row(rest.triangles(f, 2));
        const double area = 0.5 * (b - a).cross(c - a).norm();
        for (int k = 0; k < 3; ++k) {
            masses_[rest.triangles(f, k)] += material.density * area / 3;
            area_at_edge[std::minmax(rest.triangles(f, k), rest.triangles(f, (k + 1) % 3))] += area;
        }
    }
    const auto length = [&](int i, int j) { return (rest.positions.row(i) - rest.positions.row(j)).norm(); };
    for (const auto& [edge, area] : area_at_edge) {
        const auto [i, j] = edge;
        // a spring stands for the strip of cloth beside it: width = area / length
        if (const double l = length(i, j); l > 0)
            springs_.push_back(
                { i, j, l, material.stretch_stiffness * std::min(area / (l * l), 1.0 * k_largest_cotangent) });
    }
    for (const auto& [i, j] : ties)
        springs_.push_back({ i, j, length(i, j), material.stretch_stiffness });
    add_hinges(rest, material.bend_stiffness);

    std::vector<Eigen::Triplet<double>> pulls;
    Eigen::VectorXd of_springs(springs_.size()), of_hinges(hinges_.size());
    for (int e = 0; e < int(springs_.size()); ++e) {
        pulls.emplace_back(springs_[e].i, e, 1.0);
        pulls.emplace_back(springs_[e].j, e, -1.0);
        of_springs[e] = springs_[e].stiffness;
    }
    pulled_by_springs_ = sparse(rest.positions.rows(), of_springs.size(), pulls);
    pulls.clear();
    for (int e = 0; e < int(hinges_.size()); ++e) {
        for (int k = 0; k < 4; ++k)
            pulls.emplace_back(hinges_[e].v[k], e, hinges_[e].coefficients[k]);
        of_hinges[e] = hinges_[e].stiffness;
    }
    pulled_by_hinges_ = sparse(rest.positions.rows(), of_hinges.size(), pulls);
    const auto quadratic_form = [](const SparseRows& pulled, const Eigen::VectorXd& stiffness) {
        return SparseRows(pulled * stiffness.asDiagonal() * SparseRows(pulled.transpose()));
    };
    elastic_ = quadratic_form(pulled_by_springs_, of_springs) + quadratic_form(pulled_by_hinges_, of_hinges);
    SparseRows diagonal(elastic_.rows(), elastic_.cols());  // every diagonal entry exists: set_time_step() writes there
    diagonal.setIdentity();
    elastic_ += 0 * diagonal;
}

void ClothEnergy::add_hinges(const GarmentMesh& rest, double bend_stiffness)
{
    std::map<std::pair<int, int>, std::vector<std::pair<int, int>>>
        corners_at;  // edge -> (opposite corner, first vertex)
    for (Eigen::Index f = 0; f < rest.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int i = rest.triangles(f, k), j = rest.triangles(f, (k + 1) % 3);
            corners_at[std::minmax(i, j)].emplace_back(rest.triangles(f, (k + 2) % 3), i);
        }
    const double mean_areas = 2 * area({ rest.positions, rest.triangles })
        / double(std::max<Eigen::Index>(1, rest.triangles.rows()));  // of a hinge
    for (const auto& [edge, corners] : corners_at) {
        if (corners.size() != 2 || corners[0].first == corners[1].first)
            continue;
        const int a = corners[0].second, b = a == edge.first ? edge.second : edge.first;
        Hinge h { { a, b, corners[0].first, corners[1].first }, {}, Vec3::Zero(), 0 };
        const auto x = [&](int k) { return Vec3(rest.positions.row(h.v[k])); };
        const double c01 = cotangent(x(0), x(1), x(2)), c02 = cotangent(x(0), x(1), x(3)),
                     c11 = cotangent(x(1), x(0), x(2)), c12 = cotangent(x(1), x(0), x(3));
        h.coefficients = { c11 + c12, c01 + c02, -c01 - c11, -c02 - c12 };
        const double areas = 0.5 * ((x(1) - x(0)).cross(x(2) - x(0)).norm() + (x(1) - x(0)).cross(x(3) - x(0)).norm());
        if (!(areas > 0))
            continue;
        h.stiffness = bend_stiffness * 3 / std::max(areas, k_least_hinge * mean_areas);
        h.curvature = hinge_frame(rest.positions, h.v).transpose() * weighted_sum(rest.positions, h.v, h.coefficients);
        hinges_.push_back(h);
    }
}

void ClothEnergy::set_time_step(double time_step)
{
    if (inertia_ == 1 / (time_step * time_step))
        return;
    inertia_ = 1 / (time_step * time_step);
    Eigen::SparseMatrix<double> system = elastic_;  // symmetric: columns are rows
    for (Eigen::Index v = 0; v < system.rows(); ++v)
        system.coeffRef(v, v) += masses_[v] * inertia_;
    if (!factor_.compute(system))
        throw SolverFailure(
            "cloth: the stiffness matrix could not be factorised; are there faces without area in the garment?");
}

Positions ClothEnergy::product(const SparseRows& matrix, const Positions& x)
{
    Positions result(matrix.rows(), 3);
    const auto row = [&](Eigen::Index i) {
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (SparseRows::InnerIterator entry(matrix, i); entry; ++entry)
            sum += entry.value() * x.row(entry.col());
        result.row(i) = sum;
    };
    parallel_for(matrix.rows(), row, k_grain);
    return result;
}

// Where the springs, projected to their rest, pull.
Positions ClothEnergy::spring_pulls(const Positions& x) const
{
    Positions pulls(springs_.size(), 3);
    const auto spring = [&](Eigen::Index e) {
        const Spring& s = springs_[e];
        const Eigen::RowVector3d edge = x.row(s.i) - x.row(s.j);
        const double length = edge.norm();
        pulls.row(e) = (length > 0 ? s.stiffness * s.length / length : 0.0) * edge;
    };
    parallel_for(pulls.rows(), spring, k_grain);
    return product(pulled_by_springs_, pulls);
}

// The same of the hinges.
Positions ClothEnergy::hinge_pulls(const Positions& x) const
{
    Positions pulls(hinges_.size(), 3);
    const auto hinge = [&](Eigen::Index e) {
        const Hinge& h = hinges_[e];
        pulls.row(e) = h.stiffness * (hinge_frame(x, h.v) * h.curvature);
    };
    parallel_for(pulls.rows(), hinge, k_grain);
    return product(pulled_by_hinges_, pulls);
}

// What springs that are locked wish beside their rest.
std::vector<Press> ClothEnergy::locks(const Positions& x) const
{
    return parallel_collect<Press>(springs_.size(), [&](std::size_t e) -> std::optional<Press> {
        const Spring& s = springs_[e];
        const Vec3 edge = (x.row(s.i) - x.row(s.j)).transpose();
        const double length = edge.norm(), longest = (1 + k_locked) * s.length;
        if (!(length > longest))
            return {};
        return Press { { s.i, s.j, -1, -1 },
                       { 1, -1, 0, 0 },
                       longest / length * edge,
                       edge / length,
                       k_locked_stiffness * s.stiffness,
                       0 };
    });
}

Positions ClothEnergy::elastic_forces(const Positions& x) const
{
    return spring_pulls(x) + hinge_pulls(x) - product(elastic_, x);
}

double ClothEnergy::elastic_energy(const Positions& x) const
{
    double sum = 0;
    for (const Spring& s : springs_) {
        const double longer = (x.row(s.i) - x.row(s.j)).norm() - s.length;
        sum += 0.5 * s.stiffness * longer * longer;
    }
    for (const Hinge& h : hinges_)
        sum += 0.5 * h.stiffness
            * (weighted_sum(x, h.v, h.coefficients) - hinge_frame(x, h.v) * h.curvature).squaredNorm();
    return sum;
}

// The constant quadratic form, n x 3.
Positions ClothEnergy::applied(const Positions& x) const
{
    Positions result = product(elastic_, x);
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        result.row(v) += masses_[v] * inertia_ * x.row(v);
    return result;
}

Descent::Descent(const ClothEnergy& energy, const Positions& start, const Positions& inertial) :
    energy_(energy), inertial_(inertial), x_(start), applied_(energy.applied(start))
{
}

void Descent::press(const std::vector<Press>& presses)
{
    presses_ = presses;
    const std::vector<Press> locks = energy_.locks(x_);
    presses_.insert(presses_.end(), locks.begin(), locks.end());
    constant_ = energy_.hinge_pulls(x_);
    for (Eigen::Index v = 0; v < x_.rows(); ++v)
        constant_.row(v) += energy_.masses_[v] * energy_.inertia_ * inertial_.row(v);
    for (const Press& press : presses_)
        pull(press, press.stiffness_times(press.target), constant_);
}

// What the presses pull with when the cloth is there, without their targets.
void Descent::add_pressed(const Positions& x, Positions& sum) const
{
    for (const Press& press : presses_) {
        Vec3 at = Vec3::Zero();
        for (int k = 0; k < 4; ++k)
            if (press.vertices[k] >= 0)
                at += press.weights[k] * x.row(press.vertices[k]).transpose();
        pull(press, press.stiffness_times(at), sum);
    }
}

// Away from what the last step has seen to: conjugate to its direction, as far as the residual turns smoothly.
void Descent::turn_direction(const Positions& residual)
{
    const Positions steepest = energy_.factor_.solve(residual);
    const double square = residual.cwiseProduct(steepest).sum();
    const double kept = square_ > 0 ? std::max(0.0, (square - residual_.cwiseProduct(steepest).sum()) / square_) : 0.0;
    direction_ = kept > 0 ? Positions(steepest + kept * direction_) : steepest;
    if (residual.cwiseProduct(direction_).sum() <= 0)
        direction_ = steepest;
    square_ = square;
}

void Descent::step()
{
    if (constant_.rows() == 0)
        press({});
    Positions pressed = Positions::Zero(x_.rows(), 3);
    add_pressed(x_, pressed);
    const Positions residual = constant_ + energy_.spring_pulls(x_) - applied_ - pressed;
    turn_direction(residual);
    const Positions along = energy_.applied(direction_);
    pressed = along;
    add_pressed(direction_, pressed);
    if (const double curvature = direction_.cwiseProduct(pressed).sum(); curvature > 0) {
        const double length = residual.cwiseProduct(direction_).sum() / curvature;
        x_ += length * direction_;
        applied_ += length * along;
    }
    residual_ = residual;
}

}  // namespace garmentfit
