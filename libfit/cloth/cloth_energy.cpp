// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloth_energy.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "garmentfit/error.h"
#include "parallel.h"
#include "surface_measures.h"
#include "tuning.h"
#include "woven_triangle.h"

namespace garmentfit {
namespace {

// unit: slivers have cotangents without bound, which would spoil the condition of the system. This is the cotangent of
// 5.7 degrees; a larger one says no more than "a small angle".
constexpr double k_largest_cotangent = 10;
// unit: kg, of vertices without area, so that the system stays definite: a square millimetre of cotton.
constexpr double k_least_mass = 2e-7;
// unit: vertices, springs or hinges worth handing to another thread.
constexpr Eigen::Index k_grain = 512;

double cotangent(const Vec3& apex, const Vec3& a, const Vec3& b)
{
    const Vec3 u = a - apex, v = b - apex;
    const double sine = u.cross(v).norm(), cosine = u.dot(v);
    if (sine <= std::abs(cosine) / k_largest_cotangent)
        return cosine < 0 ? -k_largest_cotangent : k_largest_cotangent;
    return cosine / sine;
}

// Axes of a hinge as columns: its edge, the mean of its two normals, and the direction across both.
Eigen::Matrix3d hinge_frame(const Positions& x, const std::array<int, 4>& v)
{
    const Vec3 a = x.row(v[0]), b = x.row(v[1]), c = x.row(v[2]), d = x.row(v[3]);
    const Vec3 edge = (b - a).normalized();
    Vec3 normal = (b - a).cross(c - a).normalized() + (d - a).cross(b - a).normalized();
    normal = (normal - normal.dot(edge) * edge).normalized();
    Eigen::Matrix3d frame;
    frame << edge, normal, edge.cross(normal);
    return frame;
}

// Axes of a triangle as columns: its first edge, its normal, and the direction across both.
Eigen::Matrix3d triangle_frame(const Positions& x, const std::array<int, 4>& v)
{
    const Vec3 a = x.row(v[0]), b = x.row(v[1]), c = x.row(v[2]);
    const Vec3 edge = (b - a).normalized(), normal = (b - a).cross(c - a).normalized();
    Eigen::Matrix3d frame;
    frame << edge, normal, edge.cross(normal);
    return frame;
}

double rest_length(const GarmentMesh& rest, int i, int j)
{
    return (rest.positions.row(i) - rest.positions.row(j)).norm();
}

Eigen::SparseMatrix<double, Eigen::RowMajor> make_sparse(Eigen::Index rows, Eigen::Index columns,
                                                         const std::vector<Eigen::Triplet<double>>& entries)
{
    Eigen::SparseMatrix<double, Eigen::RowMajor> result(rows, columns);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

/// Makes springs along the sides of a triangle as stiff as all that they pull with together, which bounds its energy, and
/// takes off in `slack` what that is too much.
void add_woven(const Eigen::Matrix3d& stiffness, const std::array<int, 3>& sides, std::vector<double>& at_edge,
               std::vector<Eigen::Triplet<double>>& slack)
{
    for (int k = 0; k < 3; ++k) {
        const double own = stiffness(k, k), all = stiffness.row(k).cwiseAbs().sum();
        at_edge[sides[k]] += all;
        for (int l = 0; l < 3; ++l)
            slack.emplace_back(sides[k], sides[l], l == k ? all - own : -stiffness(k, l));
    }
}

}  // namespace

Vec3 ClothEnergy::Spring::load(const Positions& x) const
{
    const Vec3 edge = (x.row(i) - x.row(j)).transpose();
    const double now = edge.norm();
    return (now > 0 ? stiffness * length / now : 0.0) * edge;
}

Vec3 ClothEnergy::Spring::force(const Positions& x) const
{
    return load(x) - stiffness * (x.row(i) - x.row(j)).transpose();
}

Eigen::Matrix3d ClothEnergy::Spring::tangent(const Positions& x) const
{
    const Vec3 edge = (x.row(i) - x.row(j)).transpose();
    const double now = edge.norm();
    if (!(now > 0))
        return Eigen::Matrix3d::Zero();
    const Eigen::Matrix3d along = edge * edge.transpose() / (now * now);
    const double across = std::max(0.0, 1 - length / now);
    return stiffness * (along + across * (Eigen::Matrix3d::Identity() - along));
}

Eigen::Matrix3d ClothEnergy::FramedSum::frame(const Positions& x) const
{
    return kind == Kind::hinge ? hinge_frame(x, v) : triangle_frame(x, v);
}

Vec3 ClothEnergy::FramedSum::sum(const Positions& x) const
{
    const auto& w = coefficients;
    return (w[0] * x.row(v[0]) + w[1] * x.row(v[1]) + w[2] * x.row(v[2]) + w[3] * x.row(v[3])).transpose();
}

Vec3 ClothEnergy::FramedSum::load(const Positions& x) const { return stiffness * (frame(x) * at_rest); }

Vec3 ClothEnergy::FramedSum::force(const Positions& x) const { return load(x) - stiffness * sum(x); }

ClothEnergy::ClothEnergy(const GarmentMesh& rest, const MeshTopology& topology,
                         const std::vector<std::pair<int, int>>& pairs, const Materials& materials,
                         const std::vector<Tie>& sewn) :
    masses_(rest.positions.rows(), k_least_mass),
    areas_(rest.positions.rows(), 0)
{
    add_springs(rest, topology, pairs, materials);
    add_hinges(rest, topology, materials);
    add_ties(rest, sewn, materials);
    assemble();
}

ClothEnergy::ClothEnergy(const GarmentMesh& rest, const MeshTopology& topology,
                         const std::vector<std::pair<int, int>>& pairs, const ClothOptions& options,
                         const std::vector<Tie>& sewn) :
    ClothEnergy(rest, topology, pairs, Materials(options), sewn)
{
}

// A spring stands for the strip of cloth beside it, whose width is area / length.
// derived: StretchesAndShearsAsAnIsotropicSheet in cloth_energy_test holds the moduli that follow.
// Where warp and weft are known, the sides of a triangle are springs that pull on each other (woven_triangle.h).
void ClothEnergy::add_springs(const GarmentMesh& rest, const MeshTopology& topology,
                              const std::vector<std::pair<int, int>>& pairs, const Materials& materials)
{
    const Edges& edges = topology.edges();
    std::vector<double> area_at_edge(edges.rows(), 0), woven_at_edge(edges.rows(), 0);
    std::vector<Eigen::Triplet<double>> slack;
    for (Eigen::Index f = 0; f < rest.triangles.rows(); ++f) {
        const Vec3 a = rest.positions.row(rest.triangles(f, 0)), b = rest.positions.row(rest.triangles(f, 1)),
                   c = rest.positions.row(rest.triangles(f, 2));
        const double area = 0.5 * (b - a).cross(c - a).norm();
        const std::array<int, 3> sides { topology.edge_of(3 * int(f)), topology.edge_of(3 * int(f) + 1),
                                         topology.edge_of(3 * int(f) + 2) };
        for (int k = 0; k < 3; ++k) {
            const int v = rest.triangles(f, k);
            areas_[v] += area / 3;
            masses_[v] += materials.at(v).density * area / 3;
        }
        if (const auto woven = woven_triangle(rest, f, materials.at(rest.triangles(f, 0))))
            add_woven(*woven, sides, woven_at_edge, slack);
        else
            for (const int edge : sides)
                if (edge >= 0)
                    area_at_edge[edge] += area;
    }
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        const int i = edges(e, 0), j = edges(e, 1);
        const Material& material = materials.at(i);
        const double l = rest_length(rest, i, j);
        const double width = l > 0 ? std::min(area_at_edge[e] / (l * l), k_largest_cotangent) : 0;
        springs_.push_back(
            { i, j, l, material.stretch_stiffness * width + woven_at_edge[e], (1 + material.strain_limit) * l });
    }
    for (const auto& [i, j] : pairs) {
        const double l = rest_length(rest, i, j);
        springs_.push_back({ i, j, l, materials.at(i).stretch_stiffness, (1 + materials.at(i).strain_limit) * l });
    }
    if (!slack.empty())
        slack_ = make_sparse(Eigen::Index(springs_.size()), Eigen::Index(springs_.size()), slack);
}

// literature: [bergou_2006_quadratic_bending], the 3 over the areas and the coefficients of cotangents.
void ClothEnergy::add_hinges(const GarmentMesh& rest, const MeshTopology& topology, const Materials& materials)
{
    const double mean_areas = 2 * area({ rest.positions, rest.triangles })
        / double(std::max<Eigen::Index>(1, rest.triangles.rows()));  // of a hinge
    for (int edge = 0; edge < int(topology.edges().rows()); ++edge) {
        const auto sides = topology.sides_at(edge);
        if (sides.size() != 2)
            continue;
        const auto corner_of = [&](int side, int k) { return rest.triangles(side / 3, (side % 3 + k) % 3); };
        const int a = corner_of(sides[0], 0), b = corner_of(sides[0], 1);
        const int c = corner_of(sides[0], 2), d = corner_of(sides[1], 2);
        if (c == d)
            continue;
        FramedSum h { FramedSum::Kind::hinge, { a, b, c, d }, {}, Vec3::Zero(), 0 };
        const auto x = [&](int k) { return Vec3(rest.positions.row(h.v[k])); };
        const double c01 = cotangent(x(0), x(1), x(2)), c02 = cotangent(x(0), x(1), x(3)),
                     c11 = cotangent(x(1), x(0), x(2)), c12 = cotangent(x(1), x(0), x(3));
        h.coefficients = { c11 + c12, c01 + c02, -c01 - c11, -c02 - c12 };
        const double areas = 0.5 * ((x(1) - x(0)).cross(x(2) - x(0)).norm() + (x(1) - x(0)).cross(x(3) - x(0)).norm());
        if (!(areas > 0))
            continue;
        h.stiffness = materials.at(a).bend_stiffness * 3 / std::max(areas, k_least_hinge_area * mean_areas);
        h.at_rest = h.frame(rest.positions).transpose() * h.sum(rest.positions);
        sums_.push_back(h);
    }
}

// derived: as stiff as the edges of an even mesh, so a seam gives no more than the cloth beside it.
void ClothEnergy::add_ties(const GarmentMesh& rest, const std::vector<Tie>& sewn, const Materials& materials)
{
    for (const Tie& tie : sewn) {
        // What is held has a spring at each vertex: a button's would be as stiff as a shirt's together.
        const double share = tie.is_seam ? 1 : std::min(1., areas_[tie.vertex] / k_contact_area);
        FramedSum t { FramedSum::Kind::tie,
                      { tie.corners[0], tie.corners[1], tie.corners[2], tie.vertex },
                      { -tie.weights[0], -tie.weights[1], -tie.weights[2], 1 },
                      Vec3::Zero(),
                      share * materials.at(tie.vertex).stretch_stiffness };
        t.at_rest = t.frame(rest.positions).transpose() * t.sum(rest.positions);
        sums_.push_back(t);
    }
}

void ClothEnergy::assemble()
{
    const Eigen::Index n = Eigen::Index(masses_.size());
    std::vector<Eigen::Triplet<double>> gradients;
    Eigen::VectorXd spring_stiffness(springs_.size()), sum_stiffness(sums_.size());
    for (int e = 0; e < int(springs_.size()); ++e) {
        gradients.emplace_back(springs_[e].i, e, 1.0);
        gradients.emplace_back(springs_[e].j, e, -1.0);
        spring_stiffness[e] = springs_[e].stiffness;
    }
    spring_gradients_ = make_sparse(n, spring_stiffness.size(), gradients);
    gradients.clear();
    for (int e = 0; e < int(sums_.size()); ++e) {
        for (int k = 0; k < 4; ++k)
            gradients.emplace_back(sums_[e].v[k], e, sums_[e].coefficients[k]);
        sum_stiffness[e] = sums_[e].stiffness;
    }
    sum_gradients_ = make_sparse(n, sum_stiffness.size(), gradients);
    const auto quadratic_form = [](const SparseRows& form, const Eigen::VectorXd& stiffness) {
        return SparseRows(form * stiffness.asDiagonal() * SparseRows(form.transpose()));
    };
    elastic_ = quadratic_form(spring_gradients_, spring_stiffness) + quadratic_form(sum_gradients_, sum_stiffness);
    SparseRows diagonal(n, n);  // set_time_step() writes to the diagonal, so each of its entries must exist
    diagonal.setIdentity();
    elastic_ += 0 * diagonal;
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
            "cloth: the stiffness matrix of the garment could not be factorised. Remove faces without area "
            "from the garment, and look for figures of the fabric that are 0 or far too large.");
}

Positions ClothEnergy::multiply(const SparseRows& matrix, const Positions& x)
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

template <class Element>
Positions ClothEnergy::gather(const SparseRows& gradients, const std::vector<Element>& elements,
                              Vec3 (Element::*of_element)(const Positions&) const, const Positions& x)
{
    Positions loads(elements.size(), 3);
    parallel_for(
        loads.rows(), [&](Eigen::Index e) { loads.row(e) = (elements[e].*of_element)(x); }, k_grain);
    return multiply(gradients, loads);
}

Eigen::VectorXd ClothEnergy::lengthening(const Positions& x) const
{
    Eigen::VectorXd result(springs_.size());
    parallel_for(
        result.size(),
        [&](Eigen::Index e) {
            const Spring& s = springs_[e];
            result[e] = (x.row(s.i) - x.row(s.j)).norm() - s.length;
        },
        k_grain);
    return result;
}

Positions ClothEnergy::gather_springs(Vec3 (Spring::*of_spring)(const Positions&) const, const Positions& x) const
{
    if (slack_.rows() == 0)
        return gather(spring_gradients_, springs_, of_spring, x);
    const Eigen::VectorXd longer = lengthening(x);
    Positions pulls(longer.size(), 3);
    const auto pull = [&](Eigen::Index e) {
        const Spring& s = springs_[e];
        double slack = 0;
        for (SparseRows::InnerIterator entry(slack_, e); entry; ++entry)
            slack += entry.value() * longer[entry.col()];
        const double now = s.length + longer[e];
        pulls.row(e) = (s.*of_spring)(x).transpose() + (now > 0 ? slack / now : 0.0) * (x.row(s.i) - x.row(s.j));
    };
    parallel_for(pulls.rows(), pull, k_grain);
    return multiply(spring_gradients_, pulls);
}

Positions ClothEnergy::spring_loads(const Positions& x) const { return gather_springs(&Spring::load, x); }

Positions ClothEnergy::frame_loads(const Positions& x) const
{
    return gather(sum_gradients_, sums_, &FramedSum::load, x);
}

std::vector<SoftConstraint> ClothEnergy::strain_limits(const Positions& x) const
{
    const auto limit = [&](std::size_t e) -> std::optional<SoftConstraint> {
        const Spring& s = springs_[e];
        const Vec3 edge = (x.row(s.i) - x.row(s.j)).transpose();
        const double length = edge.norm();
        if (!(length > s.longest))
            return {};
        return SoftConstraint { { s.i, s.j, -1, -1 },
                                { 1, -1, 0, 0 },
                                s.longest / length * edge,
                                edge / length,
                                k_strain_limit_stiffness * s.stiffness,
                                0 };
    };
    return parallel_collect<SoftConstraint>(springs_.size(), limit);
}

Positions ClothEnergy::elastic_forces(const Positions& x) const
{
    return gather_springs(&Spring::force, x) + gather(sum_gradients_, sums_, &FramedSum::force, x);
}

double ClothEnergy::elastic_energy(const Positions& x) const
{
    const Eigen::VectorXd longer = lengthening(x);
    double sum = slack_.rows() > 0 ? -0.5 * longer.dot(slack_ * longer) : 0;
    for (std::size_t e = 0; e < springs_.size(); ++e)
        sum += 0.5 * springs_[e].stiffness * longer[e] * longer[e];
    for (const FramedSum& s : sums_)
        sum += 0.5 * s.stiffness * (s.sum(x) - s.frame(x) * s.at_rest).squaredNorm();
    return sum;
}

Positions ClothEnergy::apply_quadratic_form(const Positions& x) const
{
    Positions result = multiply(elastic_, x);
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        result.row(v) += masses_[v] * inertia_ * x.row(v);
    return result;
}

}  // namespace garmentfit
